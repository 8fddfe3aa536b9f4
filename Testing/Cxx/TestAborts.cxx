// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <thread>

namespace
{
struct Estimator
{
  const char* name;
  std::unique_ptr<po::OcclusionEstimator> (*make)(double targetError);
};

const Estimator Estimators[] = {
  { "Sweep",
    [](double targetError) -> std::unique_ptr<po::OcclusionEstimator>
    {
      po::SweepOptions options;
      options.targetError = targetError;
      return std::make_unique<po::SweepEstimator>(options);
    } },
  { "Embree",
    [](double targetError) -> std::unique_ptr<po::OcclusionEstimator>
    {
      po::EmbreeOptions options;
      options.targetError = targetError;
      return std::make_unique<po::EmbreeEstimator>(options);
    } },
  { "Reference",
    [](double) -> std::unique_ptr<po::OcclusionEstimator>
    { return std::make_unique<po::ReferenceEstimator>(); } },
};

class Aborts : public testing::TestWithParam<Estimator>
{
};
INSTANTIATE_TEST_SUITE_P(Estimators, Aborts, testing::ValuesIn(Estimators),
  [](const auto& info) { return info.param.name; });

/// Asks after every unit of work of the calling thread, not now and then: any moment may be the
/// last.
po::BakeResult bake(const po::BakeScene& scene, const po::BakeSettings& settings,
  const po::OcclusionEstimator& estimator, std::size_t reportsUntilAbort, std::size_t* reports)
{
  std::size_t count = 0;
  po::Progress progress(
    [&](double) { return ++count < reportsUntilAbort; }, std::chrono::milliseconds(0));
  po::BakeResult result = po::bakeOcclusion(scene, settings, estimator, progress);
  if (reports)
  {
    *reports = count;
  }
  return result;
}

TEST_P(Aborts, AHundredAtRandomMomentsLeaveTheNextBakeItsBits)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const po::BakeSettings settings = floatSettings(4, 30);
  std::mt19937_64 random(20261126);
  for (const double targetError : { 0.0, 0.02 })
  {
    const auto estimator = GetParam().make(targetError);
    std::size_t reports = 0;
    const po::BakeResult whole = bake(scene, settings, *estimator, ~std::size_t{ 0 }, &reports);
    ASSERT_FALSE(whole.aborted);
    ASSERT_GT(reports, 5u);
    int aborted = 0;
    for (int i = 0; i < 100; ++i)
    {
      aborted += bake(scene, settings, *estimator, 1 + random() % reports, nullptr).aborted;
    }
    // How many reports the calling thread makes depends on its share of the work.
    EXPECT_GT(aborted, 50);
    const po::BakeResult again = bake(scene, settings, *estimator, ~std::size_t{ 0 }, nullptr);
    EXPECT_FALSE(again.aborted);
    EXPECT_TRUE(again.table.floats == whole.table.floats);
    EXPECT_TRUE(again.rowOf == whole.rowOf);
    EXPECT_TRUE(again.mean == whole.mean);
  }
}

/// One that takes hours unless it is heard, so that the time limit of the test is met.
TEST_P(Aborts, StopABakeOfHours)
{
  std::vector<po::Sphere> spheres;
  addClosedShell(spheres, 300, 1, 50000);
  const po::SphereCloud cloud = cloudOf(spheres);
  const auto caller = std::this_thread::get_id();
  double last = 0;
  int reports = 0;
  po::Progress progress(
    [&](double share)
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_GE(share, last);
      last = share;
      return ++reports < 3;
    });
  const po::BakeResult result = po::bakeOcclusion(
    po::BakeScene(cloud), floatSettings(16, 100000), *GetParam().make(0), progress);
  EXPECT_TRUE(result.aborted);
  EXPECT_EQ(reports, 3);
  EXPECT_LT(last, 0.1);
}
}
