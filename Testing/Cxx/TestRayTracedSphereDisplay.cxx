// SPDX-License-Identifier: BSD-3-Clause
// Cropping, smooth edges, coarse frames while dragging, and translucent spheres.
// Real windows: these tests need a display with OpenGL, Xvfb for instance.
#include "RayTracedSphereTestScene.h"
#include "VTKErrors.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
int litPixels(const Picture& picture)
{
  int lit = 0;
  for (int y = 0; y < picture.height(); ++y)
  {
    for (int x = 0; x < picture.width(); ++x)
    {
      const Pixel p = picture.at(x, y);
      lit += p[0] + p[1] + p[2] > 0;
    }
  }
  return lit;
}

TEST(RayTracedSphereCropping, RangesAndPlanesShowTheRestAlone)
{
  Scene scene(lattice(4));
  const Picture all = grab(scene.window);
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 64);
  scene.mapper->AddCropRange("value", 0, 0, 15); // the layer z = 0
  const Picture byValue = grab(scene.window);
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 16);
  EXPECT_EQ(scene.mapper->GetNumberOfSpheres(), 64);
  scene.mapper->RemoveAllCropRanges();

  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 0.5);
  plane->SetNormal(0, 0, -1);
  scene.mapper->AddClippingPlane(plane);
  EXPECT_EQ(differingShare(grab(scene.window), byValue, 0), 0);
  EXPECT_GT(differingShare(all, byValue), 0.02);
  plane->SetOrigin(0, 0, -1);
  EXPECT_EQ(litPixels(grab(scene.window)), 0) << "a plane that was moved";
  scene.mapper->RemoveAllClippingPlanes();
  EXPECT_EQ(differingShare(grab(scene.window), all, 0), 0);
}

TEST(RayTracedSphereCropping, ReleasedSpheresAreNotCounted)
{
  Scene scene(lattice(4));
  scene.mapper->AddCropRange("value", 0, 0, 15);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 16);
  scene.mapper->ReleaseSpheres();
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 0);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 16);
}

TEST(RayTracedSphereCropping, PlanesAreThoseOfTheWorld)
{
  Scene scene({ { 0, 0, 0, 1 }, { 3, 0, 0, 1 } }, 200, 100);
  scene.actor->SetPosition(100, 0, 0);
  scene.renderer->ResetCamera();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(101, 0, 0);
  plane->SetNormal(-1, 0, 0);
  scene.mapper->AddClippingPlane(plane);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 1);
  EXPECT_EQ(layer(scene, "id")->GetRange()[1], 0);
}

TEST(RayTracedSphereCropping, AnArrayThatIsNotThereIsNamedOnce)
{
  Scene scene({ { 0, 0, 0, 1 } });
  WarningCatcher warnings(scene.mapper);
  scene.mapper->AddCropRange("nothing", 0, 0, 1);
  scene.window->Render();
  scene.window->Render();
  ASSERT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("nothing"), std::string::npos);
  EXPECT_NE(warnings.text().find("radius, value"), std::string::npos) << "lists what there is";
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 1);
}

