// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDepth.h"
#include "SilhouettePixels.h"
#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "TestViews.h"
#include "TracedDepth.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <memory>
#include <random>

namespace
{
using namespace po;

SphereCloud cloudOf(const std::vector<std::array<double, 4>>& spheres)
{
  return makeSphereCloud(
    spheres.size(),
    [&](std::size_t i) {
      return Vec3d{ spheres[i][0], spheres[i][1], spheres[i][2] };
    },
    [&](std::size_t i) { return spheres[i][3]; });
}

/// Spheres of radii 0.5 to 1.5 in a box of 20, fixed seed.
std::vector<std::array<double, 4>> heap()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10), radius(0.5, 1.5);
  std::vector<std::array<double, 4>> spheres(400);
  for (auto& sphere : spheres)
  {
    sphere = { place(random), place(random), place(random), radius(random) };
  }
  return spheres;
}

struct Traced
{
  SphereRenderer renderer;

  Traced(const std::vector<std::array<double, 4>>& spheres, const Camera& camera)
  {
    renderer.setCloud(cloudOf(spheres));
    EXPECT_TRUE(renderer.trace(camera, Identity));
  }

  [[nodiscard]] TracedLayer layer() const
  {
    return { renderer.frame(), renderer.rays(), renderer.cloud().spheres };
  }

  SilhouetteImage lines(
    const SilhouetteParameters& parameters, const SilhouetteOptions& options = {}) const
  {
    SilhouetteImage image;
    findTracedSilhouettes(TracedDepth({ layer() }),
      resolve(parameters, { renderer.cloud().scale, 20 }), image, options);
    return image;
  }
};

SilhouetteParameters threshold(double value, int samples)
{
  SilhouetteParameters parameters;
  parameters.threshold = value;
  parameters.samples = samples;
  return parameters;
}

/// What the image filter makes of samples x samples rays a pixel.
std::vector<float> filtered(const std::vector<std::array<double, 4>>& spheres, Camera camera,
  const SilhouetteParameters& parameters)
{
  camera.width *= parameters.samples;
  camera.height *= parameters.samples;
  const Traced fine(spheres, camera);
  const TracedFrame& frame = fine.renderer.frame();
  const ImageDepth<double> source(
    DepthImage<double>{ frame.t.data(), frame.width, frame.height }, parameters.samples);
  SilhouetteImage image;
  findSilhouettes(source, resolve(parameters, { fine.renderer.cloud().scale, 20 }), image);
  return image.strength;
}

std::size_t count(const std::vector<float>& strength)
{
  return static_cast<std::size_t>(
    std::count_if(strength.begin(), strength.end(), [](float s) { return s > 0; }));
}
}

TEST(TracedSilhouettes, WithOneSampleHaveTheBitsOfTheFilter)
{
  for (const bool perspective : { true, false })
  {
    const Camera camera = lookAtOrigin(perspective, 50, 12, 301, 215, 1, 200);
    const Traced traced(heap(), camera);
    for (const double value : { 0.3, 3.0, 12.0 })
    {
      SilhouetteParameters parameters = threshold(value, 1);
      EXPECT_EQ(traced.lines(parameters).strength, filtered(heap(), camera, parameters));
      parameters.widthByJump = true;
      EXPECT_EQ(traced.lines(parameters).strength, filtered(heap(), camera, parameters));
    }
  }
}

/// Vectors are longer than the rows of some windows.
TEST(TracedSilhouettes, NarrowWindowsHaveTheLinesOfTheFilter)
{
  for (const int width : { 1, 2, 5, 8, 15, 17, 23 })
  {
    const Camera camera = lookAtOrigin(true, 50, 12, width, 40, 1, 200);
    const Traced traced(heap(), camera);
    const SilhouetteParameters parameters = threshold(3, 1);
    EXPECT_EQ(traced.lines(parameters).strength, filtered(heap(), camera, parameters)) << width;
    const auto smooth = traced.lines(threshold(3, 4)).strength;
    EXPECT_EQ(smooth.size(), static_cast<std::size_t>(40 * width));
    EXPECT_EQ(traced.lines(threshold(3, 4), { false, false }).strength, smooth) << width;
  }
}

