// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePassTestScene.h"

#include <gtest/gtest.h>

using namespace silhouette_pass;

namespace
{
/// All ways to set threshold and background.
void expectAgreementForAllParameters(Scene& scene)
{
  for (const double threshold : { 0.0, 0.3 })
  {
    for (const double background : { 0.0, 20.0 })
    {
      SCOPED_TRACE(
        testing::Message() << "Threshold " << threshold << ", BackgroundDepth " << background);
      scene.pass->SetThreshold(threshold);
      scene.pass->SetBackgroundDepth(background);
      expectAgreement(scene, scene.renderer, scene.pass);
    }
  }
}
}

TEST(DepthSilhouettePass, AgreesWithTheFilterInPerspective)
{
  Scene scene;
  expectAgreementForAllParameters(scene);
}

TEST(DepthSilhouettePass, AgreesWithTheFilterInParallelProjection)
{
  Scene scene;
  scene.renderer->GetActiveCamera()->ParallelProjectionOn();
  expectAgreementForAllParameters(scene);
}

TEST(DepthSilhouettePass, AgreesWithTheFilterOffCentreAndClose)
{
  Scene scene;
  vtkCamera* camera = scene.renderer->GetActiveCamera();
  camera->SetWindowCenter(0.3, -0.2);
  camera->Dolly(1.8);
  camera->SetViewAngle(70.0);
  scene.renderer->ResetCameraClippingRange();
  expectAgreement(scene, scene.renderer, scene.pass);
}

TEST(DepthSilhouettePass, AgreesWithTheFilterOnAMultisampledWindow)
{
  Scene scene(8);
  scene.window->Render();
  if (scene.window->GetMultiSamples() < 2)
  {
    GTEST_SKIP() << "this OpenGL has no multisampling";
  }
  expectAgreementForAllParameters(scene);
}

TEST(DepthSilhouettePass, AntialiasedAgreesWithTheFilterToAGreyLevel)
{
  Scene scene;
  // Everything is black but the lines, so that levels are strengths.
  scene.renderer->SetBackground(0, 0, 0);
  vtkActorCollection* actors = scene.renderer->GetActors();
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor())
  {
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0, 0, 0);
  }
  scene.pass->SetColor(1, 1, 1);
  scene.pass->SetThreshold(0.3);
  scene.pass->SetSamples(4);
  scene.pass->SetLineWidth(1.5);
  const auto rgb = pixels(scene.window, scene.renderer);

  scene.pass->LineVisibilityOff();
  scene.window->SetSize(4 * Width, 4 * Height);
  scene.window->Render();
  const auto expected = filterLines(depthOf(scene.window, scene.renderer), scene.pass);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(Width) * Height);
  int lines = 0, different = 0;
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel)
  {
    lines += expected[pixel] > 0;
    different += std::abs(rgb[3 * pixel] - 255 * expected[pixel]) > 1;
  }
  EXPECT_GT(lines, 1000);
  EXPECT_LT(different, lines / 100); // depth buffers of 24 and 32 bits may differ on an edge
}

/// A red mesh with black lines on white: between mesh and line, which covers what is beside the
/// mesh, nothing is white.
TEST(DepthSilhouettePass, BackgroundDoesNotShineThroughBetweenMeshAndLine)
{
  Scene scene;
  scene.renderer->RemoveAllViewProps();
  scene.renderer->SetBackground(1, 1, 1);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(96);
  addProp(scene.renderer, sphere, 1);
  vtkProperty* property = scene.renderer->GetActors()->GetLastActor()->GetProperty();
  property->LightingOff();
  property->SetColor(1, 0, 0);
  scene.renderer->ResetCamera();
  scene.pass->SetColor(0, 0, 0);
  scene.pass->SetSamples(4);
  scene.pass->SetLineWidth(3);
  const auto rgb = pixels(scene.window, scene.renderer);
  const auto isRed = [&rgb](int pixel)
  {
    const unsigned char* color = &rgb[3 * static_cast<std::size_t>(pixel)];
    return color[0] == 255 && color[1] == 0;
  };
  int rims = 0;
  for (int pixel = Width; pixel < Width * (Height - 1); ++pixel)
  {
    if (!isRed(pixel) &&
      (isRed(pixel - 1) || isRed(pixel + 1) || isRed(pixel - Width) || isRed(pixel + Width)))
    {
      EXPECT_LE(rgb[3 * static_cast<std::size_t>(pixel) + 1], 2) << pixel;
      ++rims;
    }
  }
  EXPECT_GT(rims, 200);
}

TEST(DepthSilhouettePass, LinesOfChosenActorsAreHiddenByOthers)
{
  Scene scene;
  auto* last = vtkActor::SafeDownCast(scene.renderer->GetActors()->GetLastActor()); // the plane
  auto* first = vtkActor::SafeDownCast(scene.renderer->GetActors()->GetItemAsObject(0));
  const auto all = pixels(scene.window, scene.renderer);
  const auto count = [](const std::vector<unsigned char>& rgb)
  {
    int lines = 0;
    for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel)
    {
      lines += isLine(rgb, pixel);
    }
    return lines;
  };
  scene.pass->AddActor(first);
  const int opaque = count(pixels(scene.window, scene.renderer));
  EXPECT_GT(opaque, 100);
  EXPECT_LT(opaque, count(all) / 2);
  first->GetProperty()->SetOpacity(0.4); // shows its line all the same
  EXPECT_NEAR(count(pixels(scene.window, scene.renderer)), opaque, 2);
  // The outline of the plane is not drawn over what lies in front of it.
  scene.pass->RemoveAllActors();
  scene.pass->AddActor(last);
  const auto plane = pixels(scene.window, scene.renderer);
  scene.pass->LineVisibilityOff();
  const auto without = pixels(scene.window, scene.renderer);
  EXPECT_GT(count(plane), 100);
  for (std::size_t pixel = 0; pixel < plane.size() / 3; ++pixel)
  {
    const bool onBackground = without[3 * pixel + 2] > 95 && without[3 * pixel] < 30;
    EXPECT_TRUE(!isLine(plane, pixel) || onBackground);
  }
}

TEST(DepthSilhouettePass, AgreesWithTheFilterWithAStencilBuffer)
{
  Scene scene;
  scene.window->SetStencilCapable(1);
  expectAgreement(scene, scene.renderer, scene.pass);
}
