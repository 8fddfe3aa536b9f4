// SPDX-License-Identifier: BSD-3-Clause
// Smooth edges by several rays a pixel, and the resolution while the view is dragged.
#include "InteractiveResolution.h"
#include "SphereRenderer.h"
#include "TestViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace po;

TEST(SmoothEdges, PlacesAreSpreadEvenly)
{
  EXPECT_EQ(samplePlace(0).x, 0.5);
  EXPECT_EQ(samplePlace(0).y, 0.5);
  for (const int n : { 4, 16, 64 })
  {
    // Each half and each quarter of the pixel gets its share of the places, within one and a half.
    int left = 0, corner = 0;
    for (int i = 0; i < n; ++i)
    {
      left += samplePlace(i).x < 0.5;
      corner += samplePlace(i).x < 0.5 && samplePlace(i).y < 0.5;
    }
    EXPECT_NEAR(left, n / 2.0, 1.5) << n;
    EXPECT_NEAR(corner, n / 4.0, 1.5) << n;
  }
}

TEST(SmoothEdges, AlphaIsTheShareOfThePixelThatADiscCovers)
{
  // A disc of radius 10 pixels around the middle of the window, in parallel projection.
  SphereRenderer renderer;
  renderer.setCloud(makeSphereCloud(
    1,
    [](std::size_t) {
      return Vec3d{ 0, 0, 0 };
    },
    [](std::size_t) { return 10.0; }));
  const Camera camera{ translation(0, 0, -50), parallel(-16, 16, -16, 16, 1, 100), 32, 32 };
  ASSERT_TRUE(renderer.trace(camera, Identity));
  Style style;
  style.material.mode = ShadingMode::AmbientOcclusion; // without textures: white
  const auto largestError = [&]
  {
    double largest = 0;
    for (int pixel = 0; pixel < 32 * 32; ++pixel)
    {
      int inside = 0;
      for (int i = 0; i < 64 * 64; ++i)
      {
        const double x = pixel % 32 + (i % 64 + 0.5) / 64 - 16;
        const double y = double(pixel / 32) + (double(i / 64) + 0.5) / 64 - 16;
        inside += x * x + y * y < 100;
      }
      const double alpha = renderer.rgba()[4 * std::size_t(pixel) + 3] / 255.0;
      largest = std::max(largest, std::abs(alpha - inside / 4096.0));
    }
    return largest;
  };
  renderer.shade(style);
  EXPECT_GT(largestError(), 0.4) << "one ray decides for the whole pixel";
  renderer.refine(64);
  EXPECT_EQ(renderer.samples(), 64);
  EXPECT_LT(largestError(), 0.05);

  const std::vector<std::uint8_t> atOnce = renderer.rgba();
  style.material.diffuse = 0.9; // another style, so that it begins anew
  renderer.shade(style);
  EXPECT_EQ(renderer.samples(), 1);
  style.material.diffuse = 1;
  renderer.shade(style);
  for (const int n : { 2, 3, 20, 64 })
  {
    renderer.refine(n);
  }
  EXPECT_EQ(renderer.rgba(), atOnce) << "step by step is the same as at once";
  EXPECT_EQ(renderer.statistics().framesTraced, 1u);
  EXPECT_EQ(renderer.frame().sampleX, 0.5) << "depth and ids stay those of the centres";
}

TEST(InteractiveResolution, FollowsTheTimeThatFramesTake)
{
  InteractiveResolution resolution;
  EXPECT_EQ(resolution.reduction(1000, 1000, 15), 1) << "nothing is known yet";
  for (int i = 0; i < 10; ++i)
  {
    resolution.measured(1000000, 0.59);
  }
  EXPECT_EQ(resolution.reduction(1000, 1000, 15), 3) << "nearly 9 times too slow";
  EXPECT_EQ(resolution.reduction(500, 500, 15), 2);
  EXPECT_EQ(resolution.reduction(1000, 1000, 1), 1);
  EXPECT_EQ(resolution.reduction(1000, 1000, 0), 1);
  for (int i = 0; i < 20; ++i)
  {
    resolution.measured(111111, 0.001);
  }
  EXPECT_EQ(resolution.reduction(1000, 1000, 15), 1) << "fast again";
  for (int i = 0; i < 20; ++i)
  {
    resolution.measured(1000, 100);
  }
  EXPECT_EQ(resolution.reduction(1000, 1000, 15), InteractiveResolution::LargestReduction);
}
}
