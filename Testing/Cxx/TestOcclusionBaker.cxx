// SPDX-License-Identifier: BSD-3-Clause
#include "Constants.h"
#include "OcclusionBaker.h"
#include "ReferenceBake.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace
{
using po::Pi;

TEST(OcclusionBaker, ALoneSphereIsExactlyOpen)
{
  for (const int resolution : { 1, 2, 3, 16, 64 })
  {
    const po::BakeResult result = bake({ { 7, -3, 1e5f, 0.01f } }, floatSettings(resolution, 49));
    ASSERT_EQ(result.table.rows, 1);
    for (const float value : result.table.floats)
    {
      EXPECT_EQ(value, 1.0f);
    }
    EXPECT_EQ(result.mean[0], 1.0f);
  }
}

TEST(OcclusionBaker, ADistantSphereTakesItsShareOfTheSky)
{
  // Oracle: a sphere of radius R at distance d, wholly above the horizon at angle theta from the
  // normal, takes cos(theta) (R/d)^2 of the cosine-weighted sky; averaged over the texel. Texels
  // that it is wholly below are exactly open. 4 binomial standard errors, which stratification can
  // only lower.
  constexpr int resolution = 16;
  constexpr int samples = 1024;
  const std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 }, { 2, 1, 2, 1.25f } };
  const po::BakeResult result = bake(spheres, floatSettings(resolution, samples));
  const po::Vec3d other = spheres[1].center().as<double>();
  const double radius = spheres[1].radius;
  int above = 0;
  int below = 0;
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = 0; column < resolution; ++column)
    {
      constexpr int side = 24;
      double occluded = 0;
      double lowest = HUGE_VAL;
      double highest = -HUGE_VAL;
      for (int k = 0; k < side * side; ++k)
      {
        const po::Vec3d n =
          po::texelPoint(resolution, row, column, (k % side + 0.5) / side, (k / side + 0.5) / side);
        const po::Vec3d d = other - n;
        const double height = po::dot(n, d); // of the centre above the horizon plane
        occluded += height / po::length(d) * radius * radius / po::dot(d, d) / (side * side);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
      }
      const double value = texelValue(result, 0, po::texelIndex(resolution, row, column));
      if (lowest > radius + 0.05)
      {
        const double error = std::sqrt(occluded * (1 - occluded) / samples);
        EXPECT_NEAR(value, 1 - occluded, 4 * error) << row << " " << column;
        ++above;
      }
      else if (highest < -radius - 0.05)
      {
        EXPECT_EQ(value, 1.0) << row << " " << column;
        ++below;
      }
    }
  }
  EXPECT_GE(above, 20);
  EXPECT_GT(below, 60);
}

TEST(OcclusionBaker, ASphereOnAHugeSphereSeesHalfTheSky)
{
  // Over a plane the visible share is (1 + n.up) / 2, its mean 1/2. The ball is 100,000 radii
  // large, so its horizon dips by at most sqrt(4 / 100,000) below that of a plane.
  constexpr int resolution = 16;
  constexpr int samples = 400;
  const std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 }, { 0, 0, -100001, 100000 } };
  const po::BakeResult result = bake(spheres, floatSettings(resolution, samples));
  EXPECT_NEAR(result.mean[0], 0.5, 0.004);
  for (int row = 0; row < resolution; ++row)
  {
    const double top = std::cos(Pi * row / resolution);
    const double bottom = std::cos(Pi * (row + 1) / resolution);
    const double plane = (1 + (top + bottom) / 2) / 2;
    double mean = 0;
    for (int column = 0; column < resolution; ++column)
    {
      mean += texelValue(result, 0, po::texelIndex(resolution, row, column)) / resolution;
    }
    const double error = 0.5 / std::sqrt(samples * resolution);
    EXPECT_GT(mean, plane - 4 * error) << row;
    EXPECT_LT(mean, plane + 4 * error + std::sqrt(4.0 / 100000) / 2) << row;
  }
}

TEST(OcclusionBaker, AClosedShellIsDarkInside)
{
  std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
  addClosedShell(spheres, 8, 2, 400);
  const po::BakeResult result = bake(spheres, floatSettings(8, 49));
  EXPECT_EQ(result.mean[0], 0.0f);
  for (std::size_t texel = 0; texel < 64; ++texel)
  {
    EXPECT_EQ(texelValue(result, 0, texel), 0);
  }
  EXPECT_GE(result.counters.particlesDark, 1u);
  EXPECT_GT(result.mean[1], 0.0f); // the shell itself is lit from outside
}

TEST(OcclusionBaker, RaysEndAtTheMaximumDistance)
{
  const std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 }, { 0, 0, 5, 1 } };
  po::BakeSettings settings = floatSettings(8, 64);
  settings.maximumDistance = 2.9; // the nearest points are 3 apart
  EXPECT_EQ(bake(spheres, settings).mean[0], 1.0f);
  settings.maximumDistance = 3.5;
  const po::BakeResult near = bake(spheres, settings);
  EXPECT_LT(near.mean[0], 1.0f);
  settings.maximumDistance = 0;
  EXPECT_LT(bake(spheres, settings).mean[0], near.mean[0]);

  // Against the independent judge: difference of two estimates, 5 standard errors.
  const po::BakeResult result = [&]
  {
    settings.maximumDistance = 3.5;
    settings.samplesPerTexel = 4096;
    return bake(spheres, settings);
  }();
  const judge::Judge judge = judgeOf(spheres);
  for (int column = 0; column < 8; ++column)
  {
    const double expected = judge.look(0, 8, 0, column, 16384, 3.5).value();
    const double error =
      std::sqrt(std::max(expected * (1 - expected), 1e-4) * (1.0 / 4096 + 1.0 / 16384));
    EXPECT_NEAR(texelValue(result, 0, po::texelIndex(8, 0, column)), expected, 5 * error);
  }
}

