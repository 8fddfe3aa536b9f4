// SPDX-License-Identifier: BSD-3-Clause
/// The parts that a sweep is made of, each by itself.

#include "BackgroundIrradiance.h"
#include "Constants.h"
#include "EstimateDifference.h"
#include "OffsetLookup.h"
#include "Random.h"
#include "RimFinder.h"
#include "Sampling.h"
#include "SweepDirections.h"
#include "TestScenes.h"
#include "TexelCaps.h"
#include "TexelExposure.h"
#include "TexelMap.h"
#include "TexelMask.h"
#include "VisibilityRecords.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory_resource>
#include <set>
#include <thread>

namespace
{
using po::Pi;

/// Axes and their opposites.
std::vector<po::Vec3d> bothWays(const std::vector<po::Vec3d>& axes)
{
  std::vector<po::Vec3d> directions = axes;
  for (const po::Vec3d& axis : axes)
  {
    directions.push_back(-axis);
  }
  return directions;
}

/// The cosine-weighted share of directions in front of a normal, 1/4 if spread evenly.
double cosineShare(const std::vector<po::Vec3d>& directions, po::Vec3d normal)
{
  double sum = 0;
  for (const po::Vec3d& d : directions)
  {
    sum += std::max(0.0, po::dot(d, normal));
  }
  return sum / static_cast<double>(directions.size());
}

TEST(SweepDirections, AreUnitAndServeAllNormalsAlike)
{
  const std::vector<po::Vec3d> axes = po::sweepAxes(500, 3);
  ASSERT_EQ(axes.size(), 500u);
  const std::vector<po::Vec3d> directions = bothWays(axes);
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    EXPECT_NEAR(po::length(directions[i]), 1, 1e-12);
    for (std::size_t j = 0; j < i; ++j)
    {
      nearest = std::min(nearest, po::length(directions[i] - directions[j]));
    }
  }
  // Fibonacci points keep about 3.09 / sqrt(n) apart (Swinbank and Purser 2006).
  EXPECT_GT(nearest, 2.5 / std::sqrt(1000.0));
  // All normals are served alike: with random axes the shares would scatter by 0.0065.
  for (const po::Vec3d& normal : po::sweepAxes(100, 9))
  {
    EXPECT_NEAR(cosineShare(directions, normal), 0.25, 0.001);
  }
  const std::vector<po::Vec3d> others = po::sweepAxes(500, 4);
  EXPECT_GT(po::length(others[0] - axes[0]) + po::length(others[1] - axes[1]), 1e-3);
}

/// The mean square discrepancy over all caps of the sphere, up to a factor (Stolarsky 1973), times
/// N^1.5: about 0.80 for the best sets of N directions, 0.86 to 0.95 for a Fibonacci lattice on a
/// hemisphere with its opposite.
double capDiscrepancy(const std::vector<po::Vec3d>& directions)
{
  double sum = 0;
  for (const po::Vec3d& a : directions)
  {
    for (const po::Vec3d& b : directions)
    {
      sum += po::length(a - b);
    }
  }
  const auto count = static_cast<double>(directions.size());
  return (4.0 / 3 - sum / (count * count)) * std::pow(count, 1.5);
}

TEST(SweepDirections, HaveNearlyTheLeastDiscrepancyOverCaps)
{
  for (const int axes : { 16, 31, 48, 64, 128, 256 })
  {
    EXPECT_LT(capDiscrepancy(bothWays(po::sweepAxes(axes, 5))), 0.83) << axes;
  }
}

TEST(SweepDirections, ThePlaneBasisIsOrthonormal)
{
  for (const po::Vec3d& d : po::sweepAxes(50, 9))
  {
    const po::PlaneBasis basis = po::planeBasis(d);
    EXPECT_NEAR(po::length(basis.x), 1, 1e-12);
    EXPECT_NEAR(po::length(basis.y), 1, 1e-12);
    EXPECT_NEAR(po::dot(basis.x, basis.y), 0, 1e-12);
    EXPECT_NEAR(po::dot(basis.x, d), 0, 1e-12);
    EXPECT_NEAR(po::dot(basis.y, d), 0, 1e-12);
  }
}

