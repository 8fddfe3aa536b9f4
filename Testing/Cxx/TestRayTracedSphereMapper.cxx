// SPDX-License-Identifier: BSD-3-Clause
// Real windows: these tests need a display with OpenGL, Xvfb for instance.
#include "VTKErrors.h"
#include "vtkRayTracedSphereMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace
{
struct Ball
{
  double x, y, z, radius;
};

vtkSmartPointer<vtkPolyData> makeBalls(const std::vector<Ball>& balls)
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

std::vector<Ball> lattice(int side)
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
    this->window->SetOffScreenRendering(1);
    this->window->SetMultiSamples(0);
    this->window->SetSize(width, height);
    this->window->AddRenderer(this->renderer);
    this->mapper->SetInputData(makeBalls(balls));
    this->mapper->ScalarVisibilityOff();
    this->actor->SetMapper(this->mapper);
    this->renderer->AddActor(this->actor);
    this->renderer->ResetCamera();
  }

  /// Pure ambient colour: every pixel of a prop is exactly its colour.
  void makeFlat(double r, double g, double b)
  {
    vtkProperty* property = this->actor->GetProperty();
    property->SetAmbient(1);
    property->SetDiffuse(0);
    property->SetColor(r, g, b);
  }
};

using Pixel = std::array<int, 3>;

struct Picture
{
  vtkSmartPointer<vtkImageData> image;

  [[nodiscard]] int width() const { return this->image->GetDimensions()[0]; }
  [[nodiscard]] int height() const { return this->image->GetDimensions()[1]; }

  [[nodiscard]] Pixel at(int x, int y) const
  {
    const auto* p = static_cast<unsigned char*>(this->image->GetScalarPointer(x, y, 0));
    return { p[0], p[1], p[2] };
  }
};

Picture grab(vtkRenderWindow* window, int scale = 1)
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

int largestDifference(Pixel a, Pixel b)
{
  return std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) });
}

/// Share of pixels that differ by more than `tolerance`.
double differingShare(const Picture& a, const Picture& b, int tolerance = 2)
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

vtkDataArray* layer(const Scene& scene, const char* name)
{
  return scene.mapper->GetLayers()->GetPointData()->GetArray(name);
}

void bakeConstant(vtkPolyData* data, unsigned char byte)
{
  vtkNew<vtkIntArray> rows;
  rows->SetName("AmbientOcclusionTexture");
  rows->SetNumberOfTuples(data->GetNumberOfPoints());
  rows->Fill(0);
  data->GetPointData()->AddArray(rows);
  vtkNew<vtkUnsignedCharArray> table;
  table->SetName("AmbientOcclusionTextures");
  table->SetNumberOfComponents(4);
  table->SetNumberOfTuples(1);
  table->Fill(byte);
  data->GetFieldData()->AddArray(table);
  vtkNew<vtkStringArray> parameters;
  parameters->SetName("AmbientOcclusionParameters");
  for (const char* entry : { "resolution=2", "encoding=UInt8Gamma2", "gamma=2", "maximum=1" })
  {
    parameters->InsertNextValue(entry);
  }
  data->GetFieldData()->AddArray(parameters);
}

class BothProjections : public testing::TestWithParam<bool>
{
};

