// SPDX-License-Identifier: BSD-3-Clause
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

namespace
{
constexpr int Width = 321;
constexpr int Height = 243;

void addProp(vtkRenderer* renderer, vtkPolyDataAlgorithm* source, double red)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, 0.7, 0.3);
  renderer->AddActor(actor);
}

/// Three spheres and a cone in front of a slanted plane that leaves room for background.
void fillScene(vtkRenderer* renderer)
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
std::vector<unsigned char> pixels(vtkRenderWindow* window, vtkRenderer* renderer)
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
std::vector<unsigned char> tiledPixels(vtkRenderWindow* window, int scale)
{
  vtkNew<vtkWindowToImageFilter> tiles;
  tiles->SetInput(window);
  tiles->SetScale(scale);
  tiles->ReadFrontBufferOff();
  tiles->Update();
  auto* rgb = vtkUnsignedCharArray::SafeDownCast(tiles->GetOutput()->GetPointData()->GetScalars());
  return { rgb->GetPointer(0), rgb->GetPointer(0) + rgb->GetNumberOfValues() };
}

bool isLine(const std::vector<unsigned char>& rgb, std::size_t pixel)
{
  return rgb[3 * pixel] == 255 && rgb[3 * pixel + 1] == 0 && rgb[3 * pixel + 2] == 255;
}

/// Number of pixels that have a line in one picture and none in the other.
int differentLines(
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
vtkSmartPointer<vtkImageData> depthOf(vtkRenderWindow* window, vtkRenderer* renderer)
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

std::vector<float> filterLines(vtkImageData* depth, vtkDepthSilhouettePass* pass)
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
void expectAgreement(Scene& scene, vtkRenderer* renderer, vtkDepthSilhouettePass* pass)
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