TEST(SweepTexels, EveryTexelHasOneSlotAndPointsInsideIt)
{
  for (const int resolution : { 1, 2, 3, 5, 12, 13, 16, 31, 64 })
  {
    const po::SweepTexels texels(resolution);
    EXPECT_GE(texels.resolution(), 12);
    EXPECT_EQ(texels.resolution() % resolution, 0);
    const po::TexelPatterns patterns(texels, 1, 0);
    std::set<std::uint32_t> seen;
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      const std::uint32_t texel = texels.texelOfSlot(slot);
      if (texel == po::SweepTexels::Empty)
      {
        continue;
      }
      EXPECT_TRUE(seen.insert(texel).second);
      for (const std::size_t p : { std::size_t(0), std::size_t(17), po::TexelPatterns::Count - 1 })
      {
        const po::TextureCoordinate at =
          po::textureCoordinate(patterns.normal(p, slot).as<double>());
        const auto side = static_cast<std::uint32_t>(texels.resolution());
        EXPECT_NEAR(at.u * side, texel % side + 0.5, 0.5001);
        EXPECT_NEAR(at.v * side, texel / side + 0.5, 0.5001);
      }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(texels.resolution() * texels.resolution()));
  }
}

TEST(TexelMask, HidesWhatThePlainFormulaHides)
{
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const po::Vec3d direction = po::normalized(po::Vec3d{ 1, 2, 3 });
  const po::FacingTexels facing(texels, patterns, 5, po::planeBasis(direction), direction);
  po::Random random(1, 2, 3);
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto number = [&](double low, double high)
    { return static_cast<float>(low + (high - low) * random.uniform()); };
    // Up to a thousand times as large as the receiver: the rounding grows with the squares.
    const float scale = std::pow(10.0f, static_cast<float>(trial % 4));
    const float square = scale * scale;
    const po::Occluder o{ scale * number(-2, 2), scale * number(-2, 2), scale * number(0, 4),
      square * number(0.01, 4) };
    const float distance = scale * number(0.1, 3);
    std::vector<po::GroupMask> mask = facing.facing;
    std::vector<po::GroupMask> within = facing.facing;
    po::OccluderBatch batch;
    batch.add(o);
    const bool left = po::hideTexels(facing, batch, mask.data());
    po::hideTexelsWithin(facing, batch, distance, within.data());
    bool expectedLeft = false;
    for (std::size_t i = 0; i < facing.u.size(); ++i)
    {
      const double du = facing.u[i] - o.a;
      const double dv = facing.v[i] - o.b;
      const double chord = o.squaredRadius - du * du - dv * dv;
      const double climb = o.height - facing.w[i];
      const bool faces = facing.w[i] > 0;
      const bool open = (mask[i / po::GroupSize] >> (i % po::GroupSize) & 1) != 0;
      const bool openWithin = (within[i / po::GroupSize] >> (i % po::GroupSize) & 1) != 0;
      const double entry = climb - std::sqrt(std::max(chord, 0.0));
      const bool nearEdge = std::abs(chord) < 1e-5 * square || std::abs(climb) < 1e-5 * scale;
      if (!nearEdge)
      {
        EXPECT_EQ(open, faces && !(chord > 0 && climb > 0));
      }
      if (!nearEdge && std::abs(entry - distance) > 1e-3 * scale)
      {
        EXPECT_EQ(openWithin, faces && !(chord > 0 && climb > 0 && entry < distance));
      }
      expectedLeft = expectedLeft || open;
    }
    EXPECT_EQ(left, expectedLeft);
  }
}

