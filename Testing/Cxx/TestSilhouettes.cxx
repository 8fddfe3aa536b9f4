// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDepth.h"
#include "SilhouetteFinder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

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

using DepthFunction = std::function<double(double, double)>;

/// Depths at the centres of samples x samples parts of each pixel; pixel i reaches from i to i + 1.
std::vector<double> makeDepth(
  const DepthFunction& depth, int width = Width, int height = Height, int samples = 1)
{
  std::vector<double> image;
  for (int j = 0; j < height * samples; ++j)
  {
    for (int i = 0; i < width * samples; ++i)
    {
      image.push_back(depth((i + 0.5) / samples, (j + 0.5) / samples));
    }
  }
  return image;
}

po::SilhouetteParameters jagged(double threshold = 0)
{
  po::SilhouetteParameters parameters;
  parameters.threshold = threshold;
  parameters.samples = 1;
  return parameters;
}

std::vector<float> lines(const std::vector<double>& depth,
  const po::SilhouetteParameters& parameters, int width = Width, int height = Height,
  const po::SilhouetteOptions& options = {})
{
  const int samples = parameters.samples;
  const po::ImageDepth<double> source(
    po::DepthImage<double>{ depth.data(), width * samples, height * samples }, samples);
  po::SilhouetteImage image;
  const po::SilhouetteScale scale{ 0, po::depthSpread(source) };
  po::findSilhouettes(source, po::resolve(parameters, scale), image, options);
  return image.strength;
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

TEST(Silhouettes, DensityGoesFromNoneToAll)
{
  // Steps of 1, 2, 4, ... 128 from left to right.
  const auto depth = makeDepth([](double i, double) { return std::pow(2, std::floor(i / 5)); });
  std::size_t last = 0;
  for (const double density : { 0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0 })
  {
    po::SilhouetteParameters parameters = jagged(24);
    parameters.density = density;
    std::size_t count = 0;
    for (const float line : lines(depth, parameters))
    {
      count += line > 0;
    }
    EXPECT_EQ(count % Height, 0U);
    EXPECT_GE(count, last);
    last = count;
    if (density == 0 || density == 0.5)
    {
      EXPECT_EQ(count, density == 0 ? 0 : 4 * Height); // jumps of 16 to 128; 8 is not above 24 / 3
    }
  }
  EXPECT_EQ(last, 8U * Height);
}

TEST(Silhouettes, GreyAndWidthFollowTheJump)
{
  const auto depth = makeDepth([](double i, double j) { return i < 20 ? 1 : j < 18 ? 3 : 11; });
  po::SilhouetteParameters parameters = jagged(1);
  parameters.jumpFrom = 1;
  parameters.jumpTo = 5;
  parameters.greyByJump = true;
  auto found = lines(depth, parameters);
  EXPECT_FLOAT_EQ(found[5 * Width + 20], 0.25F);
  EXPECT_FLOAT_EQ(found[30 * Width + 20], 1);
  parameters.greyByJump = false;
  parameters.widthByJump = true;
  parameters.maximumWidth = 5;
  found = lines(depth, parameters);
  for (int i = 0; i < Width; ++i)
  {
    EXPECT_EQ(found[5 * Width + i] > 0, i >= 20 && i < 22) << i;
    EXPECT_EQ(found[30 * Width + i] > 0, i >= 20 && i < 25) << i;
  }
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

/// A disc in front of a plane. Its line is the ring of `width` pixels around it.
struct Disc
{
  double x, y, radius;

  [[nodiscard]] double distance(double i, double j) const
  {
    return std::hypot(i - x, j - y) - radius;
  }
};

/// Covered share of pixel (i, j) from 64 x 64 points.
double trueShare(const Disc& disc, double width, int i, int j)
{
  constexpr int Points = 64;
  int covered = 0;
  for (int v = 0; v < Points; ++v)
  {
    for (int u = 0; u < Points; ++u)
    {
      const double d = disc.distance(i + (u + 0.5) / Points, j + (v + 0.5) / Points);
      covered += d > 0 && d <= width;
    }
  }
  return static_cast<double>(covered) / (Points * Points);
}

TEST(Silhouettes, AntialiasedCirclesAreWithinATenthOfAPixel)
{
  for (const Disc disc :
    { Disc{ 20.3, 18.6, 12.4 }, Disc{ 19.8, 17.1, 4.7 }, Disc{ 20.5, 18.5, 1.9 } })
  {
    for (const double width : { 1.0, 2.5 })
    {
      po::SilhouetteParameters parameters;
      parameters.samples = 8;
      parameters.width = width;
      parameters.threshold = 1;
      const auto found =
        lines(makeDepth([&](double i, double j) { return disc.distance(i, j) > 0 ? 9.0 : 5.0; },
                Width, Height, 8),
          parameters);
      double area = 0, truth = 0, square = 0, radius = 0, trueRadius = 0;
      for (int j = 0; j < Height; ++j)
      {
        for (int i = 0; i < Width; ++i)
        {
          const double share = trueShare(disc, width, i, j), ours = found[j * Width + i];
          const double r = disc.distance(i + 0.5, j + 0.5) + disc.radius;
          area += ours;
          truth += share;
          radius += r * ours;
          trueRadius += r * share;
          square += (ours - share) * (ours - share);
          EXPECT_NEAR(ours, share, 0.26) << i << ' ' << j << " radius " << disc.radius;
        }
      }
      EXPECT_NEAR(radius / area, trueRadius / truth, 0.1) << "position";
      EXPECT_NEAR(area / truth * width, width, 0.1) << "width";
      EXPECT_LT(std::sqrt(square / truth), 0.1) << "grey, RMS over the line";
    }
  }
}

TEST(Silhouettes, SkippedTilesChangeNoBitAndThreadsNeither)
{
  // Tiles with and without jumps, large and small.
  const auto scene = [](double i, double j)
  {
    const double ball = std::hypot(i - 150, j - 80), hole = std::hypot(i - 60, j - 90);
    const double floor = 40 - 0.02 * j + 0.3 * std::sin(0.5 * i);
    return ball < 40 ? 12 - std::sqrt(1601 - ball * ball) / 40 : hole < 20 ? Infinity : floor;
  };
  for (const int samples : { 1, 4 })
  {
    const auto depth = makeDepth(scene, 230, 170, samples);
    for (const double density : { 0.2, 0.5, 0.95 })
    {
      po::SilhouetteParameters parameters;
      parameters.samples = samples;
      parameters.density = density;
      parameters.widthByJump = samples == 4;
      const auto skipped = lines(depth, parameters, 230, 170);
      EXPECT_EQ(lines(depth, parameters, 230, 170, { false, false }), skipped);
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      EXPECT_EQ(lines(depth, parameters, 230, 170), skipped);
    }
  }
}

TEST(Silhouettes, KeptImagesAreCleared)
{
  const auto step = makeDepth([](double i, double) { return i < 20 ? 1.0 : 2.0; });
  const auto flat = makeDepth([](double, double) { return 1.0; });
  po::SilhouetteImage image;
  for (const auto* depth : { &step, &flat, &step })
  {
    const po::ImageDepth<double> source(po::DepthImage<double>{ depth->data(), Width, Height }, 1);
    po::findSilhouettes(source, po::resolve(jagged(1), {}), image);
    EXPECT_EQ(image.strength, lines(*depth, jagged(1)));
  }
}

TEST(Silhouettes, ImagesOfOnePixelWidth)
{
  const std::vector<double> depth{ 1, 2, 2 };
  EXPECT_EQ(lines(depth, jagged(0.5), 1, 3), (std::vector<float>{ 0, 1, 0 }));
  EXPECT_EQ(lines(depth, jagged(0.5), 3, 1), (std::vector<float>{ 0, 1, 0 }));
}

TEST(SilhouetteRule, ScalesWithTheData)
{
  for (const double scale : { 1e-9, 1.0, 3e22 })
  {
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ 2 * scale, 50 * scale }), 12 * scale);
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ 2 * scale, 500 * scale }), 30 * scale);
    po::SilhouetteParameters parameters;
    parameters.unit = po::SilhouetteUnit::Radii;
    parameters.threshold = 6;
    EXPECT_DOUBLE_EQ(po::resolve(parameters, { 2 * scale, 0 }).jump, 4 * scale);
  }
}

TEST(SilhouetteRule, NamesWhatIsOutOfRange)
{
  po::SilhouetteParameters parameters;
  EXPECT_EQ(po::faultOf(parameters), "");
  parameters.jumpFrom = 2;
  parameters.jumpTo = 1;
  EXPECT_NE(po::faultOf(parameters).find("JumpTo is 1"), std::string::npos);
  parameters.samples = 3;
  EXPECT_NE(po::faultOf(parameters).find("Samples is 3"), std::string::npos);
  parameters.threshold = NaN;
  EXPECT_NE(po::faultOf(parameters).find("Threshold"), std::string::npos);
}

TEST(DepthSpread, IgnoresBackgroundAndFarOutliers)
{
  const auto depth = makeDepth([](double i, double j)
    { return i < 1 && j < 1 ? 1e9
        : i > 150           ? Infinity
                            : 100 + i; },
    320, 320);
  const po::ImageDepth<double> source(po::DepthImage<double>{ depth.data(), 320, 320 }, 1);
  EXPECT_NEAR(po::depthSpread(source), 150, 25);
}
