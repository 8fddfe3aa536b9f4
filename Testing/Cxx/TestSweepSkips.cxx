// SPDX-License-Identifier: BSD-3-Clause
/// What sweeps leave out, against sweeps along the same directions that do not.

#include "EstimateDifference.h"
#include "Random.h"
#include "SweepEstimator.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace
{
/// Four layers of 60 x 60 spheres at uneven heights.
std::vector<po::Sphere> layers(float spacing, float smallestRadius, float largestRadius)
{
  constexpr int side = 60;
  po::Random random(101, 0, 0);
  const auto between = [&](float low, float high)
  { return low + (high - low) * static_cast<float>(random.uniform()); };
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 4 * side * side; ++i)
  {
    const auto x = static_cast<float>(i % side);
    const auto y = static_cast<float>(i / side % side);
    const auto z = static_cast<float>(i / side / side);
    const float height = spacing * z + between(-0.4f, 0.4f);
    const float radius = between(smallestRadius, largestRadius);
    spheres.push_back({ spacing * x, spacing * y, height, radius });
  }
  return spheres;
}

struct SkipScene
{
  std::string name;
  std::vector<po::Sphere> spheres;
  /// Where a sphere shows between all points that are looked at only, it closes cells but is no
  /// occluder of its own; none of the crowded spheres do.
  std::size_t differing;
};

std::vector<SkipScene> denseScenes()
{
  return { { "crowded", layers(0.6f, 1, 1), 0 },
    { "crowded, unequal radii", layers(0.6f, 0.8f, 1.4f), 0 },
    { "loose", layers(1.3f, 1, 1), 500 } };
}

struct Swept
{
  Estimates estimates;
  po::BakeCounters counters;
};

Swept sweep(const po::BakeScene& scene, const po::SweepSkips& skips)
{
  po::SweepOptions options;
  options.directions = 128;
  options.skips = skips;
  Swept swept;
  swept.estimates =
    estimateAll(po::SweepEstimator(options), scene, floatSettings(4, 49), &swept.counters);
  return swept;
}

std::size_t countDiffering(const std::vector<float>& a, const std::vector<float>& b)
{
  return std::inner_product(
    a.begin(), a.end(), b.begin(), std::size_t(0), std::plus<>(), std::not_equal_to<>());
}

TEST(SweepSkips, ClosedCellsChangeNothing)
{
  for (const SkipScene& dense : denseScenes())
  {
    SCOPED_TRACE(dense.name);
    const po::SphereCloud cloud = cloudOf(dense.spheres);
    const po::BakeScene scene(cloud);
    po::SweepSkips skips;
    skips.neverSeen = false;
    skips.offsetMasks = false;
    const Swept closed = sweep(scene, skips);
    skips.closedCells = false;
    const Swept open = sweep(scene, skips);
    EXPECT_GT(closed.counters.spheresClosed, 0u);
    EXPECT_EQ(open.counters.spheresClosed, 0u);
    ASSERT_EQ(closed.estimates.values.size(), 16 * dense.spheres.size());
    ASSERT_EQ(open.estimates.values.size(), closed.estimates.values.size());
    EXPECT_LE(countDiffering(closed.estimates.values, open.estimates.values), dense.differing);
  }
}
}
