// SPDX-License-Identifier: BSD-3-Clause
#include "TextureStorageTestSupport.h"

#include "OcclusionTextures.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
using namespace storage_test;

/// Lookups between texel centres are the bilinear ones of the decoded texture.
TEST(PackedTextures, LookUpBetweenTexelsOfTheBasis)
{
  const Stored stored(16, Storage::Compressed, 0.03);
  const OcclusionTextures textures(stored.packed, 16, stored.packedRows.data(), nullptr);
  Random random(8, 0, 0);
  std::vector<float> shown(256);
  for (int i = 0; i < 3000; ++i)
  {
    const std::size_t particle = random.below(600);
    const auto first = static_cast<std::size_t>(stored.packedRows[particle]);
    const Vec3d direction = anyDirection(random);
    stored.packed->decode(first, shown.data());
    const BilinearTexels at = bilinearTexels(16, textureCoordinate(direction));
    float expected = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      expected += at.weight[k] * shown[at.index[k]];
    }
    // Sums are limited to 0 and the maximum after the interpolation, not before.
    const bool limited = *std::min_element(shown.begin(), shown.end()) <= 0 ||
      *std::max_element(shown.begin(), shown.end()) >= static_cast<float>(Maximum);
    EXPECT_NEAR(textures.at(particle, direction.as<float>()), expected, limited ? 0.05 : 2e-5);
  }
}

TEST(PackedTextures, HaveNoSeamAtAnySize)
{
  const Stored stored(16, Storage::VariableSize, 0.02);
  const OcclusionTextures textures(stored.packed, 16, stored.packedRows.data(), nullptr);
  for (std::size_t particle = 0; particle < 600; ++particle)
  {
    for (const float z : { -0.9f, 0.1f, 0.8f })
    {
      EXPECT_NEAR(
        textures.at(particle, { 1, 1e-5f, z }), textures.at(particle, { 1, -1e-5f, z }), 1e-3);
    }
  }
}

TEST(PackedTextures, OnlyWholeTexturesBegin)
{
  PackedFormat format;
  format.resolution = 4;
  format.maximum = 1;
  // A texture of 2 x 2 in two words, then the start of one of 4 x 4, which needs five.
  const std::vector<std::uint8_t> bytes = { 1, 10, 20, 30, 40, 0, 0, 0, 2, 0, 0, 0 };
  const PackedTextures packed(format, bytes.data(), 3);
  EXPECT_EQ(packed.lengthAt(0), 2u);
  EXPECT_EQ(packed.lengthAt(2), 0u);
  EXPECT_EQ(packed.lengthAt(3), 0u);
  const std::vector<std::uint8_t> unknown = { 3, 0, 0, 0, 8, 0, 0, 0 };
  EXPECT_EQ(PackedTextures(format, unknown.data(), 2).lengthAt(0), 0u) << "no such size";
  EXPECT_EQ(PackedTextures(format, unknown.data(), 2).lengthAt(1), 0u) << "no basis";
}

TEST(PackedFormat, WhatCannotBeReadIsRefused)
{
  PackedFormat good;
  good.resolution = 2;
  good.maximum = 1;
  good.basis.resolution = 2;
  good.basis.scale = 1;
  good.basis.numbers.assign(8, 1); // the mean and one component
  good.classBits = { { 8 } };
  EXPECT_NO_THROW(good.check());
  const auto expectRefused = [&](const std::function<void(PackedFormat&)>& spoil)
  {
    PackedFormat bad = good;
    spoil(bad);
    EXPECT_THROW(bad.check(), std::invalid_argument);
  };
  expectRefused([](PackedFormat& f) { f.resolution = 0; });
  expectRefused([](PackedFormat& f) { f.resolution = 4; });
  expectRefused([](PackedFormat& f) { f.maximum = -1; });
  expectRefused([](PackedFormat& f) { f.basis.numbers.pop_back(); });
  expectRefused([](PackedFormat& f) { f.basis.numbers.clear(); });
  expectRefused([](PackedFormat& f) { f.basis.scale = 0; });
  expectRefused([](PackedFormat& f) { f.classBits = { { 9 } }; });
  expectRefused([](PackedFormat& f) { f.classBits = { { 1, 1 } }; });
  expectRefused([](PackedFormat& f) { f.classBits.resize(9); });
  EXPECT_EQ(classBitsOf(textOfClassBits({ { 8, 7 }, {}, { 0 } })),
    (std::vector<std::vector<std::uint8_t>>{ { 8, 7 }, {}, { 0 } }));
  EXPECT_THROW(static_cast<void>(classBitsOf("89")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(classBitsOf("x")), std::invalid_argument);
}
}
