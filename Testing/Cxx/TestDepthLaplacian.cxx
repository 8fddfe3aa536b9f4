// SPDX-License-Identifier: BSD-3-Clause
#include "DepthLaplacian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace
{
constexpr int Width = 41;
constexpr int Height = 37;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

using DepthFunction = std::function<double(int, int)>;

std::vector<double> makeDepth(const DepthFunction& depth)
{
  std::vector<double> image;
  for (int j = 0; j < Height; ++j)
  {
    for (int i = 0; i < Width; ++i)
    {
      image.push_back(depth(i, j));
    }
  }
  return image;
}

std::vector<float> lines(
  const std::vector<double>& depth, const po::SilhouetteParameters& parameters)
{
  const po::DepthImage<double> image{ depth.data(), Width, Height };
  const po::EdgeRule rule = po::resolveEdgeRule(parameters, po::farthestDepth(image));
  std::vector<float> strength(depth.size(), -1.0F);
  po::markSilhouettes(image, rule, { 0, Width, 0, Height }, strength.data());
  return strength;
}

/// Fails with the pixel's position where `lines` is not what `expected` says.
void expectLines(const std::vector<float>& lines, const std::function<bool(int, int)>& expected)
{
  for (int j = 0; j < Height; ++j)
  {
    for (int i = 0; i < Width; ++i)
    {
      EXPECT_EQ(lines[j * Width + i], expected(i, j) ? 1.0F : 0.0F) << "pixel " << i << ", " << j;
    }
  }
}

bool nowhere(int, int)
{
  return false;
}

/// Distances from the eye to the plane z = 10 + slope * x in a square image of `count` pixels and a
/// view angle of 30 degrees.
std::vector<double> planeInPerspective(double slope, int count)
{
  std::vector<double> depth;
  const double tangent = std::tan(M_PI / 12.0);
  for (int j = 0; j < count; ++j)
  {
    const double y = ((2.0 * j + 1.0) / count - 1.0) * tangent;
    for (int i = 0; i < count; ++i)
    {
      const double x = ((2.0 * i + 1.0) / count - 1.0) * tangent;
      depth.push_back(10.0 / (1.0 - slope * x) * std::sqrt(1.0 + x * x + y * y));
    }
  }
  return depth;
}
}

TEST(DepthLaplacian, SlantedPlaneInParallelProjectionIsZeroInside)
{
  const auto depth = makeDepth([](int i, int j) { return 100.0 + 0.5 * i - 0.25 * j; });
  const po::DepthImage<double> image{ depth.data(), Width, Height };
  for (int j = 1; j < Height - 1; ++j)
  {
    for (int i = 1; i < Width - 1; ++i)
    {
      EXPECT_EQ(po::depthLaplacian(image, i, j, Infinity), 0.0);
    }
  }
}

TEST(DepthLaplacian, PlanesInPerspectiveHaveNoLine)
{
  constexpr int count = 400;
  for (const double slope : { 0.0, 0.5, -0.5, 1.0, -1.0, 2.0 })
  {
    const auto depth = planeInPerspective(slope, count);
    const po::DepthImage<double> image{ depth.data(), count, count };
    const po::EdgeRule rule = po::resolveEdgeRule({}, po::farthestDepth(image));
    for (int j = 0; j < count; ++j)
    {
      for (int i = 0; i < count; ++i)
      {
        // Inside, a thousandth of the threshold is never reached. The repeated border adds 3 to 5
        // times the slope per pixel, which must stay below the threshold up to 45 degrees.
        const bool inside = i > 0 && i < count - 1 && j > 0 && j < count - 1;
        const double bound = inside ? 1e-3 * rule.threshold : rule.threshold;
        ASSERT_TRUE(po::depthLaplacian(image, i, j, Infinity) < bound || (slope > 1.0 && !inside))
          << "slope " << slope << ", pixel " << i << ", " << j;
      }
    }
  }
}

TEST(DepthLaplacian, BulgingSurfaceIsNegativeInside)
{
  const auto depth = makeDepth(
    [](int i, int j)
    {
      const double x = (i - 20) / 25.0;
      const double y = (j - 18) / 25.0;
      return 5.0 - std::sqrt(2.0 - x * x - y * y);
    });
  const po::DepthImage<double> image{ depth.data(), Width, Height };
  for (int j = 1; j < Height - 1; ++j)
  {
    for (int i = 1; i < Width - 1; ++i)
    {
      EXPECT_LT(po::depthLaplacian(image, i, j, Infinity), 0.0);
    }
  }
}

TEST(DepthLaplacian, StepGivesOneLineBehindTheJump)
{
  const auto depth = makeDepth([](int i, int) { return i < 20 ? 1.0 : 2.0; });
  for (const double threshold : { 1e-9, 0.5, 2.999 })
  {
    expectLines(lines(depth, { threshold, 0.0 }), [](int i, int) { return i == 20; });
  }
  expectLines(lines(depth, { 3.0, 0.0 }), nowhere);
  expectLines(lines(depth, {}), [](int i, int) { return i == 20; });
}

