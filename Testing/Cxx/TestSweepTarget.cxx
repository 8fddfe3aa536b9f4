// SPDX-License-Identifier: BSD-3-Clause
/// Sweeps that go on until an error is reached.

#include "EstimateDifference.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "SyntheticSpheres.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace
{
TEST(SweepEstimator, KeepsThePromiseOfATargetError)
{
  // 72 bakes with fixed seeds: 5 families and a scene of unequal, overlapping spheres, 3 targets, 4
  // seeds. The promise is 95 %; if it were only 85 %, 4 or fewer failures would come in 1 run of
  // 100. The resolution is one at which textures are smoothed.
  std::vector<std::vector<po::Sphere>> scenes{ mixedScene() };
  for (const po::SyntheticFamily family : { po::SyntheticFamily::Pack, po::SyntheticFamily::Overlap,
         po::SyntheticFamily::Gas, po::SyntheticFamily::Shell, po::SyntheticFamily::Foam })
  {
    scenes.push_back(syntheticScene(family, 27));
  }
  int failures = 0;
  for (const std::vector<po::Sphere>& spheres : scenes)
  {
    const po::SphereCloud cloud = cloudOf(spheres);
    const po::BakeScene scene(cloud);
    po::BakeSettings settings = floatSettings(16, 4000);
    settings.seed = 77;
    const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, settings);
    for (const double target : { 0.05, 0.025, 0.0125 })
    {
      for (const std::uint64_t seed : { 1, 2, 3, 4 })
      {
        settings.seed = seed;
        po::SweepOptions options;
        options.targetError = target;
        const po::SweepEstimator sweep(options);
        const Estimates ours = estimateAll(sweep, scene, settings);
        EXPECT_TRUE(sweep.report().reached);
        EXPECT_LE(sweep.report().estimatedError, target);
        failures += compare(ours, judge, 16).rms > target ? 1 : 0;
      }
    }
  }
  EXPECT_LE(failures, 4);
}

/// Dark particles in a closed shell, whose error is 0, and a few open ones that small scattered
/// spheres surround, which take many directions. The open ones come last.
constexpr std::size_t DarkParticles = 343;
constexpr std::size_t OpenParticles = 8;

struct UnequalScene
{
  UnequalScene()
  {
    std::vector<po::Sphere> particles;
    for (std::size_t i = 0; i < DarkParticles; ++i)
    {
      const auto coordinate = [i](std::size_t stride)
      { return static_cast<float>(i / stride % 7) - 3; };
      particles.push_back({ coordinate(1), coordinate(7), coordinate(49), 0.4f });
    }
    std::vector<po::Sphere> casters;
    addClosedShell(casters, 10, 2, 700);
    po::Random random(6, 0, 0);
    for (std::size_t i = 0; i < OpenParticles; ++i)
    {
      const po::Sphere open{ 100 * static_cast<float>(i + 1), 0, 0, 1 };
      particles.push_back(open);
      for (int k = 0; k < 400; ++k)
      {
        const double z = 2 * random.uniform() - 1;
        const double angle = 6.283185307 * random.uniform();
        const double reach = 3 + 4 * random.uniform();
        const double r = reach * std::sqrt(1 - z * z);
        casters.push_back({ open.x + static_cast<float>(r * std::cos(angle)),
          static_cast<float>(r * std::sin(angle)), static_cast<float>(reach * z), 0.2f });
      }
    }
    cloud = cloudOf(particles);
    occluders.spheres = po::makeSphereCloudLike(cloud,
      { casters.size(), [&](std::size_t i) { return casters[i].center().as<double>(); },
        [&](std::size_t i) {
          return static_cast<double>(casters[i].radius);
        } }).spheres;
  }

  po::SphereCloud cloud;
  po::Occluders occluders;
};

/// Finds the open particles alone.
Estimates judgeOpenParticles(const po::BakeScene& scene, const po::BakeSettings& settings)
{
  std::vector<unsigned> list(OpenParticles);
  std::iota(list.begin(), list.end(), static_cast<unsigned>(DarkParticles));
  return estimateList(po::ReferenceEstimator(), scene, list, settings);
}

/// RMS errors of the open particles, one by one.
std::vector<double> errorsOfOpenParticles(const Estimates& ours, const Estimates& judge, int side)
{
  const auto texels = static_cast<std::ptrdiff_t>(side * side);
  const auto part = [texels](const std::vector<float>& all, std::size_t particle)
  {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(particle) * texels;
    return std::vector<float>(first, first + texels);
  };
  std::vector<double> errors;
  for (std::size_t i = 0; i < OpenParticles; ++i)
  {
    const Estimates one{ part(ours.values, DarkParticles + i),
      part(ours.shares, DarkParticles + i) };
    const Estimates other{ part(judge.values, i), part(judge.shares, i) };
    errors.push_back(compare(one, other, side).rms);
  }
  return errors;
}

TEST(SweepEstimator, LeavesAFewParticlesAboveTheTargetToRays)
{
  const UnequalScene unequal;
  const po::BakeScene scene(unequal.cloud, unequal.occluders);
  po::BakeSettings settings = floatSettings(6, 40000);
  settings.seed = 77;
  const Estimates judge = judgeOpenParticles(scene, settings);
  po::SweepOptions options;
  options.targetError = 0.006;
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    settings.seed = seed;
    options.refineByRays = false;
    const po::SweepEstimator alone(options);
    (void)estimateAll(alone, scene, settings);
    EXPECT_TRUE(alone.report().reached);
    EXPECT_EQ(alone.report().refined, 0u);

    options.refineByRays = true;
    const po::SweepEstimator refined(options);
    const Estimates ours = estimateAll(refined, scene, settings);
    EXPECT_TRUE(refined.report().reached);
    EXPECT_EQ(refined.report().refined, OpenParticles);
    EXPECT_LT(refined.report().directions, alone.report().directions);
    EXPECT_LE(refined.report().estimatedError, options.targetError);
    EXPECT_GT(refined.report().estimatedError, 0);
    for (const double error : errorsOfOpenParticles(ours, judge, 6))
    {
      EXPECT_LT(error, options.targetError);
    }
    EXPECT_EQ(*std::max_element(ours.values.begin(), ours.values.begin() + DarkParticles * 36), 0);
  }
}

TEST(SweepEstimator, GivesTheSameBitsWithATargetForAnyNumberOfThreads)
{
  const UnequalScene unequal;
  const po::BakeScene scene(unequal.cloud, unequal.occluders);
  po::SweepOptions options;
  options.targetError = 0.006;
  std::vector<Estimates> results;
  std::vector<double> errors;
  for (const std::size_t threads : { 1, 2, 7 })
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const po::SweepEstimator sweep(options);
    results.push_back(estimateAll(sweep, scene, floatSettings(8, 49)));
    errors.push_back(sweep.report().estimatedError);
    EXPECT_EQ(sweep.report().refined, OpenParticles);
  }
  for (const std::size_t other : { 1, 2 })
  {
    EXPECT_EQ(results[other].values, results[0].values);
    EXPECT_EQ(results[other].shares, results[0].shares);
    EXPECT_EQ(errors[other], errors[0]);
  }
}
}
