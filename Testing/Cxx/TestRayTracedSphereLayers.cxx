// SPDX-License-Identifier: BSD-3-Clause
// Layers of any size, scenes that mappers share, and memory that is given back.
#include "RayTracedSphereTestScene.h"
#include "VTKErrors.h"

#include "vtkCamera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
vtkDataArray* layerOf(vtkImageData* layers, const char* name)
{
  return layers->GetPointData()->GetArray(name);
}

/// Share of the pixels whose values are not equal.
double differingShare(vtkDataArray* a, vtkDataArray* b)
{
  EXPECT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  vtkIdType different = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < a->GetNumberOfComponents(); ++k)
    {
      if (a->GetComponent(i, k) != b->GetComponent(i, k))
      {
        ++different;
        break;
      }
    }
  }
  return double(different) / double(a->GetNumberOfTuples());
}

TEST(RayTracedSphereLayers, OfTheWindowsSizeAreThoseOfTheWindow)
{
  Scene scene(lattice(4));
  scene.window->Render();
  const auto layers = scene.mapper->RenderLayers(scene.renderer, scene.actor, 160, 120);
  for (const char* name : { "RGBA", "Z", "AO", "N", "id" })
  {
    EXPECT_EQ(differingShare(layerOf(layers, name), layer(scene, name)), 0) << name;
  }
}

TEST(RayTracedSphereLayers, AreLargerThanAnyWindowAndTracedInParts)
{
  for (const int parallel : { 0, 1 })
  {
    Scene scene(lattice(4));
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel);
    scene.window->Render();
    // 6.25 million pixels: two parts. Odd multiples of the size keep the pixels' centres.
    const int times = 19;
    const int width = 160 * times, height = 120 * times;
    const auto large = scene.mapper->RenderLayers(scene.renderer, scene.actor, width, height);
    ASSERT_EQ(large->GetNumberOfPoints(), vtkIdType(width) * height);
    int different = 0;
    double farthest = 0;
    for (int y = 0; y < 120; ++y)
    {
      for (int x = 0; x < 160; ++x)
      {
        const vtkIdType small = vtkIdType(y) * 160 + x;
        const vtkIdType same =
          (vtkIdType(y) * times + times / 2) * width + vtkIdType(x) * times + times / 2;
        const bool sameSphere =
          layer(scene, "id")->GetComponent(small, 0) == layerOf(large, "id")->GetComponent(same, 0);
        different += !sameSphere;
        if (sameSphere && layer(scene, "id")->GetComponent(small, 0) >= 0)
        {
          farthest = std::max(farthest,
            std::abs(layer(scene, "Z")->GetComponent(small, 0) -
              layerOf(large, "Z")->GetComponent(same, 0)));
        }
      }
    }
    EXPECT_LE(different, 4) << "rays on rims may be rounded otherwise";
    EXPECT_LT(farthest, 1e-4);
  }
}

TEST(RayTracedSphereLayers, LeaveTheWindowAsItWas)
{
  Scene scene(lattice(3));
  const Picture before = grab(scene.window);
  const vtkIdType points = scene.mapper->GetLayers()->GetNumberOfPoints();
  EXPECT_EQ(
    scene.mapper->RenderLayers(scene.renderer, scene.actor, 50, 70)->GetNumberOfPoints(), 50 * 70);
  EXPECT_EQ(scene.mapper->GetLayers()->GetNumberOfPoints(), points);
  EXPECT_EQ(differingShare(before, grab(scene.window), 0), 0);
}

TEST(RayTracedSphereLayers, SizesOutOfRangeAreRefused)
{
  Scene scene(lattice(2));
  ErrorCatcher errors(scene.mapper);
  EXPECT_EQ(scene.mapper->RenderLayers(scene.renderer, scene.actor, 0, 10)->GetNumberOfPoints(), 0);
  EXPECT_EQ(
    scene.mapper->RenderLayers(scene.renderer, scene.actor, 10, 70000)->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.count(), 2);
}

TEST(RayTracedSphereScenes, EqualSpheresShareOneAndTheLastUserTakesItAway)
{
  ASSERT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 0);
  {
    Scene first(lattice(3));
    Scene second(lattice(3));
    first.window->Render();
    second.window->Render();
    EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 1);
    EXPECT_EQ(differingShare(grab(first.window), grab(second.window), 0), 0);
    Scene third(lattice(2));
    third.window->Render();
    EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 2);
    second.mapper->SetRadiusScale(0.5);
    second.window->Render();
    EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 3);
    first.mapper->ReleaseSpheres();
    EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 2);
    const Picture again = grab(first.window);
    EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 3);
    EXPECT_NE(again.at(80, 60), again.at(0, 0));
  }
  EXPECT_EQ(vtkRayTracedSphereMapper::GetNumberOfScenes(), 0);
}
}
