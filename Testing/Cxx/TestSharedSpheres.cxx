// SPDX-License-Identifier: BSD-3-Clause
// Processes that share spheres, played by threads.
#include "SharedSpheres.h"
#include "SphereCloud.h"
#include "TestScenes.h"
#include "ThreadGroup.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

namespace
{
constexpr float Unbounded = std::numeric_limits<float>::infinity();

std::vector<po::Sphere> every(const std::vector<po::Sphere>& spheres, int size, int rank)
{
  std::vector<po::Sphere> own;
  for (std::size_t i = static_cast<std::size_t>(rank); i < spheres.size();
       i += static_cast<std::size_t>(size))
  {
    own.push_back(spheres[i]);
  }
  return own;
}

bool same(const po::Sphere& a, const po::Sphere& b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius;
}

bool same(const std::vector<po::Sphere>& a, const std::vector<po::Sphere>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const po::Sphere& p, const po::Sphere& q) { return same(p, q); });
}

po::SharedSpheres share(const std::vector<po::Sphere>& own, const std::vector<std::uint8_t>& ghosts,
  float reach, const po::ProcessGroup& group)
{
  return po::shareSpheres(own, ghosts, po::Neighbourhood(own, reach, group), group);
}

TEST(SharedSpheres, HaveOneOrderWhoeverHasThem)
{
  const std::vector<po::Sphere> all = mixedScene();
  const po::SharedSpheres alone = share(all, {}, Unbounded, po::ProcessGroup::alone());
  ASSERT_EQ(alone.spheres.size(), all.size());
  for (const int size : { 2, 3, 7 })
  {
    inParallel(size,
      [&](const po::ProcessGroup& group)
      {
        const std::vector<po::Sphere> own = every(all, size, group.rank());
        const po::SharedSpheres shared = share(own, {}, Unbounded, group);
        EXPECT_TRUE(same(shared.spheres, alone.spheres));
        for (std::size_t i = 0; i < own.size(); ++i)
        {
          EXPECT_TRUE(same(shared.spheres[shared.places[i]], own[i]));
        }
      });
  }
}

TEST(SharedSpheres, AHaloHasWhatIsNearAndLittleElse)
{
  std::vector<po::Sphere> row;
  for (int i = 0; i < 100; ++i)
  {
    row.push_back({ static_cast<float>(3 * i), 0, 0, 1 });
  }
  inParallel(2,
    [&](const po::ProcessGroup& group)
    {
      const auto middle = row.begin() + 50;
      const std::vector<po::Sphere> own = group.rank() == 0
        ? std::vector<po::Sphere>(row.begin(), middle)
        : std::vector<po::Sphere>(middle, row.end());
      // Surfaces of neighbours are 1 apart, of the next but one 4.
      EXPECT_EQ(share(own, {}, 1.5f, group).spheres.size(), 51u);
      EXPECT_EQ(share(own, {}, 4.5f, group).spheres.size(), 52u);
      EXPECT_EQ(share(own, {}, Unbounded, group).spheres.size(), 100u);
    });
}

TEST(SharedSpheres, GhostsCountOnceAndAreKeptWhereTheirOriginalIsMissing)
{
  const po::Sphere a{ 0, 0, 0, 1 }, b{ 5, 0, 0, 1 }, c{ 9, 0, 0, 1 };
  inParallel(2,
    [&](const po::ProcessGroup& group)
    {
      const bool first = group.rank() == 0;
      const po::SharedSpheres shared =
        share(first ? std::vector<po::Sphere>{ a, b, c } : std::vector<po::Sphere>{ b, a, c },
          { 0, 1, 1 }, Unbounded, group);
      EXPECT_EQ(shared.spheres.size(), 3u); // c is a ghost of nobody
      EXPECT_TRUE(same(shared.spheres[shared.places[1]], first ? b : a));
      EXPECT_EQ(shared.spheres[shared.places[2]].radius, 1);
    });
}

TEST(SharedSpheres, OneFrameToTheLastBit)
{
  const std::vector<po::Sphere> all = mixedScene();
  const po::SphereCloud whole = cloudOf(all);
  inParallel(3,
    [&](const po::ProcessGroup& group)
    {
      const std::vector<po::Sphere> own = every(all, 3, group.rank());
      const po::SphereCloud cloud = po::makeSphereCloud(
        { own.size(), [&](std::size_t i) { return own[i].center().as<double>(); },
          [&](std::size_t i) { return double(own[i].radius); } },
        group);
      EXPECT_EQ(cloud.scale, whole.scale);
      EXPECT_EQ(cloud.origin.x, whole.origin.x);
      EXPECT_EQ(cloud.origin.z, whole.origin.z);
    });
}

TEST(ProcessGroup, WhoCannotGoOnKeepsNobodyWaiting)
{
  std::atomic<int> told{ 0 };
  inParallel(3,
    [&](const po::ProcessGroup& group)
    {
      if (group.rank() == 1)
      {
        group.stop(po::WorkState::Failed);
        return;
      }
      try
      {
        (void)group.sum(1.0);
      }
      catch (const po::WorkStopped& stopped)
      {
        told += stopped.state() == po::WorkState::Failed;
      }
    });
  EXPECT_EQ(told, 2);
}

TEST(ProcessGroup, SumsAndLargestAreThoseOfAll)
{
  inParallel(4,
    [](const po::ProcessGroup& group)
    {
      const double number = group.rank() + 0.5;
      EXPECT_EQ(group.sum(number), 8);
      EXPECT_EQ(group.largest(-number), -0.5);
      EXPECT_TRUE(group.any(group.rank() == 2));
      EXPECT_FALSE(group.any(false));
      EXPECT_EQ(group.gatherAt(2, { 7 }).size(), group.rank() == 2 ? 4u : 0u);
    });
}
}