TEST(TracedSilhouettes, ABackgroundBeforeTheSpheresHasNoRim)
{
  const Traced traced(heap(), lookAtOrigin(true, 50, 12, 120, 90, 1, 200));
  SilhouetteParameters parameters = threshold(3, 4);
  const std::size_t lines = count(traced.lines(parameters).strength);
  parameters.backgroundDepth = 1;
  const std::size_t fewer = count(traced.lines(parameters).strength);
  EXPECT_GT(fewer, 0U); // between spheres
  EXPECT_LT(fewer, lines);
}

TEST(TracedSilhouettes, TileRangesAreThoseOfTheirPixels)
{
  const Traced traced(heap(), lookAtOrigin(true, 50, 12, 301, 215, 1, 200));
  const TracedFrame& frame = traced.renderer.frame();
  const ImageDepth<double> image(
    DepthImage<double>{ frame.t.data(), frame.width, frame.height }, 1);
  ASSERT_EQ(frame.tiles.size(), image.ranges().size());
  for (std::size_t tile = 0; tile < frame.tiles.size(); ++tile)
  {
    EXPECT_EQ(frame.tiles[tile].nearest, image.ranges()[tile].nearest);
    EXPECT_EQ(frame.tiles[tile].farthest, image.ranges()[tile].farthest);
    EXPECT_EQ(frame.tiles[tile].background, image.ranges()[tile].background);
  }
}

TEST(TracedSilhouettes, SkippedTilesChangeNoBitAndThreadsNeither)
{
  const Traced traced(heap(), lookAtOrigin(true, 70, 22, 301, 215, 1, 200));
  for (const int samples : { 1, 4 })
  {
    for (const double value : { 0.1, 6.0, 30.0 })
    {
      SilhouetteParameters parameters = threshold(value, samples);
      parameters.greyByJump = true;
      parameters.widthByJump = value > 1;
      const auto strength = traced.lines(parameters).strength;
      EXPECT_GT(count(strength), 100U);
      EXPECT_EQ(traced.lines(parameters, { false, false }).strength, strength);
      EXPECT_EQ(traced.lines(parameters, { true, true }).strength, strength);
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      EXPECT_EQ(traced.lines(parameters).strength, strength);
    }
  }
}

/// One sphere, or one before another: position, width and grey against the filter of 8 x 8 traced
/// samples a pixel, and of that against 64 x 64 points in TestSilhouettes.
TEST(TracedSilhouettes, AntialiasedRimsAreWithinATenthOfAPixelOfSupersampling)
{
  const std::vector<std::vector<std::array<double, 4>>> scenes{ { { 0.3, -0.2, 0, 6 } },
    { { 0.1, 0.3, 0, 0.6 } }, { { -2, 0.5, 4, 3 }, { 2, -0.4, -9, 6 } } };
  for (const bool perspective : { true, false })
  {
    const Camera camera = lookAtOrigin(perspective, 30, 9, 120, 90, 1, 200);
    for (const auto& spheres : scenes)
    {
      for (const double width : { 1.0, 2.5 })
      {
        SilhouetteParameters parameters = threshold(6, 8);
        parameters.width = width;
        const auto ours = Traced(spheres, camera).lines(parameters).strength;
        const auto truth = filtered(spheres, camera, parameters);
        double area = 0, trueArea = 0, square = 0;
        std::array<double, 2> middle{}, trueMiddle{};
        for (std::size_t pixel = 0; pixel < ours.size(); ++pixel)
        {
          const double x = static_cast<double>(pixel % 120), y = static_cast<double>(pixel / 120);
          area += ours[pixel];
          trueArea += truth[pixel];
          middle[0] += x * ours[pixel];
          middle[1] += y * ours[pixel];
          trueMiddle[0] += x * truth[pixel];
          trueMiddle[1] += y * truth[pixel];
          square += std::pow(ours[pixel] - truth[pixel], 2);
        }
        EXPECT_NEAR(middle[0] / area, trueMiddle[0] / trueArea, 0.1);
        EXPECT_NEAR(middle[1] / area, trueMiddle[1] / trueArea, 0.1);
        EXPECT_NEAR(area / trueArea * width, width, 0.1) << spheres.size() << ' ' << width;
        EXPECT_LT(std::sqrt(square / trueArea), 0.1) << spheres.size() << ' ' << width;
      }
    }
  }
}