TEST(OffsetMasks, LeaveWhatASphereInFrontLeavesUpToTheGrid)
{
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const po::Vec3d direction = po::normalized(po::Vec3d{ 1, -2, 3 });
  const po::FacingTexels facing(texels, patterns, 5, po::planeBasis(direction), direction);
  po::Random random(4, 5, 6);
  const auto number = [&](double low, double high)
  { return static_cast<float>(low + (high - low) * random.uniform()); };
  constexpr double halfCell = 0.5 / static_cast<double>(po::OffsetMasks::CellsPerRadius) + 1e-4;
  for (int trial = 0; trial < 200; ++trial)
  {
    po::OffsetMasks masks;
    masks.build(facing, number(0, 1), number(0, 1), number(0, 1));
    const po::ProjectedSphere receiver{ number(-9, 9), number(-9, 9), number(-9, 9), 1.5f, 0 };
    const float a = number(-2, 2), b = number(-2, 2), height = number(0, 3);
    const float r = receiver.radius;
    po::OccluderChunk chunk{};
    chunk.x.fill(HUGE_VALF);
    chunk.y.fill(HUGE_VALF);
    chunk.x[3] = receiver.x + a * r;
    chunk.y[3] = receiver.y + b * r;
    chunk.z[3] = receiver.z + height * r;
    chunk.next = po::OccluderList::Empty;
    std::vector<po::GroupMask> mask = facing.facing;
    mask.resize(po::OffsetMasks::Groups, 0);
    po::hideBehindEqual(masks, { &chunk, 0 }, receiver, mask.data());
    const bool overlaps = a * a + b * b + height * height < 4;
    for (std::size_t i = 0; i < facing.u.size(); ++i)
    {
      const double across = std::hypot(double(facing.u[i] - a), double(facing.v[i] - b));
      const double climb = double(height - facing.w[i]);
      const bool nearEdge = std::abs(across - 1) < halfCell * std::sqrt(2.0);
      if (facing.w[i] > 0 && !nearEdge && (!overlaps || std::abs(climb) > halfCell))
      {
        const bool open = (mask[i / po::GroupSize] >> (i % po::GroupSize) & 1) != 0;
        EXPECT_EQ(open, across > 1 || (overlaps && climb < 0)) << a << " " << b << " " << height;
      }
    }
  }
}

TEST(TexelMask, HidesByManyWhatEachOfThemHides)
{
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const po::Vec3d direction = po::normalized(po::Vec3d{ -1, 1, 2 });
  const po::FacingTexels facing(texels, patterns, 9, po::planeBasis(direction), direction);
  po::Random random(4, 2, 3);
  std::vector<po::GroupMask> oneByOne = facing.facing;
  std::vector<po::GroupMask> together = facing.facing;
  po::OccluderBatch many;
  for (std::size_t i = 0; i < po::OccluderBatch::Most; ++i)
  {
    const auto number = [&random](double low, double high)
    { return static_cast<float>(low + (high - low) * random.uniform()); };
    const po::Occluder o{ number(-2, 2), number(-2, 2), number(0, 4), number(0.01, 1) };
    po::OccluderBatch one;
    one.add(o);
    many.add(o);
    po::hideTexels(facing, one, oneByOne.data());
  }
  po::hideTexels(facing, many, together.data());
  EXPECT_EQ(together, oneByOne);
  EXPECT_NE(together, facing.facing);
}