TEST_P(BothProjections, InterpenetratesAConePixelByPixel)
{
  Scene scene({ { 0, 0, 0, 1 } }, 200, 200);
  scene.makeFlat(1, 0, 0);
  vtkNew<vtkConeSource> source;
  source->SetResolution(6);
  source->SetHeight(3);
  source->SetRadius(1.1);
  source->SetDirection(0.3, 1, 0.5);
  vtkNew<vtkPolyDataMapper> coneMapper;
  coneMapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> cone;
  cone->SetMapper(coneMapper);
  cone->GetProperty()->SetAmbient(1);
  cone->GetProperty()->SetDiffuse(0);
  cone->GetProperty()->SetColor(0, 0, 1);
  scene.renderer->AddActor(cone);
  scene.renderer->GetActiveCamera()->SetParallelProjection(GetParam());
  scene.renderer->ResetCamera();

  // The depth of the cone alone and of the sphere alone decide what must be seen.
  const auto depthOf = [&](bool showSphere, bool showCone)
  {
    scene.actor->SetVisibility(showSphere);
    cone->SetVisibility(showCone);
    scene.window->Render();
    vtkNew<vtkFloatArray> depth;
    scene.window->GetZbufferData(0, 0, 199, 199, depth);
    return std::vector<float>(depth->GetPointer(0), depth->GetPointer(0) + 200 * 200);
  };
  scene.renderer->ResetCameraClippingRange();
  const std::vector<float> sphereDepth = depthOf(true, false), coneDepth = depthOf(false, true);
  scene.actor->VisibilityOn();
  cone->VisibilityOn();
  const Picture picture = grab(scene.window);

  int red = 0, blue = 0, compared = 0;
  for (int y = 0; y < 200; ++y)
  {
    for (int x = 0; x < 200; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(200 * y + x);
      if (sphereDepth[i] < 1)
      {
        // The written depth is that of the analytic sphere: back from the window to the world.
        scene.renderer->SetDisplayPoint(x + 0.5, y + 0.5, sphereDepth[i]);
        scene.renderer->DisplayToWorld();
        const double* p = scene.renderer->GetWorldPoint();
        ASSERT_NEAR(std::hypot(p[0] / p[3], p[1] / p[3], p[2] / p[3]), 1, 1e-4) << x << ' ' << y;
        ++compared;
      }
      if (std::abs(sphereDepth[i] - coneDepth[i]) < 1e-6)
      {
        continue;
      }
      const Pixel expected =
        sphereDepth[i] < coneDepth[i] ? Pixel{ 255, 0, 0 } : Pixel{ 0, 0, 255 };
      ASSERT_EQ(picture.at(x, y), expected) << x << ' ' << y;
      red += expected[0] > 0;
      blue += expected[2] > 0;
    }
  }
  EXPECT_GT(red, 1000);
  EXPECT_GT(blue, 1000);
  EXPECT_GT(compared, 3000);
}

INSTANTIATE_TEST_SUITE_P(Mapper, BothProjections, testing::Bool());

TEST(RayTracedSphereMapper, LooksLikeAFineMeshOfTheSameSphere)
{
  // Same light, same terms, same highlight as VTK's own shading of a finely meshed sphere.
  Scene scene({ { 0, 0, 0, 1 } }, 200, 200);
  for (const bool headlight : { true, false })
  {
    if (!headlight)
    {
      vtkNew<vtkLight> light;
      light->SetPosition(3, 4, 5);
      light->SetColor(0.9, 0.8, 0.7);
      scene.renderer->RemoveAllLights();
      scene.renderer->AddLight(light);
    }
    vtkProperty* property = scene.actor->GetProperty();
    property->SetAmbient(0.1);
    property->SetDiffuse(0.6);
    property->SetSpecular(0.3);
    property->SetSpecularPower(20);
    property->SetColor(0.9, 0.6, 0.3);
    vtkNew<vtkSphereSource> source;
    source->SetRadius(1);
    source->SetThetaResolution(400);
    source->SetPhiResolution(400);
    vtkNew<vtkPolyDataMapper> meshMapper;
    meshMapper->SetInputConnection(source->GetOutputPort());
    scene.actor->SetMapper(scene.mapper);
    scene.window->Render();
    const Picture traced = grab(scene.window);
    scene.actor->SetMapper(meshMapper);
    const Picture mesh = grab(scene.window);
    EXPECT_GT(traced.at(100, 100)[0], 100);
    // The outline may differ by the mesh's facets.
    EXPECT_LT(differingShare(traced, mesh, 3), 0.01) << (headlight ? "headlight" : "scene light");
  }
}

TEST(RayTracedSphereMapper, TwoViewportsShowTheirOwnCameras)
{
  Scene scene({ { 0, 0, 0, 1 } }, 200, 100);
  scene.makeFlat(1, 1, 1);
  scene.renderer->SetViewport(0, 0, 0.5, 1);
  vtkNew<vtkRenderer> right;
  right->SetViewport(0.5, 0, 1, 1);
  right->AddActor(scene.actor);
  scene.window->AddRenderer(right);
  scene.renderer->ResetCamera();
  right->ResetCamera();
  right->GetActiveCamera()->Zoom(0.5);
  const Picture picture = grab(scene.window);
  const auto count = [&](int from, int to)
  {
    int white = 0;
    for (int y = 0; y < 100; ++y)
    {
      for (int x = from; x < to; ++x)
      {
        white += picture.at(x, y)[0] == 255;
      }
    }
    return white;
  };
  const int big = count(0, 100), small = count(100, 200);
  EXPECT_EQ(picture.at(50, 50)[0], 255);
  EXPECT_EQ(picture.at(150, 50)[0], 255);
  EXPECT_GT(small, 300);
  // Zooming by half doubles the view angle from 30 to 60 degrees.
  const double ratio = std::tan(vtkMath::Pi() / 6) / std::tan(vtkMath::Pi() / 12);
  EXPECT_NEAR(double(big) / small, ratio * ratio, 0.1 * ratio * ratio);
}

