// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteImages.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace silhouette_images;

namespace
{
/// Fails with the pixel's position where `lines` is not what `expected` says.
void expectLines(const po::LinePixels<float>& lines, const std::function<bool(int, int)>& expected)
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
/// view angle of 30 degrees; the background beyond its horizon.
std::vector<double> planeInPerspective(double slope, int count)
{
  const double tangent = std::tan(M_PI / 12.0);
  return makeDepth(
    [&](double i, double j)
    {
      const double x = (2 * i / count - 1) * tangent, y = (2 * j / count - 1) * tangent;
      const double w = 1 - slope * x;
      return w > 0 ? 10 / w * std::sqrt(1 + x * x + y * y) : Infinity;
    },
    count, count);
}
}

TEST(Silhouettes, PlanesHaveNoLineHoweverSlantedEvenAtTheBorder)
{
  constexpr int count = 300;
  for (const double slope : { 0.0, 0.5, -0.5, 1.0, -1.0, 2.5, -2.5 })
  {
    const auto depth = planeInPerspective(slope, count);
    for (const double threshold : { 0.0, 1e-3 })
    {
      const auto found = lines(depth, jagged(threshold), count, count);
      for (int j = 0; j < count; ++j)
      {
        for (int i = 0; i < count; ++i)
        {
          // The repeated border bends a plane a little: by less than any automatic threshold.
          const bool inside = i > 0 && j > 0 && i < count - 1 && j < count - 1;
          ASSERT_TRUE(found[j * count + i] == 0 || (!inside && threshold > 0))
            << "slope " << slope << ", threshold " << threshold << ", pixel " << i << ", " << j;
        }
      }
    }
  }
}

TEST(Silhouettes, APlaneUpToItsHorizonHasOneLineAlongTheHorizon)
{
  constexpr int count = 300;
  const auto depth = planeInPerspective(8, count); // the horizon is at x = 1/8
  const auto found = lines(depth, jagged(1e-3), count, count);
  const double horizon = (1 / 8.0 / std::tan(M_PI / 12.0) + 1) / 2 * count;
  for (int j = 1; j < count - 1; ++j)
  {
    for (int i = 1; i < count - 1; ++i)
    {
      const bool beyond = i + 0.5 > horizon && i - 0.5 < horizon;
      // Within two pixels of the horizon depths of a plane are no longer alike.
      if (std::abs(i + 0.5 - horizon) > 2.5 || beyond)
      {
        ASSERT_EQ(found[j * count + i] > 0, beyond) << "pixel " << i << ", " << j;
      }
    }
  }
}

TEST(Silhouettes, WithoutTheSlopeTestAConcaveCreaseHasALine)
{
  const auto depth = makeDepth([](double i, double) { return 50 - 2 * std::abs(i - 20.5); });
  po::SilhouetteParameters parameters = jagged(1);
  expectLines(lines(depth, parameters), nowhere);
  parameters.slopeTest = false;
  expectLines(lines(depth, parameters), [](int i, int) { return i == 20; });
}

TEST(Silhouettes, BulgingSurfacesHaveNoLineAtAnyThreshold)
{
  const auto depth = makeDepth(
    [](double i, double j)
    {
      const double x = (i - 20) / 25, y = (j - 18) / 25;
      return 5 - std::sqrt(2 - x * x - y * y);
    });
  po::SilhouetteParameters all = jagged();
  all.density = 1;
  const auto found = lines(depth, all);
  for (int j = 1; j < Height - 1; ++j) // the repeated border bends it the other way
  {
    for (int i = 1; i < Width - 1; ++i)
    {
      EXPECT_EQ(found[j * Width + i], 0);
    }
  }
}

TEST(Silhouettes, StepGivesOneLineBehindTheJump)
{
  const auto depth = makeDepth([](double i, double) { return i < 20 ? 1.0 : 2.0; });
  for (const double threshold : { 1e-9, 0.5, 2.999 })
  {
    expectLines(lines(depth, jagged(threshold)), [](int i, int) { return i == 20; });
  }
  expectLines(lines(depth, jagged(3)), nowhere);
  expectLines(lines(depth, jagged()), [](int i, int) { return i == 20; });
}

TEST(Silhouettes, StepOnSlantedPlanesGivesOneLine)
{
  const auto depth =
    makeDepth([](double i, double j) { return 50 + 0.1 * i + 0.05 * j + (j < 11 ? 0 : 2); });
  expectLines(lines(depth, jagged(1)), [](int, int j) { return j == 11; });
}

TEST(Silhouettes, OutlineAgainstBackgroundAtAnyThreshold)
{
  const auto inside = [](double i, double j) { return i >= 10 && i < 30 && j >= 8 && j < 21; };
  const auto outline = [&](int i, int j)
  { return i >= 9 && i < 31 && j >= 7 && j < 22 && !inside(i, j); };
  for (const double background : { Infinity, -Infinity, NaN })
  {
    const auto depth =
      makeDepth([&](double i, double j) { return inside(i, j) ? 3.0 : background; });
    for (const double threshold : { 0.0, 1e-12, 0.7, 1e6 })
    {
      expectLines(lines(depth, jagged(threshold)), outline);
    }
    po::SilhouetteParameters without = jagged(0.7);
    without.backgroundLines = false;
    expectLines(lines(depth, without), nowhere);
  }
}

TEST(Silhouettes, BackgroundDepthIsSubjectToTheThreshold)
{
  const auto depth = makeDepth([](double i, double) { return i < 20 ? 4.0 : Infinity; });
  po::SilhouetteParameters parameters = jagged(2.9);
  parameters.backgroundDepth = 5;
  expectLines(lines(depth, parameters), [](int i, int) { return i == 20; });
  parameters.threshold = 3.1;
  expectLines(lines(depth, parameters), nowhere);
}

TEST(Silhouettes, OnlyBackgroundHasNoLine)
{
  const auto depth = makeDepth([](double, double) { return Infinity; });
  for (const double density : { 0.0, 0.5, 1.0 })
  {
    po::SilhouetteParameters parameters = jagged();
    parameters.density = density;
    expectLines(lines(depth, parameters), nowhere);
  }
}

TEST(Silhouettes, ParticleOfOnePixelIsSurrounded)
{
  const auto depth =
    makeDepth([](double i, double j) { return int(i) == 5 && int(j) == 6 ? 1.0 : NaN; });
  expectLines(lines(depth, jagged()),
    [](int i, int j)
    { return std::abs(i - 5) <= 1 && std::abs(j - 6) <= 1 && !(i == 5 && j == 6); });
}

TEST(Silhouettes, AFarObjectMovesNoLine)
{
  const auto near = [](double i, double j)
  {
    const double x = i - 14, y = j - 17;
    return x * x + y * y < 100 ? 5.0 : i < 12 ? 9.0 : Infinity;
  };
  const auto before = makeDepth(near);
  const auto after = makeDepth(
    [&](double i, double j) { return i > 33 && j > 30 ? std::min(near(i, j), 1e6) : near(i, j); });
  for (const double threshold : { 1e-3, 3.0, 11.0 })
  {
    const auto first = lines(before, jagged(threshold)), second = lines(after, jagged(threshold));
    for (int pixel = 0; pixel < Width * Height; ++pixel)
    {
      if (pixel % Width < 32 || pixel / Width < 29)
      {
        EXPECT_EQ(first[pixel], second[pixel]);
      }
    }
  }
}