TEST(RayTracedSphereEdges, AreSmoothAtOnceAndStepByStep)
{
  Scene scene({ { 0, 0, 0, 1 } }, 100, 100);
  scene.makeFlat(1, 1, 1);
  const auto greys = [](const Picture& picture)
  {
    int count = 0;
    for (int i = 0; i < 100 * 100; ++i)
    {
      const int value = picture.at(i % 100, i / 100)[0];
      count += value > 20 && value < 235;
    }
    return count;
  };
  EXPECT_EQ(greys(grab(scene.window)), 0);
  scene.mapper->SetSamplesPerPixel(16);
  const Picture atOnce = grab(scene.window);
  EXPECT_EQ(scene.mapper->GetNumberOfSamples(), 16);
  EXPECT_GT(greys(atOnce), 50);

  int updates = 0;
  scene.mapper->ProgressiveOn();
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&updates);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  scene.mapper->AddObserver(vtkCommand::UpdateEvent, counter);
  scene.renderer->GetActiveCamera()->Azimuth(360); // rounding makes it another view
  scene.renderer->GetActiveCamera()->SetViewAngle(30.0000001);
  EXPECT_EQ(greys(grab(scene.window)), 0) << "the first picture comes at once";
  for (int i = 2; i <= 16; ++i)
  {
    scene.window->Render();
    EXPECT_EQ(scene.mapper->GetNumberOfSamples(), i);
  }
  EXPECT_EQ(updates, 15) << "the last picture asks for no more";
  EXPECT_LT(differingShare(grab(scene.window), atOnce, 1), 0.002);
  EXPECT_EQ(updates, 15);
  scene.actor->GetProperty()->SetColor(1, 0, 0);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfSamples(), 1) << "any change begins anew";
}

TEST(RayTracedSphereEdges, DepthIsThatOfThePixelsCentres)
{
  Scene scene(lattice(2), 80, 80);
  const auto depth = [&]
  {
    scene.window->Render();
    vtkNew<vtkFloatArray> values;
    scene.window->GetZbufferData(0, 0, 79, 79, values);
    return std::vector<float>(values->GetPointer(0), values->GetPointer(0) + 80 * 80);
  };
  const std::vector<float> before = depth();
  scene.mapper->SetSamplesPerPixel(9);
  EXPECT_EQ(depth(), before);
}

TEST(RayTracedSphereInteraction, FramesAreCoarseWhileDraggingAndFullAfterwards)
{
  Scene scene(lattice(8), 400, 400);
  scene.renderer->GetActiveCamera()->Azimuth(20);
  scene.renderer->ResetCamera();
  const Picture still = grab(scene.window);
  const auto pixels = [&] { return scene.mapper->GetLayers()->GetNumberOfPoints(); };
  ASSERT_EQ(pixels(), 400 * 400);

  scene.window->SetDesiredUpdateRate(15);
  scene.mapper->SetInteractiveRate(1000); // no machine can do that
  scene.window->Render();
  EXPECT_EQ(pixels(), 400 * 400) << "the full frame of this view is there";
  for (int i = 0; i < 4; ++i)
  {
    scene.renderer->GetActiveCamera()->Azimuth(1);
    scene.window->Render();
  }
  EXPECT_LE(pixels(), 200 * 200);
  // The coarse frame's depth is that of the present view: a corner of it is a full ray's depth.
  vtkNew<vtkFloatArray> coarse, full;
  scene.window->GetZbufferData(0, 0, 399, 399, coarse);
  scene.window->SetDesiredUpdateRate(0.0001);
  scene.window->Render();
  EXPECT_EQ(pixels(), 400 * 400) << "full again, of the same view";
  scene.window->GetZbufferData(0, 0, 399, 399, full);
  int close = 0, seen = 0;
  for (vtkIdType i = 0; i < 400 * 400; ++i)
  {
    seen += full->GetValue(i) < 1;
    close += full->GetValue(i) < 1 && std::abs(coarse->GetValue(i) - full->GetValue(i)) < 0.02;
  }
  EXPECT_GT(seen, 30000);
  EXPECT_GT(close, 0.7 * seen);

  scene.renderer->GetActiveCamera()->Azimuth(-4);
  EXPECT_LT(differingShare(grab(scene.window), still), 0.001);
  scene.window->SetDesiredUpdateRate(15);
  scene.mapper->SetInteractiveRate(0);
  scene.renderer->GetActiveCamera()->Azimuth(3);
  scene.window->Render();
  EXPECT_EQ(pixels(), 400 * 400) << "a rate of 0 asks for full frames";
}

