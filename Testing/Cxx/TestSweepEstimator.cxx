// SPDX-License-Identifier: BSD-3-Clause
#include "Constants.h"
#include "EstimateDifference.h"
#include "OcclusionBaker.h"
#include "ProgressiveSweep.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "SyntheticSpheres.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace
{
po::SweepEstimator sweepOf(int directions)
{
  po::SweepOptions options;
  options.directions = directions;
  return po::SweepEstimator(options);
}

TEST(SweepEstimator, AClosedShellIsDarkInside)
{
  std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
  addClosedShell(spheres, 8, 2, 400);
  const po::SphereCloud cloud = cloudOf(spheres);
  const Estimates ours =
    estimateAll(po::SweepEstimator(), po::BakeScene(cloud), floatSettings(8, 49));
  EXPECT_EQ(*std::max_element(ours.values.begin(), ours.values.begin() + 64), 0.0f);
  EXPECT_GT(*std::max_element(ours.values.begin() + 64, ours.values.end()), 0.9f);
}

TEST(SweepEstimator, AgreesWithAnIndependentJudge)
{
  // Double precision on a few particles of a scene with overlaps: 15 particles x 36 texels; the
  // judge has 16,384 rays a texel, its error is below 0.004.
  const std::vector<po::Sphere> spheres = mixedScene();
  const po::SphereCloud cloud = cloudOf(spheres);
  const Estimates ours = estimateAll(sweepOf(4096), po::BakeScene(cloud), floatSettings(6, 1));
  const judge::Judge rays = judgeOf(spheres);
  Estimates found = ours;
  for (std::size_t i = 0; i < found.values.size(); ++i)
  {
    const std::size_t id = i / 36;
    found.shares[i] = 0;
    if (id % 4 == 0)
    {
      const judge::Texel texel =
        rays.look(id, 6, static_cast<int>(i / 6 % 6), static_cast<int>(i % 6), 16384);
      found.values[i] = static_cast<float>(texel.value());
      found.shares[i] = static_cast<float>(texel.outsideShare());
    }
  }
  const Difference difference = compare(ours, found, 6);
  EXPECT_LT(difference.rms, 0.01);
  EXPECT_LT(std::abs(difference.bias), 0.002);
}

TEST(SweepEstimator, GivesTheSameBitsForAnyNumberOfThreads)
{
  std::vector<po::Sphere> spheres = mixedScene();
  addClosedShell(spheres, 30, 1, 3000);
  const po::SphereCloud cloud = cloudOf(spheres);
  const po::BakeScene scene(cloud);
  std::vector<Estimates> results;
  for (const std::size_t threads : { 1, 2, 7 })
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(estimateAll(po::SweepEstimator(), scene, floatSettings(16, 49)));
  }
  EXPECT_EQ(results[1].values, results[0].values);
  EXPECT_EQ(results[2].values, results[0].values);
  EXPECT_EQ(results[1].shares, results[0].shares);
  EXPECT_EQ(results[2].shares, results[0].shares);
}

TEST(SweepEstimator, GivesTheSameBitsOutOfCore)
{
  std::vector<po::Sphere> spheres = mixedScene();
  addClosedShell(spheres, 30, 1, 3000);
  spheres.insert(spheres.end(), spheres.begin(), spheres.begin() + 1500); // some are there twice
  spheres.push_back(spheres[0]);
  const po::SphereCloud cloud = cloudOf(spheres);
  const po::BakeScene scene(cloud);
  po::SweepOptions options;
  options.outOfCore = true;
  const po::SweepEstimator outOfCore(options);
  const po::SweepEstimator inMemory;
  for (const auto& [resolution, distance] :
    { std::pair(16, 0.0), std::pair(16, 3.0), std::pair(5, 0.0), std::pair(37, 0.0) })
  {
    po::BakeSettings settings = floatSettings(resolution, 49);
    settings.maximumDistance = distance;
    settings.background = po::GradientBackground{ { 0, 0, 1 }, 0, 1 };
    const Estimates whole = estimateAll(inMemory, scene, settings);
    const Estimates logged = estimateAll(outOfCore, scene, settings);
    EXPECT_EQ(logged.values, whole.values) << resolution << " " << distance;
    EXPECT_EQ(logged.shares, whole.shares) << resolution << " " << distance;
    EXPECT_GT(inMemory.report().estimatedError, 0);
    EXPECT_EQ(outOfCore.report().estimatedError, inMemory.report().estimatedError);
  }
}

TEST(SweepEstimator, HasNoBias)
{
  // Over seeds errors average out, a bias does not: 24 bakes with 144 directions of each family.
  // The judge's own mean is known to 0.0002.
  for (const po::SyntheticFamily family : { po::SyntheticFamily::Pack, po::SyntheticFamily::Overlap,
         po::SyntheticFamily::Gas, po::SyntheticFamily::Shell, po::SyntheticFamily::Foam })
  {
    SCOPED_TRACE(static_cast<int>(family));
    const po::SphereCloud cloud = cloudOf(syntheticScene(family, 200));
    const po::BakeScene scene(cloud);
    po::BakeSettings settings = floatSettings(6, 6000);
    settings.seed = 77;
    const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, settings);
    double sum = 0;
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
    {
      settings.seed = seed;
      const double bias = compare(estimateAll(sweepOf(144), scene, settings), judge, 6).bias;
      sum += bias / 24;
      squares += bias * bias / 24;
    }
    const double standardError = std::sqrt((squares - sum * sum) / 23);
    EXPECT_LT(std::abs(sum), 0.001 + 3 * standardError);
    EXPECT_LT(standardError, 0.0005);
  }
}

TEST(ProgressiveSweep, HandsOutAPreviewAndRefinesIt)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::BakeSettings settings = floatSettings(6, 6000);
  settings.seed = 77;
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, settings);
  std::vector<unsigned> all(cloud.spheres.size());
  std::iota(all.begin(), all.end(), 0u);
  po::Progress progress;
  po::ProgressiveSweep sweep(scene, all, settings);
  double last = 0.25; // what a preview of 16 directions stays below
  for (const int more : { 16, 32, 144, 800 })
  {
    sweep.refine(more, progress);
    Estimates ours;
    po::BakeCounters counters;
    sweep.handOut(
      [&](const po::RawTextures& raw)
      {
        ours.values.insert(ours.values.end(), raw.values, raw.values + raw.count * 36);
        ours.shares.insert(
          ours.shares.end(), raw.outsideShares, raw.outsideShares + raw.count * 36);
      },
      progress, counters);
    ASSERT_EQ(ours.values.size(), judge.values.size());
    const double error = compare(ours, judge, 6).rms;
    EXPECT_LT(error, 0.8 * last) << sweep.directions();
    last = error;
  }
  EXPECT_EQ(sweep.directions(), 16 + 32 + 144 + 800);
}

TEST(SweepEstimator, AListGetsWhatTheWholeSetGets)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const po::BakeSettings settings = floatSettings(8, 49);
  const Estimates all = estimateAll(po::SweepEstimator(), scene, settings);
  const std::vector<unsigned> list{ 3, 17, 42 };
  const std::vector<float> values =
    estimateList(po::SweepEstimator(), scene, list, settings).values;
  ASSERT_EQ(values.size(), 3 * 64u);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    // Not the same bits: of particles that are not asked for, the parts inside others are not told
    // apart, so that a few more of them count as occluders.
    EXPECT_NEAR(values[i], all.values[list[i / 64] * 64 + i % 64], 0.05);
  }
}
}
