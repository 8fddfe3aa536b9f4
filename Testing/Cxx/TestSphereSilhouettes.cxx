// SPDX-License-Identifier: BSD-3-Clause
#include "RayTracedSphereTestScene.h"

#include "vtkCamera.h"
#include "vtkDepthSilhouettePass.h"
#include "vtkEDLShading.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderStepsPass.h"
#include "vtkSphereSilhouettes.h"

namespace
{
/// White spheres on black, with magenta lines.
struct LineScene : Scene
{
  vtkNew<vtkSphereSilhouettes> silhouettes;

  explicit LineScene(int side = 5)
    : Scene(lattice(side), 240, 180)
  {
    makeFlat(1, 1, 1);
    renderer->SetBackground(0, 0, 0);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->Azimuth(33);
    camera->Elevation(21);
    camera->Zoom(1.4);
    silhouettes->AddActor(actor);
    silhouettes->SetColor(1, 0, 1);
    renderer->AddViewProp(silhouettes);
  }
};

int countLines(const Picture& picture)
{
  int lines = 0;
  for (int y = 0; y < picture.height(); ++y)
  {
    for (int x = 0; x < picture.width(); ++x)
    {
      const Pixel pixel = picture.at(x, y);
      lines += pixel[0] - pixel[1] > 20;
    }
  }
  return lines;
}
}

TEST(SphereSilhouettes, AreThoseOfThePass)
{
  for (const int samples : { 1, 4 })
  {
    LineScene scene;
    scene.silhouettes->SetSamples(samples);
    const Picture ofProp = grab(scene.window);
    EXPECT_GT(countLines(ofProp), 500);
    scene.silhouettes->LineVisibilityOff();
    EXPECT_EQ(countLines(grab(scene.window)), 0);
    vtkNew<vtkRenderStepsPass> steps;
    vtkNew<vtkDepthSilhouettePass> pass;
    pass->SetDelegatePass(steps);
    pass->SetSamples(samples);
    pass->SetColor(1, 0, 1);
    scene.renderer->SetPass(pass);
    EXPECT_EQ(differingShare(grab(scene.window), ofProp, 1), 0) << samples;
  }
}

TEST(SphereSilhouettes, TakeNoNewFrameWhenAParameterChanges)
{
  LineScene scene;
  grab(scene.window);
  const vtkIdType frames = scene.mapper->GetNumberOfTracedFrames();
  const Picture before = grab(scene.window);
  scene.silhouettes->SetLineDensity(0.8);
  scene.silhouettes->SetGreyByJump(true);
  scene.silhouettes->SetSamples(1);
  EXPECT_GT(differingShare(grab(scene.window), before), 0.01);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), frames);
}

TEST(SphereSilhouettes, ContinueAcrossTiles)
{
  LineScene scene(3);
  scene.window->SetSize(480, 360);
  const Picture whole = grab(scene.window);
  scene.window->SetSize(240, 180);
  const Picture tiles = grab(scene.window, 2);
  EXPECT_GT(countLines(whole), 500);
  EXPECT_LT(differingShare(whole, tiles, 8), 2e-4); // the tiles' matrices round differently
}

TEST(SphereSilhouettes, AreHiddenByWhatIsNearerAndKeepTheirDepthToThemselves)
{
  LineScene scene;
  const int all = countLines(grab(scene.window));
  vtkNew<vtkPlaneSource> square; // right before the eye, to the left of the middle
  square->SetOrigin(-1, -1, 0);
  square->SetPoint1(0, -1, 0);
  square->SetPoint2(-1, 1, 0);
  vtkCamera* camera = scene.renderer->GetActiveCamera();
  double eye[3], way[3];
  camera->GetPosition(eye);
  camera->GetDirectionOfProjection(way);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(square->GetOutputPort());
  vtkNew<vtkActor> wall;
  wall->SetMapper(mapper);
  wall->GetProperty()->SetColor(0, 1, 0);
  wall->GetProperty()->LightingOff();
  wall->SetUserMatrix(nullptr);
  wall->SetPosition(eye[0] + 2 * way[0], eye[1] + 2 * way[1], eye[2] + 2 * way[2]);
  wall->SetOrientation(camera->GetOrientation());
  wall->SetOrientation(
    -camera->GetOrientation()[0], -camera->GetOrientation()[1], -camera->GetOrientation()[2]);
  scene.renderer->AddActor(wall);
  scene.renderer->ResetCameraClippingRange();
  const Picture hidden = grab(scene.window);
  EXPECT_LT(countLines(hidden), 0.8 * all);
  EXPECT_GT(countLines(hidden), 0.2 * all);
  // Behind everything: the outline is drawn over it.
  wall->SetPosition(eye[0] + 60 * way[0], eye[1] + 60 * way[1], eye[2] + 60 * way[2]);
  wall->SetScale(40);
  scene.renderer->ResetCameraClippingRange();
  EXPECT_NEAR(countLines(grab(scene.window)), all, 0.1 * all);
}