TEST(RayTracedSphereMapper, TiledScreenshotEqualsALargeWindow)
{
  Scene small(lattice(4), 100, 70), large(lattice(4), 300, 210);
  for (Scene* scene : { &small, &large })
  {
    scene->renderer->GetActiveCamera()->Azimuth(30);
    scene->renderer->GetActiveCamera()->Elevation(20);
    scene->renderer->ResetCamera();
    scene->mapper->ShadowsOn();
  }
  small.window->Render();
  large.window->Render();
  const Picture tiled = grab(small.window, 3), whole = grab(large.window);
  EXPECT_LT(differingShare(tiled, whole), 0.002);
}

TEST(RayTracedSphereMapper, ColoursAreThoseOfTheLookupTable)
{
  Scene scene({ { 0, 0, 0, 1 }, { 3, 0, 0, 1 }, { 6, 0, 0, 1 } }, 300, 100);
  scene.makeFlat(1, 1, 1);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(3);
  table->SetTableValue(0, 1, 0, 0);
  table->SetTableValue(1, 0, 1, 0);
  table->SetTableValue(2, 0, 0.2, 1);
  table->SetTableRange(0, 2);
  scene.mapper->ScalarVisibilityOn();
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("value");
  scene.mapper->SetLookupTable(table);
  scene.mapper->UseLookupTableScalarRangeOn();
  const Picture picture = grab(scene.window);
  std::set<Pixel> seen;
  for (int x = 0; x < 300; ++x)
  {
    seen.insert(picture.at(x, 50));
  }
  EXPECT_EQ(seen, (std::set<Pixel>{ { 0, 0, 0 }, { 255, 0, 0 }, { 0, 255, 0 }, { 0, 51, 255 } }));
}

TEST(RayTracedSphereMapper, TracesOnlyWhenTheViewOrTheSpheresChange)
{
  Scene scene(lattice(3));
  scene.mapper->ShadowsOn();
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_GT(scene.mapper->GetNumberOfShadowRays(), 0);
  const vtkIdType shadows = scene.mapper->GetNumberOfTracedShadows();
  EXPECT_EQ(shadows, 1);
  const Picture before = grab(scene.window);

  scene.actor->GetProperty()->SetColor(1, 0, 0);
  scene.mapper->SetShadingMode(vtkRayTracedSphereMapper::DIRECT_LIGHT);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedShadows(), shadows) << "the light stayed where it was";
  EXPECT_GT(differingShare(before, grab(scene.window)), 0.1);

  vtkNew<vtkLight> light;
  light->SetPosition(5, 8, 9);
  scene.renderer->AddLight(light);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedShadows(), shadows + 1) << "only the new light's";

  scene.renderer->GetActiveCamera()->Azimuth(5);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 2);
  scene.mapper->SetRadiusScale(0.5);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 3);
  scene.window->SetSize(90, 80);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 4);
  scene.actor->SetScale(1, 2, 1);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 5);
}

TEST(RayTracedSphereMapper, OcclusionDarkensAndModesChoose)
{
  Scene scene({ { 0, 0, 0, 1 } }, 61, 61);
  const auto center = [&] { return grab(scene.window).at(30, 30)[0]; };
  EXPECT_GE(center(), 254);
  auto baked = makeBalls({ { 0, 0, 0, 1 } });
  bakeConstant(baked, 180); // (180/255)^2 = 0.498
  scene.mapper->SetInputData(baked);
  EXPECT_NEAR(center(), 127, 1);
  scene.mapper->OcclusionOnDiffuseOff();
  EXPECT_GE(center(), 254);
  scene.mapper->OcclusionOnDiffuseOn();
  scene.mapper->SetShadingMode(vtkRayTracedSphereMapper::DIRECT_LIGHT);
  EXPECT_GE(center(), 254);
  scene.mapper->SetShadingMode(vtkRayTracedSphereMapper::AMBIENT_OCCLUSION);
  EXPECT_NEAR(center(), 127, 1);
  EXPECT_NEAR(layer(scene, "AO")->GetComponent(30 * 61 + 30, 0), 0.498, 1e-3);
}