/// Three spheres in a row along the view, a plane between the second and the third.
class Translucency : public testing::TestWithParam<bool>
{
protected:
  Translucency()
    : scene({ { 0, 0, 4, 1 }, { 0, 0, 0, 1 }, { 0, 0, -8, 1 } }, 61, 61)
  {
    scene.renderer->SetUseDepthPeeling(GetParam());
    scene.renderer->SetMaximumNumberOfPeels(10);
    scene.renderer->SetOcclusionRatio(0);
    scene.window->SetAlphaBitPlanes(1);
    scene.makeFlat(1, 0, 0);
    scene.renderer->GetActiveCamera()->ParallelProjectionOn();
    scene.renderer->ResetCamera();
  }

  /// A square at a depth.
  void addPlane(double z, double opacity)
  {
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(-2, -2, z);
    source->SetPoint1(2, -2, z);
    source->SetPoint2(-2, 2, z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetAmbient(1);
    actor->GetProperty()->SetDiffuse(0);
    actor->GetProperty()->SetColor(0, 0, 1);
    actor->GetProperty()->SetOpacity(opacity);
    scene.renderer->AddActor(actor);
  }

  Pixel middle() { return grab(scene.window).at(30, 30); }

  Scene scene;
};

TEST_P(Translucency, SpheresBehindShineThrough)
{
  EXPECT_EQ(middle()[0], 255);
  scene.actor->GetProperty()->SetOpacity(0.5);
  EXPECT_NEAR(middle()[0], 255 * (1 - 0.125), 3);
  EXPECT_EQ(scene.mapper->GetNumberOfLayers(), 3);
  scene.actor->GetProperty()->SetOpacity(1);
  EXPECT_EQ(middle()[0], 255);
  EXPECT_EQ(scene.mapper->GetNumberOfLayers(), 1);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
}

TEST_P(Translucency, OpaquePropsHideWhatIsBehindThem)
{
  scene.actor->GetProperty()->SetOpacity(0.5);
  addPlane(-4, 1);
  const Pixel p = middle();
  if (GetParam())
  {
    // VTK 9.2 peels only one layer before an opaque prop, of planes too.
    EXPECT_LE(p[0], 255 * 0.75 + 3);
    EXPECT_GE(p[2], 255 * 0.25 - 3);
    return;
  }
  EXPECT_NEAR(p[0], 255 * 0.75, 3);
  EXPECT_NEAR(p[2], 255 * 0.25, 3);
}

INSTANTIATE_TEST_SUITE_P(RayTracedSphere, Translucency, testing::Bool(),
  [](const auto& peeling) { return peeling.param ? "WithDepthPeeling" : "WithoutDepthPeeling"; });

using PeeledTranslucency = Translucency;

TEST_P(PeeledTranslucency, LookupTablesGiveOpacityToParticles)
{
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(3);
  table->SetTableValue(0, 1, 1, 1, 0);   // the first is not there
  table->SetTableValue(1, 1, 0, 0, 0.5); // half of red
  table->SetTableValue(2, 0, 1, 0, 1);   // before green
  table->SetTableRange(0, 2);
  scene.mapper->ScalarVisibilityOn();
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("value");
  scene.mapper->SetLookupTable(table);
  scene.mapper->UseLookupTableScalarRangeOn();
  const Pixel p = middle();
  EXPECT_NEAR(p[0], 127, 2);
  EXPECT_NEAR(p[1], 127, 2);
  EXPECT_EQ(p[2], 0);
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 2);
}

TEST_P(PeeledTranslucency, TranslucentPropsComeBetweenTheLayers)
{
  scene.actor->GetProperty()->SetOpacity(0.5);
  addPlane(-4, 0.5);
  const Pixel p = middle();
  // Front to back: red, red, blue, red, each half of what the others leave.
  EXPECT_NEAR(p[0], 255 * (0.5 + 0.25 + 0.0625), 3);
  EXPECT_NEAR(p[2], 255 * 0.125, 3);
}

INSTANTIATE_TEST_SUITE_P(RayTracedSphere, PeeledTranslucency, testing::Values(true));
}