TEST(TexelExposure, TellsThePointsOutsideAllCaps)
{
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const std::vector<po::BuriedCap> caps{ { po::normalized(po::Vec3d{ 1, 1, 0 }), 0.3 },
    { { 0, 0, 1 }, 0.9 }, { po::normalized(po::Vec3d{ -1, 0, 1 }), -0.2 } };
  po::RimFinder finder;
  const po::TexelRims rims = finder.find(texels, caps);
  std::pmr::monotonic_buffer_resource memory;
  const po::TexelRims* kept = po::copyTo(memory, rims, texels.groups());
  po::TexelExposure exposure;
  po::exposeTexels(texels, patterns, rims, exposure);
  for (std::size_t p = 0; p < po::TexelPatterns::Count; ++p)
  {
    const po::GroupMask* masks = exposure.ofPattern(p, texels.groups());
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      const po::Vec3d n = patterns.normal(p, slot).as<double>();
      const bool inside = std::any_of(caps.begin(), caps.end(),
        [n](const po::BuriedCap& cap) { return po::dot(n, cap.axis) > cap.cosine; });
      const po::GroupMask mask = masks[slot / po::GroupSize];
      EXPECT_EQ((mask >> (slot % po::GroupSize) & 1) != 0, !inside) << p << " " << slot;
    }
    // One pattern alone, of a copy: the same.
    std::vector<po::GroupMask> mask = texels.allBits();
    EXPECT_TRUE(po::clearInside(patterns, p, *kept, mask.data()));
    EXPECT_TRUE(std::equal(mask.begin(), mask.end(), masks));
  }
  // A cap smaller than the distance to any point takes none.
  po::TexelExposure open;
  po::exposeTexels(texels, patterns, finder.find(texels, { { { 1, 0, 0 }, 1 - 1e-12 } }), open);
  for (std::size_t i = 0; i < open.bits.size(); ++i)
  {
    EXPECT_EQ(open.bits[i], texels.allBits()[i % texels.groups()]);
  }
}

TEST(VisibilityRecords, ThreadsMayMeetASphereAtOnce)
{
  // Threads that see a sphere for the first time find out side by side what overlaps it: each goes
  // on only with a finished answer, and all get the same.
  const po::SphereCloud cloud = cloudOf(syntheticScene(po::SyntheticFamily::Overlap, 4000));
  const po::BakeScene scene(cloud);
  const po::SweepScene order(scene.set());
  const po::SweepTexels texels(16);
  const std::vector<std::uint8_t> listed(order.size(), 1);
  const std::vector<std::uint8_t> alone(order.size(), 0);
  po::VisibilityRecords records(scene, order, texels, 1, listed, alone, {});
  constexpr std::size_t threads = 4;
  std::vector<std::vector<po::GroupMask>> masks(threads);
  std::atomic<unsigned> arrived{ 0 };
  const auto meetAll = [&](std::size_t thread)
  {
    for (unsigned sphere = 0; sphere < order.size(); ++sphere)
    {
      std::vector<po::GroupMask> mask = texels.allBits();
      for (++arrived; arrived < threads * (sphere + 1);)
      {
        std::this_thread::yield(); // all begin together
      }
      records.clearInside(sphere, 7, mask.data());
      masks[thread].insert(masks[thread].end(), mask.begin(), mask.end());
    }
  };
  std::vector<std::thread> running;
  for (std::size_t thread = 0; thread < threads; ++thread)
  {
    running.emplace_back(meetAll, thread);
  }
  std::for_each(running.begin(), running.end(), [](std::thread& thread) { thread.join(); });
  for (std::size_t thread = 1; thread < threads; ++thread)
  {
    EXPECT_EQ(masks[thread], masks[0]);
  }
}

TEST(BackgroundIrradiance, AgreesWithQuadrature)
{
  po::ImageBackground image{ 37, 19, {} };
  po::Random random(5, 0, 0);
  for (int i = 0; i < image.width * image.height; ++i)
  {
    image.luminance.push_back(static_cast<float>(4 * random.uniform() * random.uniform()));
  }
  const po::GradientBackground gradient{ { 1, 2, -1 }, 0.2, 1.4 };
  for (const po::Background& background :
    { po::Background(po::UniformBackground{}), po::Background(gradient), po::Background(image) })
  {
    const po::BackgroundIrradiance irradiance(background);
    const std::vector<po::Vec3d> sky = bothWays(po::sweepAxes(100000, 8));
    for (const po::Vec3d& n : po::sweepAxes(20, 2))
    {
      double sum = 0;
      for (const po::Vec3d& d : sky)
      {
        sum += std::max(0.0, po::dot(n, d)) * po::luminance(background, d);
      }
      EXPECT_NEAR(irradiance(n), 4 * sum / static_cast<double>(sky.size()), 0.003);
    }
  }
}
}
