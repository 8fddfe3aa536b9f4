// SPDX-License-Identifier: BSD-3-Clause
// The synthetic families keep what their description promises: count, contacts, density, seed.
#include "SyntheticSpheres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace
{
using po::makeSyntheticSpheres;
using po::SyntheticFamily;
using po::SyntheticSpheres;

struct Contacts
{
  std::size_t touching = 0;      // pairs whose gap is within the tolerance of 0
  std::size_t overlapping = 0;   // pairs that are closer
  double deepestOverlap = 0.0;   // largest sum of radii less distance
  std::vector<std::size_t> root; // union-find over touching and overlapping pairs
};

std::size_t rootOf(std::vector<std::size_t>& root, std::size_t i)
{
  while (root[i] != i)
  {
    i = root[i] = root[root[i]];
  }
  return i;
}

/// All pairs that touch or overlap. The families have one radius each, so a grid with cells of the
/// diameter holds both partners of a pair in neighbouring cells.
Contacts findContacts(const SyntheticSpheres& spheres, double tolerance)
{
  const double reach = 2.0 * spheres.radii.front() + tolerance;
  const auto cell = [=](float x) { return static_cast<std::int64_t>(std::floor(x / reach)); };
  std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::vector<std::size_t>> grid;
  Contacts contacts;
  contacts.root.resize(spheres.centers.size());
  std::iota(contacts.root.begin(), contacts.root.end(), std::size_t{ 0 });

  const auto addPair = [&](std::size_t i, std::size_t j)
  {
    const auto& a = spheres.centers[i];
    const auto& b = spheres.centers[j];
    const double distance = std::hypot(
      double{ a[0] } - double{ b[0] }, double{ a[1] } - double{ b[1] }, double{ a[2] } - b[2]);
    const double overlap = 2.0 * spheres.radii.front() - distance;
    if (overlap < -tolerance)
    {
      return;
    }
    ++(overlap > tolerance ? contacts.overlapping : contacts.touching);
    contacts.deepestOverlap = std::max(contacts.deepestOverlap, overlap);
    contacts.root[rootOf(contacts.root, i)] = rootOf(contacts.root, j);
  };
  for (std::size_t i = 0; i < spheres.centers.size(); ++i)
  {
    const auto& c = spheres.centers[i];
    for (int step = 0; step < 27; ++step)
    {
      const auto found = grid.find(
        { cell(c[0]) + step % 3 - 1, cell(c[1]) + step / 3 % 3 - 1, cell(c[2]) + step / 9 - 1 });
      if (found != grid.end())
      {
        std::for_each(
          found->second.begin(), found->second.end(), [&](std::size_t j) { addPair(i, j); });
      }
    }
    grid[{ cell(c[0]), cell(c[1]), cell(c[2]) }].push_back(i);
  }
  return contacts;
}

std::size_t largestCluster(Contacts& contacts)
{
  std::map<std::size_t, std::size_t> sizes;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < contacts.root.size(); ++i)
  {
    largest = std::max(largest, ++sizes[rootOf(contacts.root, i)]);
  }
  return largest;
}

double boundingVolume(const SyntheticSpheres& spheres)
{
  double volume = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(spheres.centers.begin(), spheres.centers.end(),
      [=](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    volume *= (*high)[axis] - (*low)[axis] + 1.0;
  }
  return volume;
}

class EveryFamily : public testing::TestWithParam<std::string>
{
protected:
  SyntheticFamily family = po::syntheticFamilyFromName(GetParam()).value();
};

TEST_P(EveryFamily, GivesExactlyTheCountAndFiniteValues)
{
  for (const std::size_t count : { 0, 1, 2, 3, 10, 1000, 54321 })
  {
    const SyntheticSpheres spheres = makeSyntheticSpheres(family, count, 1);
    ASSERT_EQ(spheres.centers.size(), count);
    ASSERT_EQ(spheres.radii.size(), count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto& c = spheres.centers[i];
      ASSERT_TRUE(std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]))
        << "sphere " << i << " of " << count;
      ASSERT_GT(spheres.radii[i], 0.0F) << "sphere " << i << " of " << count;
    }
  }
}

TEST_P(EveryFamily, DependsOnTheSeedAlone)
{
  const auto first = makeSyntheticSpheres(family, 20000, 7);
  EXPECT_EQ(first.centers, makeSyntheticSpheres(family, 20000, 7).centers);
  if (family != SyntheticFamily::Pack)
  {
    EXPECT_NE(first.centers, makeSyntheticSpheres(family, 20000, 8).centers);
  }
}