/// A line takes part of a pixel and the sphere another, of a pixel that shows what is behind:
/// shares against 8 x 8 rays a pixel.
TEST(TracedSilhouettes, WhatLiesWithinARimIsKnown)
{
  const Camera camera = lookAtOrigin(true, 30, 9, 120, 90, 1, 200);
  const std::vector<std::array<double, 4>> spheres{ { 0.3, -0.2, 0, 6 } };
  const Traced traced(spheres, camera);
  const SilhouetteImage lines = traced.lines(threshold(6, 8), { true, true });
  ASSERT_EQ(lines.inside.size(), lines.strength.size());
  EXPECT_TRUE(traced.lines(threshold(6, 1), { true, true }).inside.empty());

  Camera fine = camera;
  fine.width *= 8;
  fine.height *= 8;
  const Traced samples(spheres, fine);
  int rims = 0;
  for (int pixel = 0; pixel < camera.width * camera.height; ++pixel)
  {
    const auto at = static_cast<std::size_t>(pixel);
    if (!(lines.strength[at] > 0))
    {
      continue;
    }
    int hits = 0;
    for (int sample = 0; sample < 64; ++sample)
    {
      const int x = pixel % camera.width * 8 + sample % 8,
                y = pixel / camera.width * 8 + sample / 8;
      hits += samples.layer().frame.sphere[static_cast<std::size_t>(y) * fine.width + x] !=
        SphereScene::None;
    }
    const bool isInside = traced.layer().frame.sphere[at] != SphereScene::None;
    EXPECT_NEAR(lines.inside[at], isInside ? 0 : hits / 64.0, 1 / 16.0);
    rims += lines.inside[at] > 0.1F;
  }
  EXPECT_GT(rims, 30);
}

namespace
{
/// A red sphere on white, and the pixels of its black lines: no white is left where the line and
/// the sphere cover all of a pixel.
void expectNoWhiteAtRims(const TracedFrame& frame, const SilhouetteImage& lines)
{
  std::vector<std::uint8_t> picture(4 * frame.pixels(), 255);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    const bool isSphere = frame.sphere[pixel] != SphereScene::None;
    picture[4 * pixel + 1] = picture[4 * pixel + 2] = isSphere ? 0 : 255;
  }
  SilhouettePixels pixels;
  colorSilhouettes(lines, SilhouetteStyle(), { picture.data(), nullptr }, pixels);
  int rims = 0;
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (lines.strength[pixel] > 0 && lines.inside[pixel] > 0)
    {
      const std::uint8_t* line = &pixels.rgba[4 * pixel];
      EXPECT_GE(line[3], 254);
      EXPECT_NEAR(line[0], 255 * lines.inside[pixel], 2); // red, and black
      EXPECT_EQ(line[1], 0);
      ++rims;
    }
  }
  EXPECT_GT(rims, 50);
}
}

TEST(TracedSilhouettes, BackgroundDoesNotShineThroughBetweenSphereAndLine)
{
  const std::vector<std::array<double, 4>> sphere{ { 0.3, -0.2, 0, 6 } };
  Camera camera = lookAtOrigin(true, 30, 9, 120, 90, 1, 200);
  const Traced traced(sphere, camera);
  SilhouetteParameters parameters = threshold(6, 4);
  parameters.width = 1.5; // no pixel on a rim reaches beyond the line
  expectNoWhiteAtRims(traced.renderer.frame(), traced.lines(parameters, { true, true }));
  // Of a depth image likewise, as of meshes.
  camera.width *= parameters.samples;
  camera.height *= parameters.samples;
  const Traced fine(sphere, camera);
  const TracedFrame& samples = fine.renderer.frame();
  const ImageDepth<double> source(
    DepthImage<double>{ samples.t.data(), samples.width, samples.height }, parameters.samples);
  SilhouetteImage lines;
  findSilhouettes(
    source, resolve(parameters, { fine.renderer.cloud().scale, 20 }), lines, { true, true });
  expectNoWhiteAtRims(traced.renderer.frame(), lines);
}