TEST(RayTracedSphereMapper, LayersDescribeTheFrame)
{
  Scene scene({ { 0, 0, 0, 1 } }, 41, 41);
  WarningCatcher warnings(scene.mapper);
  scene.mapper->SetInputData(makeBalls({ { 0, 0, 0, -1 }, { 0, 0, 0, 1 } }));
  scene.window->Render();
  EXPECT_EQ(warnings.count(), 1) << "one sphere has a negative radius";
  const double distance = scene.renderer->GetActiveCamera()->GetDistance();
  const vtkIdType middle = 20 * 41 + 20;
  ASSERT_EQ(scene.mapper->GetLayers()->GetNumberOfPoints(), 41 * 41);
  EXPECT_EQ(layer(scene, "id")->GetComponent(middle, 0), 1);
  EXPECT_EQ(layer(scene, "id")->GetComponent(0, 0), -1);
  EXPECT_NEAR(layer(scene, "Z")->GetComponent(middle, 0), distance - 1, 1e-4);
  EXPECT_TRUE(std::isinf(layer(scene, "Z")->GetComponent(0, 0)));
  EXPECT_NEAR(layer(scene, "N")->GetComponent(middle, 2), 1, 1e-4);
  EXPECT_EQ(layer(scene, "AO")->GetComponent(middle, 0), 1);
  EXPECT_EQ(layer(scene, "RGBA")->GetComponent(middle, 3), 255);
  EXPECT_EQ(layer(scene, "RGBA")->GetComponent(0, 3), 0);
}

TEST(RayTracedSphereMapper, BoundsIncludeTheRadii)
{
  Scene scene({ { 1, 2, 3, 0.5 }, { 4, 2, 3, 2 } });
  double bounds[6];
  scene.mapper->GetBounds(bounds);
  const double expected[6] = { 0.5, 6, 0, 4, 1, 5 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-5);
  }
}

TEST(RayTracedSphereMapper, PointsAreSelectedByTheSphereUnderThePixel)
{
  Scene scene({ { 0, 0, 0, 1 }, { 3, 0, 0, 1 } }, 200, 100);
  scene.window->Render();
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    selector->SetFieldAssociation(association);
    selector->SetArea(110, 10, 199, 90);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
    auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
    ASSERT_EQ(ids->GetNumberOfTuples(), 1);
    EXPECT_EQ(ids->GetValue(0), 1);
  }
}

TEST(RayTracedSphereMapper, MistakesGiveOneMessageAndNoCrash)
{
  Scene scene({ { 0, 0, 0, 1 } });
  ErrorCatcher errors(scene.mapper);
  WarningCatcher warnings(scene.mapper);
  scene.mapper->SetRadiusArray("nothing");
  scene.window->Render();
  scene.window->Render();
  ASSERT_EQ(errors.count(), 1);
  EXPECT_NE(errors.text().find("nothing"), std::string::npos);
  EXPECT_NE(errors.text().find("radius"), std::string::npos) << "lists what there is";

  scene.mapper->SetRadiusArray(nullptr);
  auto baked = makeBalls({ { 0, 0, 0, 1 } });
  bakeConstant(baked, 180);
  baked->GetPointData()->GetArray("AmbientOcclusionTexture")->SetComponent(0, 0, 7);
  scene.mapper->SetInputData(baked);
  const Picture picture = grab(scene.window);
  ASSERT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("AmbientOcclusionTexture"), std::string::npos);
  EXPECT_GT(picture.at(80, 60)[0], 200) << "drawn without occlusion";

  scene.mapper->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  scene.window->Render();
  EXPECT_EQ(errors.count(), 1) << "nothing to draw is no mistake";
  EXPECT_EQ(scene.mapper->GetLayers()->GetNumberOfPoints(), 0);
}

TEST(RayTracedSphereMapper, WindowsAndResourcesComeAndGo)
{
  Scene scene(lattice(2), 50, 40);
  const Picture first = grab(scene.window);
  scene.window->Finalize();
  EXPECT_EQ(differingShare(first, grab(scene.window)), 0);
  scene.window->SetMultiSamples(4);
  scene.window->SetSize(1, 1);
  scene.window->Render();
  scene.window->SetSize(50, 40);
  scene.window->SetMultiSamples(0);
  EXPECT_EQ(differingShare(first, grab(scene.window)), 0);
}
}
