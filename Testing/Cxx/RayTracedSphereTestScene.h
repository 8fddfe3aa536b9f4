// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RayTracedSphereTestScene_h
#define po_RayTracedSphereTestScene_h

// Scenes of ray-traced spheres in a real window, and how to look at what is drawn.

#include "OcclusionParameters.h"
#include "vtkRayTracedSphereMapper.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

struct Ball
{
  double x, y, z, radius;
};

inline vtkSmartPointer<vtkPolyData> makeBalls(const std::vector<Ball>& balls)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radii, values;
  radii->SetName("radius");
  values->SetName("value");
  for (std::size_t i = 0; i < balls.size(); ++i)
  {
    points->InsertNextPoint(balls[i].x, balls[i].y, balls[i].z);
    radii->InsertNextValue(static_cast<float>(balls[i].radius));
    values->InsertNextValue(static_cast<float>(i));
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  data->GetPointData()->AddArray(values);
  return data;
}

inline std::vector<Ball> lattice(int side)
{
  std::vector<Ball> balls;
  for (int i = 0; i < side * side * side; ++i)
  {
    balls.push_back({ double(i % side), double(i / side % side), double(i / side / side), 0.45 });
  }
  return balls;
}

/// A window with one renderer and one actor of ray-traced spheres.
struct Scene
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRayTracedSphereMapper> mapper;

  explicit Scene(const std::vector<Ball>& balls, int width = 160, int height = 120)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(width, height);
    window->AddRenderer(renderer);
    mapper->SetInputData(makeBalls(balls));
    mapper->ScalarVisibilityOff();
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    renderer->ResetCamera();
  }

  /// Pure ambient colour: every pixel of a prop is exactly its colour.
  void makeFlat(double r, double g, double b)
  {
    vtkProperty* property = actor->GetProperty();
    property->SetAmbient(1);
    property->SetDiffuse(0);
    property->SetColor(r, g, b);
  }
};

using Pixel = std::array<int, 3>;

struct Picture
{
  vtkSmartPointer<vtkImageData> image;

  [[nodiscard]] int width() const { return image->GetDimensions()[0]; }
  [[nodiscard]] int height() const { return image->GetDimensions()[1]; }

  [[nodiscard]] Pixel at(int x, int y) const
  {
    const auto* p = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
    return { p[0], p[1], p[2] };
  }
};

inline Picture grab(vtkRenderWindow* window, int scale = 1)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window);
  filter->SetScale(scale);
  filter->ReadFrontBufferOff();
  filter->SetShouldRerender(scale > 1);
  filter->Update();
  return { filter->GetOutput() };
}

inline int largestDifference(Pixel a, Pixel b)
{
  return std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) });
}

/// Share of pixels that differ by more than `tolerance`.
inline double differingShare(const Picture& a, const Picture& b, int tolerance = 2)
{
  EXPECT_EQ(a.width(), b.width());
  EXPECT_EQ(a.height(), b.height());
  int different = 0;
  for (int y = 0; y < a.height(); ++y)
  {
    for (int x = 0; x < a.width(); ++x)
    {
      different += largestDifference(a.at(x, y), b.at(x, y)) > tolerance;
    }
  }
  return double(different) / (a.width() * a.height());
}

inline vtkDataArray* layer(const Scene& scene, const char* name)
{
  return scene.mapper->GetLayers()->GetPointData()->GetArray(name);
}

inline void bakeConstant(vtkPolyData* data, unsigned char byte)
{
  vtkNew<vtkIntArray> rows;
  rows->SetName(po::TextureIndexArray);
  rows->SetNumberOfTuples(data->GetNumberOfPoints());
  rows->Fill(0);
  data->GetPointData()->AddArray(rows);
  vtkNew<vtkUnsignedCharArray> table;
  table->SetName(po::TextureTableArray);
  table->SetNumberOfComponents(4);
  table->SetNumberOfTuples(1);
  table->Fill(byte);
  data->GetFieldData()->AddArray(table);
  vtkNew<vtkStringArray> parameters;
  parameters->SetName(po::ParametersArray);
  for (const char* entry : { "resolution=2", "encoding=UInt8Gamma2", "gamma=2", "maximum=1" })
  {
    parameters->InsertNextValue(entry);
  }
  data->GetFieldData()->AddArray(parameters);
}

#endif
