// SPDX-License-Identifier: BSD-3-Clause
#include "SphereCloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Particle
{
  po::Vec3d position;
  double radius;
};

po::SphereCloud cloudOf(const std::vector<Particle>& particles)
{
  return po::makeSphereCloud(
    particles.size(), [&](std::size_t i) { return particles[i].position; },
    [&](std::size_t i) { return particles[i].radius; });
}

TEST(SphereCloud, RecentresInDoubleAndScalesByTheMeanRadius)
{
  // Atoms in metres, a kilometre from the origin: floats of the raw data would be worthless.
  const double r = 1e-10;
  const po::SphereCloud cloud =
    cloudOf({ { { 0.001, 0, 0 }, r }, { { 0.001 + 4 * r, 0, 0 }, 3 * r } });
  ASSERT_EQ(cloud.spheres.size(), 2u);
  EXPECT_DOUBLE_EQ(cloud.scale, 2 * r);
  EXPECT_NEAR(cloud.spheres[1].x - cloud.spheres[0].x, 2, 1e-5);
  EXPECT_FLOAT_EQ(cloud.spheres[0].radius, 0.5f);
  const po::Vec3d back = cloud.toWorld(cloud.toLocal({ 1, 2, 3 }));
  EXPECT_NEAR(back.y, 2, 1e-12);
}

TEST(SphereCloud, ASteadyFrameStaysWhenParticlesMove)
{
  const auto steady = [](double far, double radius)
  {
    const std::vector<Particle> particles = { { { 1003, 7, 0 }, radius },
      { { 1003 + far, 7, 0 }, radius }, { { 1050, 7, 1 }, radius } };
    return po::makeSphereCloud(
      { particles.size(), [&](std::size_t i) { return particles[i].position; },
        [&](std::size_t i) { return particles[i].radius; } },
      po::ProcessGroup::alone(), po::FrameFit::Steady);
  };
  const po::SphereCloud cloud = steady(80, 0.3);
  EXPECT_EQ(cloud.scale, 0.25);
  EXPECT_EQ(cloud.origin.x, 1024); // 1043 in steps of 64
  EXPECT_EQ(cloud.origin.y, 0);
  for (const double far : { 65.0, 81.3, 100.0 })
  {
    const po::SphereCloud other = steady(far, 0.3);
    EXPECT_EQ(other.scale, cloud.scale);
    EXPECT_EQ(other.origin, cloud.origin);
    EXPECT_EQ(other.spheres[0].x, cloud.spheres[0].x);
  }
  EXPECT_EQ(steady(80, 0.5).scale, 0.5);
  const po::SphereCloud below =
    po::makeSphereCloud({ 2,
                          [](std::size_t i) {
                            return po::Vec3d{ i == 0 ? -5.0 : 4.0, 0, 0 };
                          },
                          [](std::size_t) { return 1.0; } },
      po::ProcessGroup::alone(), po::FrameFit::Steady);
  EXPECT_FALSE(std::signbit(below.origin.x)); // zero has the same bits from both sides
}

TEST(SphereCloud, LeavesOutAndCountsWhatIsNoSphere)
{
  const po::SphereCloud cloud = cloudOf(
    { { { 0, 0, 0 }, 1 }, { { NaN, 0, 0 }, 1 }, { { 0, Infinity, 0 }, 1 }, { { 1, 0, 0 }, NaN },
      { { 1, 0, 0 }, Infinity }, { { 1, 0, 0 }, 0 }, { { 1, 0, 0 }, -2 }, { { 5, 0, 0 }, 1 } });
  EXPECT_EQ(cloud.sourceIds, (std::vector<std::int64_t>{ 0, 7 }));
  EXPECT_EQ(cloud.rejected.nonFinitePosition, 2u);
  EXPECT_EQ(cloud.rejected.nonFiniteRadius, 2u);
  EXPECT_EQ(cloud.rejected.nonPositiveRadius, 2u);
  EXPECT_EQ(cloud.rejected.total(), 6u);
}

TEST(SphereCloud, HugeAndTinyUnitsAreTheSameScene)
{
  for (const double unit : { 1e-300, 1e-30, 1.0, 1e30, 1e300 })
  {
    const po::SphereCloud cloud =
      cloudOf({ { { -3 * unit, 0, 0 }, unit }, { { 5 * unit, 0, 0 }, unit } });
    ASSERT_EQ(cloud.spheres.size(), 2u) << unit;
    EXPECT_NEAR(cloud.spheres[1].x, 4, 1e-6) << unit;
    EXPECT_NEAR(cloud.spheres[1].radius, 1, 1e-6) << unit;
  }
}

TEST(SphereCloud, SpheresBeyondSinglePrecisionAreCounted)
{
  const po::SphereCloud cloud = cloudOf({ { { 0, 0, 0 }, 1 }, { { 1, 0, 0 }, 1e-40 } });
  EXPECT_EQ(cloud.spheres.size(), 1u);
  EXPECT_EQ(cloud.rejected.outOfRange, 1u);
}

TEST(SphereCloud, NothingUsableGivesAnEmptyCloud)
{
  EXPECT_TRUE(cloudOf({}).spheres.empty());
  EXPECT_TRUE(cloudOf({ { { NaN, NaN, NaN }, 1 } }).spheres.empty());
}
}
