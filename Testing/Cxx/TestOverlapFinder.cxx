// SPDX-License-Identifier: BSD-3-Clause
#include "BrickOrder.h"
#include "OverlapFinder.h"
#include "Random.h"
#include "SphereBoxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
po::Overlaps overlapsOf(const std::vector<po::Sphere>& spheres, unsigned id)
{
  po::Overlaps result;
  po::OverlapFinder(po::SphereSet(spheres)).find(id, result);
  return result;
}

TEST(OverlapFinder, EqualSpheresCutEachOtherAtTheMiddlePlane)
{
  const po::Overlaps overlaps = overlapsOf({ { 0, 0, 0, 1 }, { 1, 0, 0, 1 } }, 0);
  ASSERT_EQ(overlaps.caps.size(), 1u);
  EXPECT_FALSE(overlaps.buried);
  EXPECT_DOUBLE_EQ(overlaps.caps[0].cosine, 0.5); // x = 1/2 on a unit sphere
  EXPECT_DOUBLE_EQ(overlaps.caps[0].axis.x, 1);
}

TEST(OverlapFinder, TouchingDistantAndContainedSpheresCutNothing)
{
  const std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 }, { 2, 0, 0, 1 }, { -3, 0, 0, 1 },
    { 0, 0.25f, 0, 0.5f } };
  const po::Overlaps overlaps = overlapsOf(spheres, 0);
  EXPECT_TRUE(overlaps.caps.empty());
  EXPECT_FALSE(overlaps.buried);
}

TEST(OverlapFinder, ASphereInsideAnotherIsBuried)
{
  EXPECT_TRUE(overlapsOf({ { 0, 0, 0, 0.5f }, { 0.25f, 0, 0, 1 } }, 0).buried);
  EXPECT_TRUE(overlapsOf({ { 0, 0, 0, 0.5f }, { 0, 0, 0, 1 } }, 0).buried);  // concentric
  EXPECT_FALSE(overlapsOf({ { 0, 0, 0, 0.5f }, { 0, 0, 0, 1 } }, 1).buried); // the outer one
}

TEST(OverlapFinder, CoincidentSpheresBuryNothing)
{
  const std::vector<po::Sphere> spheres(5, po::Sphere{ 3, 4, 5, 1 });
  const po::Overlaps overlaps = overlapsOf(spheres, 2);
  EXPECT_FALSE(overlaps.buried);
  EXPECT_TRUE(overlaps.caps.empty());
}

TEST(OverlapFinder, FindsWhatBruteForceFindsForRadiiOfOneToTenThousand)
{
  po::Random random(9, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 600; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(20 * random.uniform()); };
    const double radius = std::pow(10.0, -3 + 4 * random.uniform());
    spheres.push_back({ coordinate(), coordinate(), coordinate(), static_cast<float>(radius) });
  }
  const po::SphereSet set(spheres);
  const po::OverlapFinder finder(set);
  po::Overlaps overlaps;
  std::size_t cuts = 0;
  for (unsigned i = 0; i < spheres.size(); ++i)
  {
    finder.find(i, overlaps);
    std::size_t expectedCaps = 0;
    bool expectedBuried = false;
    for (unsigned j = 0; j < spheres.size(); ++j)
    {
      const double d =
        po::length(spheres[j].center().as<double>() - spheres[i].center().as<double>());
      const double r = spheres[i].radius;
      const double other = spheres[j].radius;
      expectedBuried = expectedBuried || (i != j && d <= other - r);
      expectedCaps += i != j && d < r + other && d > std::abs(r - other) ? 1 : 0;
    }
    EXPECT_EQ(overlaps.caps.size(), expectedCaps) << i;
    EXPECT_EQ(overlaps.buried, expectedBuried) << i;
    cuts += expectedCaps;
  }
  EXPECT_GT(cuts, 1000u); // the scene does test something
}

TEST(OverlapFinder, FindsTheNearestThatComeWithinReach)
{
  po::Random random(21, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 500; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(20 * random.uniform()); };
    const double radius = std::pow(10.0, -2 + 2.5 * random.uniform());
    spheres.push_back({ coordinate(), coordinate(), coordinate(), static_cast<float>(radius) });
  }
  const po::SphereSet set(spheres);
  const po::OverlapFinder finder(set);
  for (unsigned id = 0; id < 50; ++id)
  {
    const float reach = 2 * spheres[id].radius;
    std::vector<po::Neighbour> expected;
    for (unsigned other = 0; other < spheres.size(); ++other)
    {
      const float gap = po::length(spheres[other].center() - spheres[id].center()) -
        spheres[id].radius - spheres[other].radius;
      if (other != id && gap <= reach)
      {
        expected.push_back({ other, gap });
      }
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(finder.hasNear(id, reach), !expected.empty()) << id;
    for (const std::size_t limit : { std::size_t(10), spheres.size() })
    {
      std::vector<po::Neighbour> found;
      finder.findNear(id, reach, limit, found);
      ASSERT_EQ(found.size(), std::min(limit, expected.size())) << id;
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_EQ(found[i].id, expected[i].id) << id;
      }
    }
  }
}

std::vector<po::Sphere> randomSpheres(std::size_t count)
{
  po::Random random(33, 0, 0);
  std::vector<po::Sphere> spheres(count);
  for (po::Sphere& sphere : spheres)
  {
    const auto number = [&](double low, double high)
    { return static_cast<float>(low + (high - low) * random.uniform()); };
    sphere = { number(0, 9), number(0, 9), number(0, 9), number(0.1, 2) };
  }
  return spheres;
}

std::vector<po::Sphere> sortedInSpace(const std::vector<po::Sphere>& spheres)
{
  const po::SphereSet set(spheres);
  std::vector<po::Sphere> sorted;
  for (const unsigned place : po::orderInSpace(set.bricks().front()))
  {
    sorted.push_back(spheres[place]);
  }
  return sorted;
}

/// Each sphere is in one box, and found there where it comes near.
void expectBoxesToTellWhatComesNear(const po::SphereSet& set)
{
  const po::Vec3f point{ 4, 5, 4 };
  const float distance = 2;
  const po::SphereBoxes boxes(set.bricks().front());
  std::vector<int> times(set.size(), 0);
  for (unsigned box = 0; box < boxes.count(); ++box)
  {
    const unsigned near = boxes.near(box, point, distance);
    EXPECT_EQ(near >> boxes.spheresIn(box), 0u);
    for (std::size_t i = 0; i < boxes.spheresIn(box); ++i)
    {
      const po::Sphere& sphere = boxes.sphere(box, i);
      EXPECT_EQ(&sphere, &set.spheres()[boxes.id(box, i)]);
      ++times[boxes.id(box, i)];
      const float gap = po::length(sphere.center() - point) - sphere.radius - distance;
      if (std::abs(gap) > 1e-4f) // rounding may add some that just do not
      {
        EXPECT_EQ((near >> i & 1) != 0, gap < 0) << gap;
      }
    }
  }
  EXPECT_EQ(times, std::vector<int>(set.size(), 1));
}

TEST(SphereBoxes, TellWhatComesNearInAnyOrder)
{
  for (const std::size_t count : { std::size_t(1), po::SphereBoxes::Size, std::size_t(1000) })
  {
    const std::vector<po::Sphere> spheres = randomSpheres(count);
    expectBoxesToTellWhatComesNear(po::SphereSet(spheres));
  }
  const po::SphereSet sorted(sortedInSpace(randomSpheres(1000)));
  EXPECT_TRUE(po::orderInSpace(sorted.bricks().front()).empty());
  expectBoxesToTellWhatComesNear(sorted);
}
}
