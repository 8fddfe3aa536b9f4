// SPDX-License-Identifier: BSD-3-Clause
#ifndef SilhouettePassTestScene_h
#define SilhouettePassTestScene_h

#include "vtkDepthSilhouettePass.h"
#include "vtkDepthSilhouettes.h"
#include "vtkZBufferToDepth.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// A window with meshes and the lines of vtkDepthSilhouettePass.
namespace silhouette_pass
{
constexpr int Width = 321;
constexpr int Height = 243;

inline void addProp(vtkRenderer* renderer, vtkPolyDataAlgorithm* source, double red)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, 0.7, 0.3);
  renderer->AddActor(actor);
}

/// Three spheres and a cone in front of a slanted plane that leaves room for background.
inline void fillScene(vtkRenderer* renderer)
{
  const double centers[3][3] = { { 0.0, 0.0, 0.0 }, { 0.7, 0.3, -0.4 }, { -1.2, -0.5, 0.3 } };
  for (const auto& center : centers)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(center[0], center[1], center[2]);
    sphere->SetRadius(0.5);
    sphere->SetThetaResolution(96);
    sphere->SetPhiResolution(96);
    addProp(renderer, sphere, 0.9);
  }
  vtkNew<vtkConeSource> cone;
  cone->SetResolution(64);
  cone->SetCenter(0.2, -0.8, 0.6);
  addProp(renderer, cone, 0.2);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2.0, -2.0, -3.0);
  plane->SetPoint1(2.0, -2.0, -2.0);
  plane->SetPoint2(-2.0, 1.2, -4.0);
  addProp(renderer, plane, 0.5);
}

struct Scene
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkDepthSilhouettePass> pass;

  explicit Scene(int multiSamples = 0)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(multiSamples);
    window->SetSize(Width, Height);
    window->AddRenderer(renderer);
    renderer->SetBackground(0.1, 0.2, 0.4);
    fillScene(renderer);
    pass->SetDelegatePass(steps);
    pass->SetColor(1.0, 0.0, 1.0); // nothing in the scene has it
    pass->SetSamples(1);
    renderer->SetPass(pass);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Azimuth(12.0);
  }
};

/// The renderer's part of the window, row-major RGB.
inline std::vector<unsigned char> pixels(vtkRenderWindow* window, vtkRenderer* renderer)
{
  window->Render();
  const int* origin = renderer->GetOrigin();
  const int* size = renderer->GetSize();
  vtkNew<vtkUnsignedCharArray> rgb;
  window->GetPixelData(
    origin[0], origin[1], origin[0] + size[0] - 1, origin[1] + size[1] - 1, 0, rgb);
  return { rgb->GetPointer(0), rgb->GetPointer(0) + rgb->GetNumberOfValues() };
}

/// The window's camera in a picture of `scale` times its size, row-major RGB.
inline std::vector<unsigned char> tiledPixels(vtkRenderWindow* window, int scale)
{
  vtkNew<vtkWindowToImageFilter> tiles;
  tiles->SetInput(window);
  tiles->SetScale(scale);
  tiles->ReadFrontBufferOff();
  tiles->Update();
  auto* rgb = vtkUnsignedCharArray::SafeDownCast(tiles->GetOutput()->GetPointData()->GetScalars());
  return { rgb->GetPointer(0), rgb->GetPointer(0) + rgb->GetNumberOfValues() };
}

inline bool isLine(const std::vector<unsigned char>& rgb, std::size_t pixel)
{
  return rgb[3 * pixel] == 255 && rgb[3 * pixel + 1] == 0 && rgb[3 * pixel + 2] == 255;
}

/// Number of pixels that have a line in one picture and none in the other.
inline int differentLines(
  const std::vector<unsigned char>& first, const std::vector<unsigned char>& second)
{
  EXPECT_EQ(first.size(), second.size());
  int different = 0;
  for (std::size_t pixel = 0; pixel < std::min(first.size(), second.size()) / 3; ++pixel)
  {
    different += isLine(first, pixel) != isLine(second, pixel);
  }
  return different;
}

/// Depth image of the frame that was rendered last.
inline vtkSmartPointer<vtkImageData> depthOf(vtkRenderWindow* window, vtkRenderer* renderer)
{
  const int* origin = renderer->GetOrigin();
  const int* size = renderer->GetSize();
  vtkNew<vtkFloatArray> z;
  window->GetZbufferData(origin[0], origin[1], origin[0] + size[0] - 1, origin[1] + size[1] - 1, z);
  vtkNew<vtkImageData> image;
  image->SetDimensions(size[0], size[1], 1);
  image->GetPointData()->SetScalars(z);
  vtkNew<vtkZBufferToDepth> convert;
  convert->SetInputData(image);
  convert->SetProjectionMatrix(renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
  convert->Update();
  return convert->GetOutput();
}

inline std::vector<float> filterLines(vtkImageData* depth, vtkDepthSilhouettePass* pass)
{
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(depth);
  filter->SetThreshold(pass->GetThreshold());
  filter->SetBackgroundDepth(pass->GetBackgroundDepth());
  filter->SetSamples(pass->GetSamples());
  filter->SetLineWidth(pass->GetLineWidth());
  filter->Update();
  auto* line = vtkFloatArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars());
  return { line->GetPointer(0), line->GetPointer(0) + line->GetNumberOfValues() };
}

/// Compares the pass with the filter on the same z-buffer, pixel by pixel.
inline void expectAgreement(Scene& scene, vtkRenderer* renderer, vtkDepthSilhouettePass* pass)
{
  const auto rgb = pixels(scene.window, renderer);
  const auto expected = filterLines(depthOf(scene.window, renderer), pass);
  std::size_t lines = 0;
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel)
  {
    lines += expected[pixel] > 0.0F;
    EXPECT_EQ(isLine(rgb, pixel), expected[pixel] > 0.0F) << "pixel " << pixel;
  }
  EXPECT_GT(lines, 200U);
  EXPECT_LT(lines, expected.size() / 10);
}
}

#endif
