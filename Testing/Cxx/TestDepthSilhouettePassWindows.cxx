// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePassTestScene.h"

#include <gtest/gtest.h>

using namespace silhouette_pass;

TEST(DepthSilhouettePass, EachViewportHasItsOwnLines)
{
  Scene scene;
  vtkNew<vtkRenderer> second;
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkDepthSilhouettePass> pass;
  fillScene(second);
  pass->SetDelegatePass(steps);
  pass->SetColor(1.0, 0.0, 1.0);
  pass->SetSamples(1);
  second->SetPass(pass);
  scene.window->AddRenderer(second);
  scene.renderer->SetViewport(0.0, 0.0, 0.45, 1.0);
  second->SetViewport(0.45, 0.2, 1.0, 0.9);
  scene.renderer->ResetCamera();
  second->ResetCamera();
  second->GetActiveCamera()->Elevation(30.0);
  second->ResetCameraClippingRange();
  expectAgreement(scene, scene.renderer, scene.pass);
  expectAgreement(scene, second, pass);
}

TEST(DepthSilhouettePass, LinesContinueAcrossTiles)
{
  Scene scene;
  scene.window->SetSize(320, 240);
  // The cube's lower side and its left one lie on the seams between the tiles.
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(0.0, 0.4, 0.0, 0.5, 1.0, 1.5);
  addProp(scene.renderer, cube, 0.6);
  vtkCamera* camera = scene.renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(0.0, 0.0, 8.0);
  camera->SetParallelScale(1.5);
  scene.renderer->ResetCameraClippingRange();
  const auto whole = pixels(scene.window, scene.renderer);

  scene.window->SetSize(160, 120);
  scene.window->Render();
  // The tiles' matrices round differently, so that a surface may gain or lose a pixel at its edge;
  // the two sides of the cube have more than 30 pixels each.
  EXPECT_LE(differentLines(whole, tiledPixels(scene.window, 2)), 8);
  scene.pass->TileMarginsOff();
  EXPECT_GE(differentLines(whole, tiledPixels(scene.window, 2)), 30);
}

TEST(DepthSilhouettePass, ChangesNothingButTheLine)
{
  for (const int samples : { 0, 8 })
  {
    Scene scene(samples);
    const auto with = pixels(scene.window, scene.renderer);
    const auto depth = depthOf(scene.window, scene.renderer);
    scene.pass->LineVisibilityOff();
    const auto without = pixels(scene.window, scene.renderer);
    const auto depthWithout = depthOf(scene.window, scene.renderer);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t pixel = 0; pixel < with.size() / 3; ++pixel)
    {
      EXPECT_FALSE(isLine(without, pixel));
      for (int channel = 0; channel < 3 && !isLine(with, pixel); ++channel)
      {
        EXPECT_EQ(with[3 * pixel + channel], without[3 * pixel + channel]) << "pixel " << pixel;
      }
      EXPECT_EQ(depth->GetPointData()->GetScalars()->GetTuple1(pixel),
        depthWithout->GetPointData()->GetScalars()->GetTuple1(pixel));
    }
    scene.renderer->SetPass(nullptr);
    EXPECT_EQ(pixels(scene.window, scene.renderer), without);
  }
}

TEST(DepthSilhouettePass, SurvivesResizeReleaseAndEmptyScenes)
{
  Scene scene;
  expectAgreement(scene, scene.renderer, scene.pass);
  scene.window->SetSize(150, 200);
  expectAgreement(scene, scene.renderer, scene.pass);
  scene.pass->ReleaseGraphicsResources(scene.window);
  expectAgreement(scene, scene.renderer, scene.pass);
  scene.window->Finalize();
  scene.window->SetSize(Width, Height);
  expectAgreement(scene, scene.renderer, scene.pass);
  scene.renderer->RemoveAllViewProps();
  const auto rgb = pixels(scene.window, scene.renderer);
  for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel)
  {
    EXPECT_FALSE(isLine(rgb, pixel));
  }
}

TEST(DepthSilhouettePass, OpacityBlends)
{
  Scene scene;
  scene.pass->SetColor(0.0, 0.0, 0.0);
  scene.pass->SetOpacity(0.0);
  const auto clear = pixels(scene.window, scene.renderer);
  scene.pass->LineVisibilityOff();
  EXPECT_EQ(pixels(scene.window, scene.renderer), clear);
  scene.pass->LineVisibilityOn();
  scene.pass->SetOpacity(0.5);
  const auto half = pixels(scene.window, scene.renderer);
  const auto lines = filterLines(depthOf(scene.window, scene.renderer), scene.pass);
  int wrong = 0;
  for (std::size_t value = 0; value < half.size(); ++value)
  {
    const int expected = lines[value / 3] > 0.0F ? clear[value] / 2 : clear[value];
    wrong += std::abs(half[value] - expected) > 1;
  }
  EXPECT_LE(wrong, 3); // one pixel may lie on the threshold itself
}

TEST(DepthSilhouettePass, WrongParametersAreReportedAndDrawNoLines)
{
  Scene scene;
  scene.pass->LineVisibilityOff();
  const auto without = pixels(scene.window, scene.renderer);
  scene.pass->LineVisibilityOn();
  std::string errors;
  vtkNew<vtkCallbackCommand> catcher;
  catcher->SetClientData(&errors);
  catcher->SetCallback([](vtkObject*, unsigned long, void* data, void* text)
    { *static_cast<std::string*>(data) = static_cast<const char*>(text); });
  scene.pass->AddObserver(vtkCommand::ErrorEvent, catcher);
  for (const double wrong : { -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    scene.pass->SetThreshold(wrong);
    EXPECT_EQ(pixels(scene.window, scene.renderer), without);
    EXPECT_NE(errors.find("Threshold"), std::string::npos);
    scene.pass->SetThreshold(0.0);
    scene.pass->SetBackgroundDepth(wrong);
    EXPECT_EQ(pixels(scene.window, scene.renderer), without);
    EXPECT_NE(errors.find("BackgroundDepth"), std::string::npos);
    scene.pass->SetBackgroundDepth(0.0);
  }
}
