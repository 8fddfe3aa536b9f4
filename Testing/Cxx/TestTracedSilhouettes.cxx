// SPDX-License-Identifier: BSD-3-Clause
#include "TracedSilhouetteTestScene.h"

#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <cmath>

using namespace traced_silhouettes;

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

/// Pictures of whole cache lines (320) and others; the second one replaces what the first one had.
TEST(TracedSilhouettes, AllInstructionSetsGiveTheSameBits)
{
  for (const int width : { 320, 301, 40 })
  {
    const Traced near(heap(), lookAtOrigin(true, 50, 12, width, 100, 1, 200));
    const Traced far(heap(), lookAtOrigin(true, 70, 22, width, 100, 1, 200));
    for (const int samples : { 1, 4 })
    {
      const SilhouetteParameters parameters = threshold(3, samples);
      const SilhouetteImage expected = far.lines(parameters, { true, true });
      EXPECT_GT(count(expected.strength), 100U);
      for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
      {
        hwy::SetSupportedTargetsForTest(target);
        SilhouetteImage image = near.lines(parameters, { true, true });
        far.find(parameters, { true, true }, image);
        EXPECT_EQ(image.strength, expected.strength) << hwy::TargetName(target);
        EXPECT_EQ(image.tileRows, expected.tileRows) << hwy::TargetName(target);
        for (std::size_t pixel = 0; pixel < expected.strength.size(); ++pixel)
        {
          if (expected.strength[pixel] > 0)
          {
            ASSERT_EQ(image.front[pixel], expected.front[pixel]) << hwy::TargetName(target);
          }
        }
      }
      hwy::SetSupportedTargetsForTest(0);
    }
  }
}

/// Bigler 2004, figure 4.4: smaller thresholds give more lines, and never lose one; the absolute
/// value of the Laplacian gives double lines where the positive side gives one.
TEST(TracedSilhouettes, ThresholdSweepOfTheThesis)
{
  const Camera camera = lookAtOrigin(true, 60, 14, 301, 215, 1, 200);
  const Traced traced(heap(), camera);
  const TracedFrame& frame = traced.renderer.frame();
  LinePixels<float> larger(frame.pixels(), 0);
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