TEST_P(EveryFamily, RefusesACountThatIsTooLarge)
{
  EXPECT_THROW(
    (void)makeSyntheticSpheres(family, po::LargestSyntheticCount + 1, 1), std::length_error);
}

INSTANTIATE_TEST_SUITE_P(SyntheticSpheres, EveryFamily,
  testing::Values("pack", "overlap", "gas", "shell", "foam"),
  [](const auto& info) { return info.param; });

TEST(SyntheticSpheres, UnknownNamesAreNoFamily)
{
  EXPECT_FALSE(po::syntheticFamilyFromName("Foam"));
  EXPECT_FALSE(po::syntheticFamilyFromName(""));
}

TEST(SyntheticSpheres, PackTouchesAndNeverOverlaps)
{
  const auto spheres = makeSyntheticSpheres(SyntheticFamily::Pack, 20000, 1);
  Contacts contacts = findContacts(spheres, 1e-6);
  EXPECT_EQ(contacts.overlapping, 0U);
  EXPECT_EQ(contacts.deepestOverlap, 0.0);
  EXPECT_EQ(largestCluster(contacts), 20000U);
  // 6 contacts a sphere inside the ball; its surface takes a few percent of them.
  EXPECT_GT(contacts.touching, 5.4 * 20000);
  EXPECT_LT(contacts.touching, 6.0 * 20000);
}

TEST(SyntheticSpheres, OverlapIsWithinTheJitter)
{
  const auto spheres = makeSyntheticSpheres(SyntheticFamily::Overlap, 20000, 1);
  const Contacts contacts = findContacts(spheres, 1e-6);
  const double mean = 2.0 * po::OverlapRadius - 1.0;
  EXPECT_GT(contacts.deepestOverlap, mean);
  EXPECT_LT(contacts.deepestOverlap, mean + 2.0 * po::OverlapJitter);
  // 3 neighbours at distance 1 a sphere, less those of the tube's surfaces.
  EXPECT_GT(contacts.overlapping, 2.6 * 20000);
}

TEST(SyntheticSpheres, GasHasItsDensityAndIdealGasContacts)
{
  constexpr std::size_t count = 100000;
  const auto spheres = makeSyntheticSpheres(SyntheticFamily::Gas, count, 1);
  const double sphereVolume = std::acos(-1.0) / 6.0;
  EXPECT_NEAR(count * sphereVolume / boundingVolume(spheres), po::GasVolumeFraction, 0.0003);
  // Pairs: Poisson with mean N/2 * 8 * fraction (a little less at the walls); 5 standard
  // deviations.
  const double pairs = 4.0 * po::GasVolumeFraction * count;
  EXPECT_NEAR(static_cast<double>(findContacts(spheres, 0.0).overlapping), pairs,
    5.0 * std::sqrt(pairs) + 0.05 * pairs);
}

TEST(SyntheticSpheres, ShellIsHollowAndInPieces)
{
  constexpr std::size_t count = 50000;
  const auto spheres = makeSyntheticSpheres(SyntheticFamily::Shell, count, 1);
  const double radius = std::cbrt(count / (4.0 * std::acos(-1.0) * po::ShellThickness));
  std::size_t inside = 0;
  for (const auto& c : spheres.centers)
  {
    inside += std::hypot(c[0], c[1], c[2]) < radius ? 1 : 0;
  }
  EXPECT_LT(inside, count / 100);

  Contacts contacts = findContacts(spheres, 1e-4);
  EXPECT_LT(largestCluster(contacts), count / 4);     // many pieces ...
  EXPECT_GT(contacts.touching, std::size_t{ count }); // ... that are whole
}

TEST(SyntheticSpheres, FoamIsPorousAndHangsTogether)
{
  constexpr std::size_t count = 100000;
  const auto spheres = makeSyntheticSpheres(SyntheticFamily::Foam, count, 1);
  EXPECT_NEAR(count / boundingVolume(spheres), po::FoamRelativeDensity, 0.01);
  Contacts contacts = findContacts(spheres, 0.0);
  EXPECT_EQ(contacts.overlapping, 0U);
  EXPECT_GT(largestCluster(contacts), count * 98 / 100); // the rest: struts that the cube cuts off
}
}