TEST(OcclusionBaker, AGradientIsIntegratedAgainstTheCosine)
{
  // (1/pi) integral of (b + (t - b)(1 + w.up)/2) cos = b + (t - b)(1/2 + n.up/3).
  constexpr int resolution = 8;
  constexpr int samples = 2500;
  po::BakeSettings settings = floatSettings(resolution, samples);
  settings.background = po::GradientBackground{ { 0, 0, 1 }, 0.2, 1.4 };
  const po::BakeResult result = bake({ { 1, 2, 3, 4 } }, settings);
  const double error =
    1.2 / 2 * 0.5 / std::sqrt(samples); // standard deviation below 1/4 of the span
  for (int row = 0; row < resolution; ++row)
  {
    const double height =
      (std::cos(Pi * row / resolution) + std::cos(Pi * (row + 1) / resolution)) / 2;
    for (int column = 0; column < resolution; ++column)
    {
      EXPECT_NEAR(texelValue(result, 0, po::texelIndex(resolution, row, column)),
        0.2 + 1.2 * (0.5 + height / 3), 4 * error);
    }
  }
  EXPECT_NEAR(result.mean[0], 0.8, 4 * error / resolution);
}

TEST(OcclusionBaker, MatchesAnIndependentJudgeWhereSpheresOverlap)
{
  // Per texel |z| < 5: the variance of the stratified estimate is at most the binomial one. Texels
  // mostly inside are left to the dilation test.
  const std::vector<po::Sphere> spheres = mixedScene();
  constexpr int resolution = 6;
  constexpr int samples = 1600;
  po::BakeSettings settings = floatSettings(resolution, samples);
  const po::BakeResult result = bake(spheres, settings);
  const judge::Judge judge = judgeOf(spheres);
  double bias = 0;
  int texels = 0;
  for (std::size_t id = 0; id < spheres.size(); id += 6)
  {
    for (int row = 0; row < resolution; ++row)
    {
      for (int column = 0; column < resolution; ++column)
      {
        const judge::Texel truth = judge.look(id, resolution, row, column, 16384);
        if (truth.outsideShare() < 0.3)
        {
          continue;
        }
        const double rays = samples * truth.outsideShare();
        const double variance = std::max(truth.value() * (1 - truth.value()), 0.002);
        const double error = std::sqrt(variance * (1 / rays + 1.0 / truth.outside));
        const double value = texelValue(result, id, po::texelIndex(resolution, row, column));
        EXPECT_NEAR(value, truth.value(), 5 * error) << id << " " << row << " " << column;
        bias += value - truth.value();
        ++texels;
      }
    }
  }
  ASSERT_GT(texels, 100);
  EXPECT_LT(std::abs(bias / texels), 0.002);
}

TEST(OcclusionBaker, SamplesInsideOtherSpheresGetNoRayAndNoWeight)
{
  // Two unit spheres one radius apart: each loses the cap beyond x = 1/2, a quarter of its area.
  const std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 }, { 1, 0, 0, 1 } };
  po::BakeSettings settings = floatSettings(32, 49);
  settings.dilateInside = false;
  const po::BakeResult result = bake(spheres, settings);
  // Every sample is counted once; texels cut by the rim may get up to 8 sets of 49.
  const std::uint64_t drawn = result.counters.rays + result.counters.samplesInside;
  const std::uint64_t sampled = 2 * 32 * 32 - result.counters.texelsInside;
  EXPECT_GE(drawn, 49 * sampled);
  EXPECT_LT(drawn, 49 * sampled + 8 * 49 * 2 * 32 * 4);
  EXPECT_EQ(drawn % 49, 0u);
  EXPECT_GT(result.counters.texelsInside, 100u);

  double outside = 0;
  for (int row = 0; row < 32; ++row)
  {
    for (int column = 0; column < 32; ++column)
    {
      const double value = texelValue(result, 0, po::texelIndex(32, row, column));
      outside += value > 0 ? po::texelArea(32, row) : 0;
    }
  }
  EXPECT_NEAR(outside / (4 * Pi), 0.75, 0.03);
  // Next to the rim the neighbour fills about a third of the view; nothing there may be black.
  settings.dilateInside = true;
  const po::BakeResult dilated = bake(spheres, settings);
  EXPECT_GT(*std::min_element(dilated.table.floats.begin(), dilated.table.floats.end()), 0.4f);
  EXPECT_EQ(dilated.mean[0], result.mean[0]);
}

TEST(OcclusionBaker, CoincidentTouchingAndNestedSpheresHaveNoFalseHits)
{
  // Three spheres at one place: each sees the whole sky, whatever rounding does.
  const std::vector<po::Sphere> coincident(3, po::Sphere{ 100, 200, 300, 0.5f });
  for (const float mean : bake(coincident, floatSettings(16, 49)).mean)
  {
    EXPECT_EQ(mean, 1.0f);
  }
  // Nested and touching from within: the inner sphere is buried, the outer one untouched.
  const po::BakeResult nested =
    bake({ { 0, 0, 0, 1 }, { 0.5f, 0, 0, 0.5f } }, floatSettings(16, 49));
  EXPECT_EQ(nested.mean[0], 1.0f);
  EXPECT_EQ(nested.mean[1], 0.0f);
  EXPECT_EQ(nested.counters.particlesBuried, 1u);
}
}
