// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteImages.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

using namespace silhouette_images;

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

namespace
{
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
  EXPECT_EQ(lines(depth, jagged(0.5), 1, 3), (po::LinePixels<float>{ 0, 1, 0 }));
  EXPECT_EQ(lines(depth, jagged(0.5), 3, 1), (po::LinePixels<float>{ 0, 1, 0 }));
}

TEST(SilhouetteRule, ScalesWithTheData)
{
  for (const double scale : { 1e-9, 1.0, 3e22 })
  {
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ 2 * scale, 50 * scale }), 12 * scale);
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ 2 * scale, 500 * scale }), 30 * scale);
    // A gas; so few particles that hardly one hides another; particles that touch.
    const double gas = po::automaticThreshold({ scale, 8000 * scale, 102 * scale });
    EXPECT_NEAR(gas / scale, 300 * std::log(6.0), 1e-9);
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ scale, 60 * scale, 1000 * scale }), 6 * scale);
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ scale, 60 * scale, Infinity }), 6 * scale);
    EXPECT_DOUBLE_EQ(po::automaticThreshold({ scale, 60 * scale, 3 * scale }), 6 * scale);
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

/// Darkened lines take the colour of that pixel, far from the front too. The pixel that the edge of
/// the front cuts, column 10, shows what is behind at its centre.
TEST(Silhouettes, PixelInFrontOfALineShowsWhatIsInFront)
{
  constexpr int Samples = 4;
  const auto depth =
    makeDepth([](double i, double) { return i < 10.3 ? 10 : 100; }, Width, Height, Samples);
  po::SilhouetteParameters parameters;
  parameters.samples = Samples;
  parameters.threshold = 30;
  parameters.width = 5;
  const po::ImageDepth<double> source(
    po::DepthImage<double>{ depth.data(), Width * Samples, Height * Samples }, Samples);
  po::SilhouetteImage image;
  po::findSilhouettes(source, po::resolve(parameters, {}), image, { true, true });
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < image.strength.size(); ++pixel)
  {
    if (image.strength[pixel] > 0)
    {
      ++count;
      EXPECT_EQ(image.front[pixel] % Width, 9) << pixel;
    }
  }
  EXPECT_EQ(count, 6U * Height);
}
