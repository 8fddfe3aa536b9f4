// SPDX-License-Identifier: BSD-3-Clause
/// Means over seeds, and how errors fall with the work.

#include "StressCase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace stress;

const Scene& sceneOf(const std::string& name)
{
  static const std::vector<Scene> all = scenes();
  return *std::find_if(all.begin(), all.end(), [&](const Scene& s) { return s.name == name; });
}

/// The mean of bakes with different seeds.
Baked meanOverSeeds(const Scene& scene, Method method, int work, int seeds, double distance)
{
  Baked mean;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    const Baked one =
      bake(scene.balls, scene.watched, method, work, static_cast<std::uint64_t>(seed), distance);
    mean.values.resize(one.values.size());
    mean.shares.resize(one.values.size());
    for (std::size_t i = 0; i < one.values.size(); ++i)
    {
      mean.values[i] += one.values[i] / static_cast<float>(seeds);
      mean.shares[i] += one.shares[i] / static_cast<float>(seeds);
    }
  }
  return mean;
}

struct Trial
{
  const char* scene;
  double distance;
};
constexpr Trial Trials[] = { { "cloud", 0 }, { "touching", 0 }, { "overlap 0.1 r", 0 },
  { "overlap 0.9 r", 0 }, { "plane", 0 }, { "solid of 4096", 0 }, { "dense cloud of 2000", 0 },
  { "grazing", 0 }, { "radii 1 : 1,000,000", 0 }, { "two clouds, 1e9 radii apart", 0 },
  { "cloud", 0.6 }, { "touching", 3 } };

class Unbiased : public testing::TestWithParam<Method>
{
};

/// Every texel of the mean over 16 seeds against the judge (Sidak over all texels of all trials).
/// The bound on what may remain: for Reference and Sweep none at a texel; for Embree, whose rays
/// stand for up to 16 texels here, 0.04 at a texel. The mean of a scene: 0, 0.001 and 0.
TEST_P(Unbiased, TexelByTexelOverSeeds)
{
  constexpr int seeds = 16;
  constexpr int points = 4096;
  const Method method = GetParam();
  const int work = method == Method::Reference ? 100 : 144;
  const double blur = method == Method::Embree ? 0.04 : 0;
  std::size_t texels = 0;
  for (const Trial& trial : Trials)
  {
    texels += sceneOf(trial.scene).watched.size() * Texels;
  }
  const double bound = sidakBound(texels, 1e-3);
  for (const Trial& trial : Trials)
  {
    SCOPED_TRACE(std::string(trial.scene) + " within " + std::to_string(trial.distance));
    const Scene& scene = sceneOf(trial.scene);
    const Judgement judgement = judgeOf(scene.balls, scene.watched, points, trial.distance);
    const Baked mean = meanOverSeeds(scene, method, work, seeds, trial.distance);
    const double rays = independentRays(method, seeds * work);
    const Outcome outcome = compare(scene, judgement, mean, rays);
    std::size_t deviating = 0;
    for (std::size_t i = 0; i < judgement.texels.size(); ++i)
    {
      const judge::Texel& truth = judgement.texels[i];
      const double value = static_cast<double>(mean.values[i]);
      const double error = value - truth.value();
      const double beyond = std::copysign(std::max(0.0, std::abs(error) - blur), error);
      const double share = std::clamp(truth.value() + beyond, 0.0, 1.0);
      const double n = rays * static_cast<double>(mean.shares[i]);
      deviating += truth.outside >= 16 && mean.shares[i] > 0 &&
          std::abs(zOf(truth.open, truth.outside, share * n, n)) > bound
        ? 1
        : 0;
    }
    EXPECT_EQ(deviating, 0u);
    EXPECT_LT(std::abs(outcome.bias),
      (method == Method::Sweep ? 0.001 : 0) +
        sidakBound(std::size(Trials), 1e-3) * outcome.biasError);
    EXPECT_EQ(outcome.selfHits, 0u);
  }
}

TEST(StressStatistics, WholeTilesAreClosedWithoutBias)
{
  constexpr int seeds = 4;
  const Scene scene = layers();
  const Judgement judgement = judgeOf(scene.balls, scene.watched, 4096);
  const Baked mean = meanOverSeeds(scene, Method::Sweep, 144, seeds, 0);
  const Outcome outcome =
    compare(scene, judgement, mean, independentRays(Method::Sweep, seeds * 144));
  EXPECT_LT(outcome.worstZ, sidakBound(outcome.texels, 1e-3));
  EXPECT_LT(std::abs(outcome.bias), 0.001 + 4 * outcome.biasError);
}

INSTANTIATE_TEST_SUITE_P(All, Unbiased, testing::ValuesIn(Methods),
  [](const testing::TestParamInfo<Method>& info) { return nameOf(info.param); });

/// RMS difference of two seeds, which is the error times the root of 2.
double spread(const Scene& scene, Method method, int work)
{
  double squares = 0;
  std::size_t count = 0;
  for (std::uint64_t pair = 0; pair < 3; ++pair)
  {
    const Baked a = bake(scene.balls, scene.watched, method, work, 10 + 2 * pair);
    const Baked b = bake(scene.balls, scene.watched, method, work, 11 + 2 * pair);
    for (std::size_t i = 0; i < a.values.size(); ++i)
    {
      const double difference = static_cast<double>(a.values[i]) - b.values[i];
      const bool counts = a.shares[i] > 0.3f;
      squares += counts ? difference * difference : 0;
      count += counts;
    }
  }
  return std::sqrt(squares / (2 * static_cast<double>(count)));
}

/// The exponent of work in the error, from a factor of 16.
double slope(const Scene& scene, Method method, int work)
{
  return std::log(spread(scene, method, 16 * work) / spread(scene, method, work)) / std::log(16.0);
}

TEST(StressConvergence, ErrorsFallAtLeastAsTheRootOfTheWork)
{
  // Stratified rays: N^-1/2 at worst, N^-3/4 at best (edges of shadows), beyond where most of the
  // sky is open. Evenly spread directions likewise; of Embree the blur falls too, when its rays
  // stand for fewer texels.
  for (const char* name : { "cloud", "touching", "grazing" })
  {
    for (const Method method : Methods)
    {
      SCOPED_TRACE(std::string(name) + ", " + nameOf(method));
      const double found = slope(sceneOf(name), method, method == Method::Reference ? 25 : 64);
      EXPECT_LT(found, -0.5);
      EXPECT_GT(found, -1.0);
    }
  }
}
}
