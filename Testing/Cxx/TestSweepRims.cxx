// SPDX-License-Identifier: BSD-3-Clause
/// What caps cover of the texels of a sweep, and textures of what is left.

#include "Constants.h"
#include "FineTextures.h"
#include "Random.h"
#include "RimFinder.h"
#include "TexelCaps.h"
#include "TexelExposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
po::Vec3d randomDirection(po::Random& random)
{
  const double height = 2 * random.uniform() - 1;
  const double angle = 2 * po::Pi * random.uniform();
  const double across = std::sqrt(1 - height * height);
  return { across * std::cos(angle), across * std::sin(angle), height };
}

/// Of all sizes, up to nearly the whole sphere.
std::vector<po::BuriedCap> randomCaps(std::size_t count, po::Random& random)
{
  std::vector<po::BuriedCap> caps(count);
  for (po::BuriedCap& cap : caps)
  {
    cap = { randomDirection(random), 0.999 - 1.2 * random.uniform() };
  }
  return caps;
}

/// How far the point of a texel lies outside all caps; negative inside.
double gapTo(const std::vector<po::BuriedCap>& caps, po::Vec3d normal)
{
  double gap = HUGE_VAL;
  for (const po::BuriedCap& cap : caps)
  {
    gap = std::min(gap, cap.cosine - po::dot(normal, cap.axis));
  }
  return gap;
}

TEST(SweepTexels, GroupDiscsHoldThePointsOfTheirTexels)
{
  for (const int resolution : { 1, 12, 13, 16, 64 })
  {
    const po::SweepTexels texels(resolution);
    const po::TexelPatterns patterns(texels, 3, 0);
    const po::TexelDiscs& discs = texels.groupDiscs();
    ASSERT_GE(discs.x.size(), texels.groups());
    EXPECT_EQ(discs.x.size() % po::GroupSize, 0u);
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      const std::size_t g = slot / po::GroupSize;
      const po::Vec3f center{ discs.x[g], discs.y[g], discs.z[g] };
      for (std::size_t p = 0; p < po::TexelPatterns::Count; ++p)
      {
        if (texels.texelOfSlot(slot) != po::SweepTexels::Empty)
        {
          EXPECT_GE(po::dot(center, patterns.normal(p, slot)), discs.cosRadius[g] - 1e-6f);
        }
      }
    }
  }
}

TEST(RimFinder, TellsThePointsOutsideCapsOfAllSizes)
{
  po::Random random(11, 0, 0);
  po::RimFinder finder;
  po::TexelExposure exposure;
  std::size_t covered = 0;
  for (const int resolution : { 12, 13, 16, 33 })
  {
    const po::SweepTexels texels(resolution);
    const po::TexelPatterns patterns(texels, 1, 0);
    for (const std::size_t count : { 1, 3, 10, 30 })
    {
      const std::vector<po::BuriedCap> caps = randomCaps(count, random);
      const po::TexelRims rims = finder.find(texels, caps);
      covered += static_cast<std::size_t>(
        std::count(rims.outside, rims.outside + texels.groups(), po::GroupMask(0)));
      po::exposeTexels(texels, patterns, rims, exposure);
      for (std::size_t p = 0; p < po::TexelPatterns::Count; ++p)
      {
        const po::GroupMask* masks = exposure.ofPattern(p, texels.groups());
        for (std::size_t slot = 0; slot < texels.slots(); ++slot)
        {
          const bool exists = texels.texelOfSlot(slot) != po::SweepTexels::Empty;
          const double gap = gapTo(caps, patterns.normal(p, slot).as<double>());
          const bool isOutside = (masks[slot / po::GroupSize] >> (slot % po::GroupSize) & 1) != 0;
          if (std::abs(gap) > 1e-6)
          {
            EXPECT_EQ(isOutside, exists && gap > 0) << resolution << " " << p << " " << slot;
          }
        }
      }
    }
  }
  EXPECT_GT(covered, 100u); // groups as a whole
}

TEST(TexelCaps, SumsAreThoseOfThePatternsOneByOne)
{
  po::Random random(12, 0, 0);
  const po::SweepTexels texels(16);
  const po::TexelPatterns patterns(texels, 1, 0);
  const po::TexelPoints points(patterns);
  std::vector<float> weights(po::TexelPatterns::Count * po::GroupSize);
  std::vector<float> irradiance(weights.size());
  std::generate(weights.begin(), weights.end(), [&] { return float(random.uniform()); });
  std::generate(irradiance.begin(), irradiance.end(), [&] { return float(random.uniform()); });
  po::RimFinder finder;
  const po::TexelRims rims = finder.find(texels, randomCaps(6, random));
  ASSERT_GT(rims.count, 3u);
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    const std::size_t group = rims.rims[rim].group;
    po::OutsideSums sums;
    po::sumOutside(points, group, rims.capsOf(rim), rims.outside[group], rims.rims[rim].crossed,
      weights.data(), irradiance.data(), sums);
    po::OutsideSums expected{};
    for (std::size_t p = 0; p < po::TexelPatterns::Count; ++p)
    {
      std::vector<po::GroupMask> mask = texels.allBits();
      po::clearInside(patterns, p, rims, mask.data());
      for (std::size_t i = 0; i < po::GroupSize; ++i)
      {
        const bool isOutside = (mask[group] >> i & 1) != 0;
        expected.points[i] += isOutside ? 1.0f : 0.0f;
        expected.weights[i] += isOutside ? weights[p * po::GroupSize + i] : 0.0f;
        expected.irradiance[i] += isOutside ? irradiance[p * po::GroupSize + i] : 0.0f;
      }
    }
    EXPECT_EQ(sums.points, expected.points);
    EXPECT_EQ(sums.weights, expected.weights);
    EXPECT_EQ(sums.irradiance, expected.irradiance);
  }
}

TEST(FineTextures, ValuesAreSharesOfTheOpenSumsTimesIrradiance)
{
  po::Random random(13, 0, 0);
  for (const int resolution : { 12, 13, 14, 15, 16, 64 })
  {
    const po::SweepTexels texels(resolution);
    const auto numbers = [&](double ofZero)
    {
      std::vector<float> result(texels.slots());
      std::generate(result.begin(), result.end(),
        [&]
        { return std::max(0.0f, static_cast<float>((1 + ofZero) * random.uniform() - ofZero)); });
      return result;
    };
    const std::vector<float> outside = numbers(0.5), irradiance = numbers(0), sums = numbers(0.5),
                             weights = numbers(0.5);
    const auto side = static_cast<std::size_t>(resolution);
    std::vector<float> values(side * side, -1.0f);
    std::vector<float> shares(values);
    po::FineTextures(texels).fill(
      { outside.data(), irradiance.data(), sums.data(), weights.data() }, values.data(),
      shares.data());
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      const std::uint32_t texel = texels.texelOfSlot(slot);
      if (texel != po::SweepTexels::Empty)
      {
        const float share = weights[slot] > 0 ? outside[slot] : 0.0f;
        const float value =
          share > 0 ? std::min(sums[slot] / weights[slot], 1.0f) * irradiance[slot] : 0.0f;
        EXPECT_EQ(shares[texel], share) << resolution << " " << slot;
        EXPECT_EQ(values[texel], value) << resolution << " " << slot;
      }
    }
    EXPECT_EQ(std::count(shares.begin(), shares.end(), -1.0f), 0);
  }
}
}