TEST(DepthLaplacian, StepOnSlantedPlanesGivesOneLine)
{
  const auto depth =
    makeDepth([](int i, int j) { return 50.0 + 0.1 * i + 0.05 * j + (j < 11 ? 0.0 : 2.0); });
  expectLines(lines(depth, { 1.0, 0.0 }), [](int, int j) { return j == 11; });
}

TEST(DepthLaplacian, OutlineAgainstBackgroundAtAnyThreshold)
{
  const auto inside = [](int i, int j) { return i >= 10 && i < 30 && j >= 8 && j < 21; };
  const auto outline = [&](int i, int j)
  { return i >= 9 && i < 31 && j >= 7 && j < 22 && !inside(i, j); };
  for (const double background : { Infinity, -Infinity, NaN })
  {
    const auto depth = makeDepth([&](int i, int j) { return inside(i, j) ? 3.0 : background; });
    for (const double threshold : { 0.0, 1e-12, 0.7, 1e6 })
    {
      expectLines(lines(depth, { threshold, 0.0 }), outline);
    }
  }
}

TEST(DepthLaplacian, BackgroundDepthIsSubjectToTheThreshold)
{
  const auto depth = makeDepth([](int i, int) { return i < 20 ? 4.0 : Infinity; });
  expectLines(lines(depth, { 2.9, 5.0 }), [](int i, int) { return i == 20; });
  expectLines(lines(depth, { 3.1, 5.0 }), nowhere);
}

TEST(DepthLaplacian, OnlyBackgroundHasNoLine)
{
  for (const po::SilhouetteParameters parameters : { po::SilhouetteParameters{},
         po::SilhouetteParameters{ 1e-9, 0.0 }, po::SilhouetteParameters{ 1e-9, 7.0 } })
  {
    expectLines(lines(makeDepth([](int, int) { return Infinity; }), parameters), nowhere);
  }
}

TEST(DepthLaplacian, SinglePixelIsSurrounded)
{
  const auto depth = makeDepth([](int i, int j) { return i == 5 && j == 6 ? 1.0 : NaN; });
  expectLines(lines(depth, {}),
    [](int i, int j)
    { return std::abs(i - 5) <= 1 && std::abs(j - 6) <= 1 && !(i == 5 && j == 6); });
}

TEST(DepthLaplacian, LinesReachTheBorder)
{
  const auto depth = makeDepth([](int i, int j) { return j < 1 || i > Width - 2 ? 2.0 : 1.0; });
  // The strip of pixels behind is one pixel wide: all of it but the corner, whose neighbours,
  // repeated ones included, lie behind too except for one.
  const po::DepthImage<double> image{ depth.data(), Width, Height };
  EXPECT_EQ(po::depthLaplacian(image, 7, 0, 0.0), 3.0);
  EXPECT_EQ(po::depthLaplacian(image, Width - 1, 9, 0.0), 3.0);
  EXPECT_EQ(po::depthLaplacian(image, Width - 1, 0, 0.0), 1.0);
}

TEST(DepthLaplacian, ImagesOfOnePixelWidth)
{
  const std::vector<float> depth{ 1.0F, 2.0F, 2.0F };
  for (const po::DepthImage<float> image :
    { po::DepthImage<float>{ depth.data(), 1, 3 }, po::DepthImage<float>{ depth.data(), 3, 1 } })
  {
    std::vector<float> lines(3);
    po::markSilhouettes(image, { 0.5, 9.0 }, { 0, image.width, 0, image.height }, lines.data());
    EXPECT_EQ(lines, (std::vector<float>{ 0.0F, 1.0F, 0.0F }));
  }
}

TEST(DepthLaplacian, BlocksTogetherAreTheWhole)
{
  const auto depth = makeDepth([](int i, int j) { return (i * 7 + j * 13) % 5 ? 1.0 : Infinity; });
  const po::DepthImage<double> image{ depth.data(), Width, Height };
  const po::EdgeRule rule = po::resolveEdgeRule({}, po::farthestDepth(image));
  std::vector<float> blocks(depth.size(), -1.0F);
  for (int j = 0; j < Height; j += 5)
  {
    po::markSilhouettes(image, rule, { 0, 17, j, std::min(j + 5, Height) }, blocks.data());
    po::markSilhouettes(image, rule, { 17, Width, j, std::min(j + 5, Height) }, blocks.data());
  }
  EXPECT_EQ(blocks, lines(depth, {}));
}

TEST(EdgeRule, ScalesWithTheData)
{
  for (const double scale : { 1e-9, 1.0, 3e22 })
  {
    const po::EdgeRule rule = po::resolveEdgeRule({}, 5.0 * scale);
    EXPECT_DOUBLE_EQ(rule.threshold, 0.05 * scale);
    EXPECT_DOUBLE_EQ(rule.background, 5.1 * scale);
  }
}

TEST(FarthestDepth, IgnoresBackground)
{
  const std::vector<float> depth{ -3.0F, static_cast<float>(NaN), -2.0F,
    static_cast<float>(Infinity) };
  EXPECT_EQ(po::farthestDepth(po::DepthImage<float>{ depth.data(), 2, 2 }), -2.0);
  EXPECT_EQ(po::farthestDepth(po::DepthImage<float>{ depth.data() + 3, 1, 1 }), std::nullopt);
}
