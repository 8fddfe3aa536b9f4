// SPDX-License-Identifier: BSD-3-Clause
/// The parts that a sweep is made of, each by itself.

#include "BackgroundIrradiance.h"
#include "Constants.h"
#include "Random.h"
#include "Sampling.h"
#include "SweepDirections.h"
#include "TestScenes.h"
#include "TexelExposure.h"
#include "TexelMap.h"
#include "TexelMask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace
{
using po::Pi;

TEST(SweepDirections, AreUnitEvenAndWellSpreadFromTheStart)
{
  const std::vector<po::Vec3d> directions = po::sweepDirections(1000, 3);
  ASSERT_EQ(directions.size(), 1000u);
  po::Vec3d sum;
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    EXPECT_NEAR(po::length(directions[i]), 1, 1e-12);
    sum = sum + directions[i];
    for (std::size_t j = 0; j < i; ++j)
    {
      nearest = std::min(nearest, po::length(directions[i] - directions[j]));
    }
  }
  EXPECT_LT(po::length(sum), 2.0); // 1000 random ones: about 32
  // Fibonacci points keep about 3.09 / sqrt(n) apart (Swinbank and Purser 2006).
  EXPECT_GT(nearest, 2.9 / std::sqrt(1000.0));
  // The first 64 already cover the heights: their sum along any axis is far below sqrt(64/3).
  po::Vec3d start;
  for (std::size_t i = 0; i < 64; ++i)
  {
    start = start + directions[i];
  }
  EXPECT_LT(po::length(start), 14.0); // 4.7 standard deviations even if azimuths were random
  const std::vector<po::Vec3d> others = po::sweepDirections(1000, 4);
  EXPECT_GT(po::length(others[0] - directions[0]) + po::length(others[1] - directions[1]), 1e-3);
}

TEST(SweepDirections, ThePlaneBasisIsOrthonormal)
{
  for (const po::Vec3d& d : po::sweepDirections(50, 9))
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
      for (const std::size_t p : { std::size_t(0), std::size_t(17), std::size_t(63) })
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
  const po::FacingTexels facing(texels, patterns, 5, po::normalized(po::Vec3d{ 1, 2, 3 }), 1);
  po::Random random(1, 2, 3);
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto number = [&](double low, double high)
    { return static_cast<float>(low + (high - low) * random.uniform()); };
    const po::Occluder o{ number(-2, 2), number(-2, 2), number(0, 4), number(0.01, 4) };
    const float distance = number(0.1, 3);
    std::vector<po::GroupMask> mask = facing.facing;
    std::vector<po::GroupMask> within = facing.facing;
    const bool left = po::hideTexels(facing, o, mask.data());
    po::hideTexelsWithin(facing, o, distance, within.data());
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
      const bool nearEdge = std::abs(chord) < 1e-5 || std::abs(climb) < 1e-5;
      if (!nearEdge)
      {
        EXPECT_EQ(open, faces && !(chord > 0 && climb > 0));
      }
      if (!nearEdge && std::abs(entry - distance) > 1e-3)
      {
        EXPECT_EQ(openWithin, faces && !(chord > 0 && climb > 0 && entry < distance));
      }
      expectedLeft = expectedLeft || open;
    }
    EXPECT_EQ(left, expectedLeft);
  }
}

TEST(TexelExposure, TellsThePointsOutsideAllCaps)
{
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const std::vector<po::BuriedCap> caps{ { po::normalized(po::Vec3d{ 1, 1, 0 }), 0.3 },
    { { 0, 0, 1 }, 0.9 }, { po::normalized(po::Vec3d{ -1, 0, 1 }), -0.2 } };
  const po::TexelExposure exposure = po::exposeTexels(texels, patterns, caps);
  for (std::size_t p = 0; p < po::TexelPatterns::Count; ++p)
  {
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      const po::Vec3d n = patterns.normal(p, slot).as<double>();
      const bool inside = std::any_of(caps.begin(), caps.end(),
        [n](const po::BuriedCap& cap) { return po::dot(n, cap.axis) > cap.cosine; });
      const po::GroupMask mask = exposure.ofPattern(p, texels.groups())[slot / po::GroupSize];
      EXPECT_EQ((mask >> (slot % po::GroupSize) & 1) != 0, !inside) << p << " " << slot;
    }
  }
  // A cap smaller than the distance to any point: no bits are kept.
  EXPECT_TRUE(po::exposeTexels(texels, patterns, { { { 1, 0, 0 }, 1 - 1e-12 } }).bits.empty());
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
    for (const po::Vec3d& n : po::sweepDirections(20, 2))
    {
      double sum = 0;
      constexpr int count = 200000;
      for (const po::Vec3d& d : po::sweepDirections(count, 8))
      {
        sum += std::max(0.0, po::dot(n, d)) * po::luminance(background, d) * 4 / count;
      }
      EXPECT_NEAR(irradiance(n), sum, 0.003);
    }
  }
}
}