TEST(SphereSilhouettes, DarkenTheColourOfTheSpheres)
{
  LineScene scene;
  scene.makeFlat(1, 0.5, 0);
  scene.silhouettes->SetSamples(1);
  scene.silhouettes->SetDarken(true);
  const Picture picture = grab(scene.window);
  int lines = 0;
  for (int y = 0; y < picture.height(); ++y)
  {
    for (int x = 0; x < picture.width(); ++x)
    {
      const Pixel pixel = picture.at(x, y);
      const bool isSphere = largestDifference(pixel, { 255, 128, 0 }) < 2;
      const bool isLine = largestDifference(pixel, { 89, 45, 0 }) < 2;
      lines += isLine;
      EXPECT_TRUE(isSphere || isLine || largestDifference(pixel, { 0, 0, 0 }) == 0);
    }
  }
  EXPECT_GT(lines, 500);
}

/// The same lines as on opaque spheres: of the fronts that are seen first.
TEST(SphereSilhouettes, AreShownOnTranslucentSpheresToo)
{
  LineScene scene;
  scene.silhouettes->SetSamples(1);
  const Picture opaque = grab(scene.window);
  scene.actor->GetProperty()->SetOpacity(0.4);
  const Picture translucent = grab(scene.window);
  const auto isLine = [](const Picture& picture, int x, int y) {
    return largestDifference(picture.at(x, y), { 255, 0, 255 }) < 2;
  };
  int lines = 0;
  for (int y = 0; y < opaque.height(); ++y)
  {
    for (int x = 0; x < opaque.width(); ++x)
    {
      EXPECT_EQ(isLine(translucent, x, y), isLine(opaque, x, y)) << x << ", " << y;
      lines += isLine(translucent, x, y);
    }
  }
  EXPECT_GT(lines, 500);
}

/// Eye-dome lighting darkens what the prop drew, lines included; those of a pass around it stay.
TEST(SphereSilhouettes, GoWithEyeDomeLighting)
{
  LineScene scene;
  scene.silhouettes->SetSamples(1);
  const int lines = countLines(grab(scene.window));
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkEDLShading> eyeDome;
  eyeDome->SetDelegatePass(steps);
  scene.renderer->SetPass(eyeDome);
  scene.silhouettes->LineVisibilityOff();
  const Picture shaded = grab(scene.window);
  scene.silhouettes->LineVisibilityOn();
  EXPECT_NEAR(countLines(grab(scene.window)), lines, 0.05 * lines);

  scene.silhouettes->LineVisibilityOff();
  vtkNew<vtkDepthSilhouettePass> pass;
  pass->SetDelegatePass(eyeDome);
  pass->SetSamples(1);
  pass->SetColor(1, 0, 1);
  scene.renderer->SetPass(pass);
  const Picture both = grab(scene.window);
  EXPECT_EQ(countLines(both), lines);
  EXPECT_LT(differingShare(both, shaded), 1.1 * lines / (both.width() * both.height()));
}

TEST(SphereSilhouettes, AreFollowedByFXAAAndDrawnInSeveralViewports)
{
  LineScene scene;
  const int lines = countLines(grab(scene.window));
  scene.renderer->UseFXAAOn();
  EXPECT_NEAR(countLines(grab(scene.window)), lines, 0.3 * lines);
  scene.renderer->UseFXAAOff();
  scene.renderer->SetViewport(0, 0, 0.5, 1);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkRayTracedSphereMapper> mapper;
  mapper->SetInputData(makeBalls(lattice(3)));
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkSphereSilhouettes> silhouettes;
  silhouettes->AddActor(actor);
  silhouettes->SetColor(1, 0, 1);
  second->AddActor(actor);
  second->AddViewProp(silhouettes);
  scene.window->AddRenderer(second);
  second->ResetCamera();
  const Picture both = grab(scene.window);
  int left = 0, right = 0;
  for (int y = 0; y < both.height(); ++y)
  {
    for (int x = 0; x < both.width(); ++x)
    {
      const Pixel pixel = both.at(x, y);
      (x < 120 ? left : right) += pixel[0] - pixel[1] > 20;
    }
  }
  EXPECT_GT(left, 200);
  EXPECT_GT(right, 200);
}
