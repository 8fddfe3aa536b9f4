// SPDX-License-Identifier: BSD-3-Clause
// Bakes as such, whatever they see: threads, seeds, samples, and how textures become a table.
#include "EmbreeEstimator.h"
#include "ErrorPilot.h"
#include "ReferenceBake.h"
#include "SweepEstimator.h"
#include "TexelMap.h"
#include "WorkingThreads.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace
{
TEST(Bakes, GivesTheSameBitsForAnyNumberOfThreads)
{
  std::vector<po::Sphere> spheres = mixedScene();
  addClosedShell(spheres, 20, 1, 200); // more particles than one hand-over takes
  const po::BakeSettings settings;     // the defaults: bytes, dilation, 49 samples
  std::vector<po::BakeResult> results;
  for (const std::size_t threads : { 1, 2, 7 })
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(bake(spheres, settings));
  }
  for (const po::BakeResult& result : results)
  {
    EXPECT_EQ(result.table.bytes, results[0].table.bytes);
    EXPECT_EQ(result.rowOf, results[0].rowOf);
    EXPECT_EQ(result.mean, results[0].mean);
    EXPECT_EQ(result.counters.rays, results[0].counters.rays);
  }
  EXPECT_EQ(results[0].counters.threads, 1u);
}

TEST(Bakes, UsesMoreThanOneThread)
{
  std::vector<po::Sphere> spheres = mixedScene();
  addClosedShell(spheres, 20, 1, 200); // more particles than one hand-over takes
  const po::BakeSettings settings;
  EXPECT_TRUE(moreThanOneThreadTakesPart([&] { return bake(spheres, settings).counters.threads; }));
}

TEST(Bakes, TheSeedChangesTheNoiseAndNothingElse)
{
  const std::vector<po::Sphere> spheres = mixedScene();
  po::BakeSettings settings = floatSettings(4, 400);
  const po::BakeResult first = bake(spheres, settings);
  settings.seed = 2;
  const po::BakeResult second = bake(spheres, settings);
  EXPECT_NE(first.table.floats, second.table.floats);
  double difference = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
  {
    difference += first.mean[i] - second.mean[i];
  }
  // 60 particles of about 5,000 rays: the standard error of the mean difference is below 0.002.
  EXPECT_NEAR(difference / static_cast<double>(spheres.size()), 0, 0.006);
}

TEST(Bakes, RefinesAsRaysAreAdded)
{
  // The error must fall at least as fast as N^-1/2: from 16 to 256 rays by 4, here at least by 3.
  const std::vector<po::Sphere> spheres = mixedScene();
  const po::BakeResult judge = bake(spheres, floatSettings(4, 20000));
  const auto rms = [&](int samples)
  {
    const po::BakeResult result = bake(spheres, floatSettings(4, samples));
    double sum = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i)
    {
      for (std::size_t texel = 0; texel < 16; ++texel)
      {
        sum += std::pow(texelValue(result, i, texel) - texelValue(judge, i, texel), 2);
      }
    }
    return std::sqrt(sum / (16.0 * static_cast<double>(spheres.size())));
  };
  EXPECT_GT(rms(16) / rms(256), 3);
}

TEST(Bakes, ThePilotFindsTheSamplesThatReachAnError)
{
  // The promised error against a far finer bake of all particles, weighted by visible area. The
  // pilot's own estimate from 960 texels scatters by about 5 %.
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, floatSettings(4, 20000));
  for (const double target : { 0.05, 0.02, 0.01 })
  {
    po::Progress progress;
    po::BakeSettings settings = floatSettings(4, 1);
    const po::PilotResult pilot = po::samplesForError(
      scene, allOf(scene), settings, po::ReferenceEstimator(), target, progress);
    ASSERT_TRUE(pilot.reached);
    EXPECT_LE(pilot.estimatedError, target);
    settings.samplesPerTexel = pilot.samplesPerTexel;
    settings.seed = 99;
    const Estimates result = estimateAll(po::ReferenceEstimator(), scene, settings);
    double squares = 0;
    double area = 0;
    for (std::size_t i = 0; i < judge.values.size(); ++i)
    {
      const double weight = po::texelArea(4, static_cast<int>(i / 4 % 4)) * judge.shares[i];
      squares += weight * std::pow(result.values[i] - judge.values[i], 2);
      area += weight;
    }
    const double error = std::sqrt(squares / area);
    EXPECT_LT(error, 1.2 * target);
    EXPECT_GT(error, 0.4 * target); // and no more work than that needs
  }
}

TEST(Bakes, AnEmptyCloudGivesAnEmptyTable)
{
  const po::BakeResult result = bake({}, po::BakeSettings{});
  EXPECT_EQ(result.table.rows, 0);
  EXPECT_TRUE(result.rowOf.empty());
}

/// A bake's bytes, made while textures arrive, are those of the table of all linear values.
TEST(Bakes, BytesAreThoseOfAllValuesTogether)
{
  std::vector<po::Sphere> closed;
  addClosedShell(closed, 5, 1.2, 150);
  std::vector<po::Sphere> mixed = mixedScene();
  mixed.push_back({ 90, 90, 90, 1 }); // open all over, the last one
  po::GradientBackground sky;
  sky.top = 3;
  std::vector<std::unique_ptr<po::OcclusionEstimator>> methods;
  methods.push_back(std::make_unique<po::ReferenceEstimator>());
  methods.push_back(std::make_unique<po::SweepEstimator>());
  methods.push_back(std::make_unique<po::EmbreeEstimator>());
  for (const std::vector<po::Sphere>& spheres : { mixed, closed })
  {
    for (const po::Background& background :
      { po::Background{ po::UniformBackground{} }, po::Background{ sky } })
    {
      for (const auto& method : methods)
      {
        const po::SphereCloud cloud = cloudOf(spheres);
        const po::BakeScene scene(cloud);
        po::Progress progress;
        po::BakeSettings settings = floatSettings(8, 25);
        settings.background = background;
        const po::BakeResult linear = po::bakeOcclusion(scene, settings, *method, progress);
        settings.encoding = po::Encoding::UInt8Gamma2;
        const po::BakeResult bytes = po::bakeOcclusion(scene, settings, *method, progress);

        po::TextureTable table(8, 0);
        for (std::int32_t row = 0; row < linear.table.rows; ++row)
        {
          ASSERT_EQ(table.insert(linear.table.floats.data() + 64 * row), row);
        }
        const double brightest = table.largestValue();
        EXPECT_LE(brightest, background.index() == 0 ? 1 : 3);
        std::vector<std::int32_t> rowOf = linear.rowOf;
        const po::EncodedTable expected =
          po::encode(std::move(table), po::Encoding::UInt8Gamma2, rowOf);
        EXPECT_EQ(bytes.table.maximum, brightest);
        EXPECT_EQ(bytes.table.bytes, expected.bytes);
        EXPECT_EQ(bytes.table.textures, expected.textures);
        EXPECT_EQ(bytes.rowOf, rowOf);
      }
    }
  }
}
}
