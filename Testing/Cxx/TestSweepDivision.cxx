// SPDX-License-Identifier: BSD-3-Clause
/// Sweeps that processes divide, against the same sweep by one. Threads play the processes.

#include "OcclusionBaker.h"
#include "SweepEstimator.h"
#include "TestScenes.h"
#include "ThreadGroup.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace
{
/// Overlapping spheres of three sizes, which are different bands, many of them buried; and two that
/// are the same.
std::vector<po::Sphere> crowdedScene()
{
  po::Random random(31, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 900; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(12 * random.uniform()); };
    const float size = i < 20 ? 2.0f : (i < 700 ? 0.7f : 0.05f);
    spheres.push_back({ coordinate(), coordinate(), coordinate(),
      size * static_cast<float>(0.8 + 0.4 * random.uniform()) });
  }
  spheres.push_back(spheres[800]);
  return spheres;
}

/// The particles that a process asks for: some by turns, and the first ten by all.
std::vector<unsigned> shareOf(int rank, int processes, std::size_t particles)
{
  std::vector<unsigned> share;
  for (unsigned i = 0; i < particles; ++i)
  {
    if (i < 10 || i % static_cast<unsigned>(processes) == static_cast<unsigned>(rank))
    {
      share.push_back(i);
    }
  }
  return share;
}

struct Part
{
  std::vector<unsigned> particles;
  Estimates found;
  po::BakeCounters counters;
};

std::vector<Part> sweepTogether(const std::vector<po::Sphere>& spheres, int processes,
  const po::BakeSettings& settings, const po::SweepOptions& options)
{
  const po::SphereCloud cloud = cloudOf(spheres);
  std::vector<Part> parts(static_cast<std::size_t>(processes));
  inParallel(processes,
    [&](const po::ProcessGroup& group)
    {
      Part& part = parts[static_cast<std::size_t>(group.rank())];
      part.particles = shareOf(group.rank(), processes, spheres.size());
      const po::BakeScene scene(cloud, {}, group);
      part.found =
        estimateList(po::SweepEstimator(options), scene, part.particles, settings, &part.counters);
      part.counters = part.counters.summed(group);
    });
  return parts;
}

void expectSameAsAlone(const std::vector<po::Sphere>& spheres, int processes,
  const po::BakeSettings& settings, const po::SweepOptions& options)
{
  const Part alone = sweepTogether(spheres, 1, settings, options).front();
  const auto texels =
    static_cast<std::size_t>(settings.textureResolution * settings.textureResolution);
  const auto textureOf = [&](const std::vector<float>& values, std::size_t place)
  {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(place * texels);
    return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(texels));
  };
  for (const Part& part : sweepTogether(spheres, processes, settings, options))
  {
    ASSERT_EQ(part.found.values.size(), part.particles.size() * texels);
    for (std::size_t i = 0; i < part.particles.size(); ++i)
    {
      const unsigned particle = part.particles[i];
      EXPECT_EQ(textureOf(part.found.values, i), textureOf(alone.found.values, particle));
      EXPECT_EQ(textureOf(part.found.shares, i), textureOf(alone.found.shares, particle));
    }
    EXPECT_EQ(part.counters.spheresClosed, alone.counters.spheresClosed);
    EXPECT_EQ(part.counters.spheresNeverSeen, alone.counters.spheresNeverSeen);
    EXPECT_EQ(part.counters.directionsBlack, alone.counters.directionsBlack);
  }
}

/// In memory and out of core; beyond 128 directions texels get new points.
TEST(SweepDivision, HasTheBitsOfOneProcess)
{
  po::SweepOptions options;
  options.directions = 160;
  for (const bool outOfCore : { false, true })
  {
    options.outOfCore = outOfCore;
    for (const int processes : { 2, 3 })
    {
      expectSameAsAlone(crowdedScene(), processes, floatSettings(8, 49), options);
    }
  }
}

TEST(SweepDivision, HasTheBitsOfOneProcessForMoreProcessesThanAxes)
{
  po::SweepOptions options;
  options.directions = 48;
  expectSameAsAlone(crowdedScene(), 11, floatSettings(4, 49), options);
}

TEST(SweepDivision, HasTheBitsOfOneProcessUnderAHalfBlackSky)
{
  po::BakeSettings settings = floatSettings(8, 49);
  settings.background = po::ImageBackground{ 1, 8, { 1, 1, 1, 0, 0, 0, 0, 0 } };
  po::SweepOptions options;
  options.directions = 64;
  expectSameAsAlone(crowdedScene(), 3, settings, options);
}

TEST(SweepDivision, IsNotTriedWhereTheDistanceIsBounded)
{
  // Each process has only what its particles can meet.
  po::BakeSettings settings = floatSettings(4, 49);
  settings.maximumDistance = 1;
  inParallel(2,
    [&](const po::ProcessGroup& group)
    {
      std::vector<po::Sphere> spheres = mixedScene();
      spheres.resize(group.rank() == 0 ? 20 : 60);
      const po::SphereCloud cloud = cloudOf(spheres);
      const po::BakeScene scene(cloud, {}, group);
      const Estimates found = estimateAll(po::SweepEstimator(), scene, settings);
      const Estimates alone = estimateAll(po::SweepEstimator(), po::BakeScene(cloud), settings);
      EXPECT_EQ(found.values, alone.values);
      EXPECT_EQ(found.shares, alone.shares);
    });
}

/// Whoever is asked to stop leaves; the others learn it at the next exchange.
TEST(SweepDivision, EndsForAllWhenOneIsAborted)
{
  const po::SphereCloud cloud = cloudOf(crowdedScene());
  const po::BakeSettings settings = floatSettings(8, 49);
  for (const bool withLight : { false, true })
  {
    po::BakeSettings lit = settings;
    if (withLight)
    {
      lit.light = po::DistantLight{};
    }
    std::vector<std::string> ends(3);
    inParallel(3,
      [&](const po::ProcessGroup& group)
      {
        std::string& end = ends[static_cast<std::size_t>(group.rank())];
        const bool stops = group.rank() == 1;
        po::Progress progress([&](double) { return !stops; }, std::chrono::milliseconds(0));
        const po::BakeScene scene(cloud, {}, group);
        try
        {
          const po::BakeResult result = po::bakeOcclusion(
            scene, shareOf(group.rank(), 3, 901), lit, po::SweepEstimator(), progress);
          end = result.aborted ? "aborted" : "finished";
          if (result.aborted)
          {
            group.stop(po::WorkState::Aborted);
          }
        }
        catch (const po::WorkStopped& stopped)
        {
          end = stopped.state() == po::WorkState::Aborted ? "told" : "failed";
        }
      });
    EXPECT_EQ(ends, (std::vector<std::string>{ "told", "aborted", "told" }));
  }
}
}
