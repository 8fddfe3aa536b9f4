// SPDX-License-Identifier: BSD-3-Clause
// What is seen: shapes, shades, colours and occlusion, in all windows.
// Real windows: these tests need a display with OpenGL, Xvfb for instance.
#include "RayTracedSphereTestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace
{
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

TEST(RayTracedSphereMapper, BakedLightIsNotLitAgain)
{
  Scene scene({ { 0, 0, 0, 1 } }, 61, 61);
  auto baked = makeBalls({ { 0, 0, 0, 1 } });
  bakeConstant(baked, 180); // (180/255)^2 = 0.498
  auto* parameters =
    vtkStringArray::SafeDownCast(baked->GetFieldData()->GetAbstractArray(po::ParametersArray));
  parameters->InsertNextValue("bakeLight=1");
  scene.mapper->SetInputData(baked);
  scene.mapper->ShadowsOn();
  const auto at = [&](int x) { return grab(scene.window).at(x, 30)[0]; };
  EXPECT_NEAR(at(30), 127, 1);
  EXPECT_NEAR(at(18), 127, 1) << "the headlight would make it darker towards the rim";
  EXPECT_EQ(scene.mapper->GetNumberOfShadowRays(), 0);
  scene.mapper->SetShadingMode(vtkRayTracedSphereMapper::DIRECT_LIGHT);
  EXPECT_GE(at(30), 254);
  EXPECT_LT(at(18), 245);
}
}