/// Bigler 2004, figure 4.4: smaller thresholds give more lines, and never lose one; the absolute
/// value of the Laplacian gives double lines where the positive side gives one.
TEST(TracedSilhouettes, ThresholdSweepOfTheThesis)
{
  const Camera camera = lookAtOrigin(true, 60, 14, 301, 215, 1, 200);
  const Traced traced(heap(), camera);
  const TracedFrame& frame = traced.renderer.frame();
  std::vector<float> larger(frame.pixels(), 0);
  std::size_t last = 0;
  for (const double value : { 10.0, 1.0, 0.1, 0.01, 0.0 })
  {
    SilhouetteParameters parameters = threshold(value, 1);
    parameters.slopeTest = false;
    parameters.density = value > 0 ? 0.5 : 1;
    const auto strength = traced.lines(parameters).strength;
    std::size_t absolute = 0, positive = 0;
    for (int y = 1; y < frame.height - 1; ++y)
    {
      for (int x = 1; x < frame.width - 1; ++x)
      {
        const std::size_t pixel = pixelAt(frame, x, y);
        EXPECT_GE(strength[pixel], larger[pixel]);
        double laplacian = 0;
        for (int k = 0; k < 9; ++k)
        {
          laplacian += frame.t[pixel] - frame.t[pixelAt(frame, x + k % 3 - 1, y + k / 3 - 1)];
        }
        if (std::isfinite(laplacian))
        {
          // An independent sum, in double precision, decides but for rounding.
          absolute += std::abs(laplacian) > value;
          positive += laplacian > value;
          const bool certain = std::abs(laplacian - value) > 1e-4;
          EXPECT_TRUE(!certain || (strength[pixel] > 0) == (laplacian > value));
        }
      }
    }
    EXPECT_GT(absolute, 3 * positive / 2) << value;
    EXPECT_GT(count(strength), last);
    last = count(strength);
    larger = strength;
  }
}

/// The share of the same rims that has lines, in pictures of one scene.
TEST(TracedSilhouettes, ZoomDollyAndClippingPlanesNeedNoNewThreshold)
{
  // A row of pairs; the one behind is 0.5, 1, 1.5 ... radii farther away.
  std::vector<std::array<double, 4>> pairs;
  for (int i = 0; i < 8; ++i)
  {
    const double x = 4 * (i - 3.5), gap = 0.75 * (i + 1);
    pairs.push_back({ x - 0.5, 0, 0, 1 });
    pairs.push_back({ x + 0.7, 0.2, -gap, 1 });
  }
  const auto linesOfPairs = [&](const Camera& camera, int samples)
  {
    const Traced traced(pairs, camera);
    SilhouetteParameters parameters = threshold(3 * 2.2, samples);
    parameters.backgroundLines = false;
    const auto strength = traced.lines(parameters).strength;
    std::vector<bool> has(8);
    for (std::size_t pixel = 0; pixel < strength.size(); ++pixel)
    {
      const std::uint32_t sphere = traced.renderer.frame().sphere[pixel];
      if (strength[pixel] > 0.25F && sphere != SphereScene::None)
      {
        has[sphere / 2] = true;
      }
    }
    return has;
  };
  for (const int samples : { 1, 4 })
  {
    const std::vector<bool> reference =
      linesOfPairs(lookAtOrigin(false, 60, 10, 1000, 500, 1, 300), samples);
    EXPECT_EQ(std::count(reference.begin(), reference.end(), true), 5) << samples;
    for (const double half : { 10.0, 12.0, 18.0 })
    {
      EXPECT_EQ(linesOfPairs(lookAtOrigin(false, 60, half, 1000, 500, 1, 300), samples), reference);
      EXPECT_EQ(linesOfPairs(lookAtOrigin(false, 60, half, 1000, 500, 40, 90), samples), reference);
    }
    for (const double distance : { 200.0, 500.0, 3000.0 })
    {
      EXPECT_EQ(linesOfPairs(lookAtOrigin(true, distance, 10, 1000, 500, 1, 2 * distance), samples),
        reference);
    }
  }
}

TEST(TracedSilhouettes, OfSeveralLayersAreThoseOfAllSpheresTogether)
{
  const Camera camera = lookAtOrigin(true, 50, 12, 301, 215, 1, 200);
  const auto all = heap();
  const Traced whole(all, camera);
  const Traced first({ all.begin(), all.begin() + 150 }, camera);
  const Traced second({ all.begin() + 150, all.end() }, camera);
  for (const int samples : { 1, 4 })
  {
    const SilhouetteRule rule = resolve(threshold(6, samples), {});
    SilhouetteImage together, apart;
    findTracedSilhouettes(TracedDepth({ whole.layer() }), rule, together);
    findTracedSilhouettes(TracedDepth({ first.layer(), second.layer() }), rule, apart);
    double difference = 0;
    for (std::size_t pixel = 0; pixel < together.strength.size(); ++pixel)
    {
      difference += std::abs(together.strength[pixel] - apart.strength[pixel]);
    }
    // Clouds have origins and scales of their own, which round differently.
    EXPECT_LT(difference, 0.01 * static_cast<double>(count(together.strength)));
  }
}
