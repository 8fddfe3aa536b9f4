// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeEstimator.h"
#include "EstimateDifference.h"
#include "Random.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TestScenes.h"
#include "TexelMap.h"
#include "TextureSmoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace
{
std::vector<float> randomTexels(int resolution, std::uint64_t seed)
{
  po::Random random(seed, 0, 0);
  std::vector<float> texels(static_cast<std::size_t>(resolution) * resolution);
  std::generate(texels.begin(), texels.end(), [&] { return float(random.uniform()); });
  return texels;
}

/// A third of the texels is inside, a third partly outside.
std::vector<float> randomShares(int resolution)
{
  std::vector<float> shares = randomTexels(resolution, 5);
  for (float& share : shares)
  {
    share = std::clamp(3 * share - 1, 0.0f, 1.0f);
  }
  return shares;
}

std::vector<float> smooth(
  int resolution, int directions, std::vector<float> values, const std::vector<float>& shares)
{
  const po::SweepTexels texels(resolution);
  po::TextureSmoothing(texels, directions).apply(values.data(), shares.data());
  return values;
}

std::vector<float> wholeShares(int resolution)
{
  return std::vector<float>(static_cast<std::size_t>(resolution) * resolution, 1.0f);
}

double outsideMean(
  int resolution, const std::vector<float>& values, const std::vector<float>& shares)
{
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double weight =
      double(shares[i]) * po::texelArea(resolution, static_cast<int>(i) / resolution);
    sum += weight * double(values[i]);
    weights += weight;
  }
  return sum / weights;
}

double meanSquare(const std::vector<float>& values, double mean)
{
  double sum = 0;
  for (const float value : values)
  {
    sum += (double(value) - mean) * (double(value) - mean);
  }
  return sum / double(values.size());
}

TEST(TextureSmoothing, KeepsTheMeanAndTheRange)
{
  for (const int resolution : { 12, 13, 16, 32, 64 })
  {
    for (const int directions : { 16, 112, 2000 })
    {
      for (const std::vector<float>& shares : { wholeShares(resolution), randomShares(resolution) })
      {
        SCOPED_TRACE(testing::Message() << resolution << ", " << directions << ", " << shares[0]);
        std::vector<float> values = randomTexels(resolution, 1);
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          values[i] = shares[i] > 0 ? 0.25f + 0.5f * values[i] : 0.0f;
        }
        const std::vector<float> smoothed = smooth(resolution, directions, values, shares);
        EXPECT_NE(smoothed, values);
        EXPECT_NEAR(
          outsideMean(resolution, smoothed, shares), outsideMean(resolution, values, shares), 1e-6);
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          if (shares[i] == 0)
          {
            EXPECT_EQ(smoothed[i], 0); // what is inside takes no part
            continue;
          }
          EXPECT_GE(smoothed[i], 0.2499f);
          EXPECT_LE(smoothed[i], 0.7501f);
        }
      }
    }
  }
}

TEST(TextureSmoothing, LeavesWhatIsAllAlikeExactly)
{
  const std::vector<float> open = wholeShares(16);
  EXPECT_EQ(smooth(16, 112, open, open), open);
  EXPECT_EQ(smooth(16, 112, open, randomShares(16)), open);
  const std::vector<float> dark(256, 0.0f);
  EXPECT_EQ(smooth(16, 112, dark, randomShares(16)), dark);
}

TEST(TextureSmoothing, LeavesWhatIsInsideAsItIs)
{
  // Whole rows are inside, and single texels; what they hold changes nothing.
  std::vector<float> shares = randomShares(16);
  std::fill_n(shares.begin(), 128, 0.0f);
  const std::vector<float> values = randomTexels(16, 7);
  std::vector<float> others = values;
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    others[i] = shares[i] > 0 ? values[i] : 0.0f;
  }
  const std::vector<float> smoothed = smooth(16, 112, values, shares);
  const std::vector<float> smoothedOthers = smooth(16, 112, others, shares);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(smoothed[i], shares[i] > 0 ? smoothedOthers[i] : values[i]) << i;
  }
  EXPECT_NEAR(outsideMean(16, smoothed, shares), outsideMean(16, values, shares), 1e-6);
  EXPECT_NE(smoothed, values);
}

TEST(TextureSmoothing, SmoothsLessWhereThereIsLessNoise)
{
  const std::vector<float> noise = randomTexels(16, 2);
  double before = 0;
  for (const int directions : { 16, 64, 256, 1024, 1 << 20 })
  {
    const double left = meanSquare(smooth(16, directions, noise, wholeShares(16)), 0.5);
    EXPECT_GT(left, before);
    before = left;
  }
  EXPECT_GT(before, 0.95 * meanSquare(noise, 0.5));
}

TEST(TextureSmoothing, TurnsWithTheTexture)
{
  const std::vector<float> values = randomTexels(16, 3);
  const std::vector<float> shares = randomShares(16);
  const auto turned = [](std::vector<float> texels)
  {
    for (auto row = texels.begin(); row != texels.end(); row += 16)
    {
      std::rotate(row, row + 5, row + 16);
    }
    return texels;
  };
  const std::vector<float> a = turned(smooth(16, 112, values, shares));
  const std::vector<float> b = smooth(16, 112, turned(values), turned(shares));
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_NEAR(a[i], b[i], 1e-6f);
  }
}

TEST(TextureSmoothing, ReachesAcrossThePole)
{
  std::vector<float> spot(256, 0.0f);
  spot[0] = 1;
  const std::vector<float> smoothed = smooth(16, 112, spot, wholeShares(16));
  EXPECT_GT(smoothed[8], 0.25f * smoothed[1]); // 0.2 radians away, across the pole
  EXPECT_EQ(smoothed[7 * 16], 0);
}

TEST(TextureSmoothing, TrustsTexelsLittleOfWhichLittleIsOutside)
{
  // Few points make such a value. Its neighbours, all of them outside, take over.
  const std::size_t place = 8 * 16 + 5;
  std::vector<float> shares = wholeShares(16);
  shares[place] = 0.05f;
  std::vector<float> values(256, 0.5f);
  values[place] = 1;
  EXPECT_NEAR(smooth(16, 112, values, shares)[place], 0.5f, 0.15f);
  shares[place] = 1;
  EXPECT_GT(smooth(16, 112, values, shares)[place], 0.65f);
}

TEST(TextureSmoothing, LeavesMeansOverFinerTexels)
{
  const std::vector<float> values = randomTexels(11, 4);
  EXPECT_EQ(smooth(11, 16, values, wholeShares(11)), values);
  EXPECT_NE(smooth(12, 16, randomTexels(12, 4), wholeShares(12)), randomTexels(12, 4));
}

TEST(TextureSmoothing, LowersTheErrorOfABake)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::BakeSettings settings = floatSettings(16, 1500);
  settings.seed = 77;
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, settings);
  settings.seed = 1;
  po::SweepOptions sweep;
  sweep.directions = 96;
  po::EmbreeOptions embree;
  embree.directions = 96;
  const auto error = [&](const po::OcclusionEstimator& estimator)
  { return compare(estimateAll(estimator, scene, settings), judge, 16).rms; };
  const double sweepSmooth = error(po::SweepEstimator(sweep));
  const double embreeSmooth = error(po::EmbreeEstimator(embree));
  sweep.smooth = false;
  embree.smooth = false;
  EXPECT_LT(sweepSmooth, 0.9 * error(po::SweepEstimator(sweep)));
  EXPECT_LT(embreeSmooth, 0.9 * error(po::EmbreeEstimator(embree)));
}
}
