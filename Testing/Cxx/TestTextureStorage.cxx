// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentPacker.h"
#include "OcclusionTextures.h"
#include "TexelMap.h"
#include "TextureIntake.h"
#include "TextureSample.h"
#include "TextureStore.h"

#include "Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

namespace
{
using namespace po;

constexpr double Maximum = 1.2;

/// What a point of the sphere shows.
using Shape = std::function<double(Vec3d)>;

std::vector<float> textureOf(int resolution, const Shape& shape)
{
  std::vector<float> texture;
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = 0; column < resolution; ++column)
    {
      const Vec3d point =
        textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
      texture.push_back(static_cast<float>(std::clamp(shape(point), 0.0, Maximum)));
    }
  }
  return texture;
}

Vec3d anyDirection(Random& random)
{
  const double z = 2 * random.uniform() - 1;
  return textureDirection({ random.uniform(), std::acos(z) / M_PI });
}

/// Some hundred textures: dark, open, of one value, smooth, and with spots of any sharpness.
TextureTable someTextures(int resolution, std::vector<std::int32_t>& rowOf, int count = 600)
{
  TextureTable table(resolution, static_cast<std::size_t>(count));
  Random random(3, 0, 0);
  rowOf.clear();
  for (int i = 0; i < count; ++i)
  {
    const Vec3d up = anyDirection(random), spot = anyDirection(random);
    const double base = random.uniform(), slope = 0.5 * random.uniform();
    const double width = 0.02 + random.uniform(), noise = i % 5 == 0 ? 0.2 : 0.0;
    const auto shape = [&](Vec3d p)
    {
      const double far = std::acos(std::clamp(dot(p, spot), -1.0, 1.0));
      return base + slope * dot(p, up) - 0.5 * std::exp(-far * far / width) +
        noise * (random.uniform() - 0.5);
    };
    const bool flat = i % 10 < 2;
    rowOf.push_back(table.insert(
      textureOf(resolution, flat ? Shape([&](Vec3d) { return i % 10 * 1.0; }) : Shape(shape))
        .data()));
  }
  rowOf.push_back(-1); // a particle without a texture
  return table;
}

TextureTable copyOf(const TextureTable& table)
{
  TextureTable copy(table.resolution(), 0);
  for (std::int32_t row = 0; row < table.rows(); ++row)
  {
    copy.insert(table.values().data() + static_cast<std::size_t>(row) * table.texelsPerRow());
  }
  return copy;
}

/// RMS difference over the sphere.
double difference(int resolution, const float* a, const float* b)
{
  const std::vector<float> shares = texelShares(resolution);
  double sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    sum += static_cast<double>(shares[i] * (a[i] - b[i]) * (a[i] - b[i]));
  }
  return std::sqrt(sum);
}

/// A table in both forms.
struct Stored
{
  Stored(int resolution, Storage storage, double error, double noise = 0)
    : full(someTextures(resolution, rowOf))
  {
    BakeSettings settings;
    settings.textureResolution = resolution;
    settings.storage = storage;
    settings.storageError = error;
    packedRows = rowOf;
    table =
      storeTextures(copyOf(full), settings, Maximum, noise, ProcessGroup::alone(), packedRows);
    packed = std::make_shared<PackedTextures>(
      table.packed, table.bytes.data(), static_cast<std::size_t>(table.rows));
  }

  /// Of each particle with a texture, by reading the packed one.
  [[nodiscard]] std::vector<double> differences() const
  {
    std::vector<double> all;
    std::vector<float> shown(full.texelsPerRow());
    for (std::size_t i = 0; i < rowOf.size(); ++i)
    {
      if (rowOf[i] >= 0)
      {
        packed->decode(static_cast<std::size_t>(packedRows[i]), shown.data());
        all.push_back(difference(full.resolution(), textureAt(i), shown.data()));
      }
    }
    return all;
  }

  [[nodiscard]] const float* textureAt(std::size_t particle) const
  {
    return full.values().data() + static_cast<std::size_t>(rowOf[particle]) * full.texelsPerRow();
  }

  std::vector<std::int32_t> rowOf, packedRows;
  TextureTable full;
  EncodedTable table;
  std::shared_ptr<const PackedTextures> packed;
};

double rmsOf(const std::vector<double>& differences)
{
  double sum = 0;
  for (const double d : differences)
  {
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(differences.size()));
}

TEST(TextureIntake, ParticlesThatNoLightReachesShareOneRow)
{
  // Before and after the first open texel, from which on textures are made bytes at once.
  for (const Storage storage : { Storage::Full, Storage::VariableSize, Storage::OneValue })
  {
    BakeSettings settings;
    settings.textureResolution = 4;
    settings.storage = storage;
    TextureIntake intake(settings, 6);
    const std::vector<float> gray(16, 0.25f), open(16, 1.0f), dark(16, 0.0f);
    intake.add(gray.data());
    intake.addDark();
    intake.add(open.data());
    intake.addDark();
    intake.add(dark.data());
    intake.addDark();
    std::vector<std::int32_t> rowOf;
    const EncodedTable table = intake.finish(0, ProcessGroup::alone(), rowOf);
    ASSERT_EQ(rowOf.size(), 6u);
    EXPECT_EQ(table.textures, 3u);
    EXPECT_NE(rowOf[0], rowOf[1]);
    EXPECT_NE(rowOf[1], rowOf[2]);
    for (const std::size_t place : { 3u, 4u, 5u })
    {
      EXPECT_EQ(rowOf[place], rowOf[1]) << place;
    }
  }
}

TEST(TextureSizes, ArePowersOfTwoUpToTheResolution)
{
  EXPECT_EQ(textureSizes(1), std::vector<int>{ 1 });
  EXPECT_EQ(textureSizes(16), (std::vector<int>{ 1, 2, 4, 8, 16 }));
  EXPECT_EQ(textureSizes(12), (std::vector<int>{ 1, 2, 4, 8, 12 }));
}

TEST(TextureResampler, KeepsWhatASizeCanShow)
{
  for (const int size : { 1, 2, 4, 8, 16 })
  {
    const TextureResampler resampler(16, size);
    std::vector<float> small(static_cast<std::size_t>(size * size)), again(small.size());
    Random random(1, static_cast<std::uint64_t>(size), 0);
    std::generate(small.begin(), small.end(), [&] { return static_cast<float>(random.uniform()); });
    std::vector<float> large(256);
    resampler.enlarge(small.data(), large.data());
    resampler.reduce(large.data(), again.data());
    std::vector<float> shown(256);
    resampler.enlarge(again.data(), shown.data());
    // Random texels are the hardest; two corrections leave a part of them.
    EXPECT_LT(difference(16, large.data(), shown.data()), size == 16 ? 1e-6 : 0.06) << size;
  }
}

TEST(TextureResampler, OneTexelIsTheMeanOverTheSphere)
{
  const auto texture = textureOf(16, [](Vec3d p) { return 0.5 + 0.3 * p.z + 0.1 * p.z * p.z; });
  float mean = 0;
  TextureResampler(16, 1).reduce(texture.data(), &mean);
  EXPECT_NEAR(mean, 0.5 + 0.1 / 3, 2e-3);
}

TEST(Quantizer, HasTheErrorsOfMaxsTable)
{
  // 100,000 normal variables (Box & Muller 1958) tell the errors to 1 or 2 %.
  Random random(5, 0, 0);
  std::array<double, Quantizer::MaximumBits + 1> squares{};
  constexpr int Count = 100000;
  for (int i = 0; i < Count; ++i)
  {
    const double length = std::sqrt(-2 * std::log(1 - random.uniform()));
    const double x = length * std::cos(2 * M_PI * random.uniform());
    for (int bits = 0; bits <= Quantizer::MaximumBits; ++bits)
    {
      const double rest =
        x - Quantizer::decode(Quantizer::encode(static_cast<float>(x), bits), bits);
      squares[static_cast<std::size_t>(bits)] += rest * rest / Count;
    }
  }
  for (std::size_t bits = 0; bits <= 6; ++bits) // of more, single values in the tails decide
  {
    EXPECT_NEAR(squares[bits] / Quantizer::Errors[bits], 1, 0.05) << bits;
  }
}

TEST(Quantizer, BitsGoWhereTheVarianceIs)
{
  EXPECT_EQ(shareBits({ 1, 1 }, 4), (std::vector<std::uint8_t>{ 2, 2 }));
  EXPECT_EQ(shareBits({ 1, 1e-6 }, 4), (std::vector<std::uint8_t>{ 4 }));
  EXPECT_TRUE(shareBits({ 0, 0 }, 4).empty());
}

TEST(TextureBasis, SpansTexturesThatAreSums)
{
  Random random(7, 0, 0);
  std::vector<float> sample;
  for (int i = 0; i < 100; ++i)
  {
    const double a = random.uniform(), b = random.uniform();
    const auto texture = textureOf(8, [&](Vec3d p) { return 0.5 + 0.2 * a * p.x + 0.1 * b * p.z; });
    sample.insert(sample.end(), texture.begin(), texture.end());
  }
  const TextureBasis basis = principalComponents(8, sample, 5);
  const TextureProjection projection(basis);
  ASSERT_GE(basis.components(), 2u);
  std::vector<float> coefficients(basis.components());
  double square = projection.project(sample.data(), coefficients.data());
  for (std::size_t k = 0; k < 2; ++k)
  {
    square -= projection.variances()[k] * coefficients[k] * coefficients[k];
  }
  EXPECT_LT(std::sqrt(std::abs(square)), 1e-3);
}

TEST(TextureBasis, FewSamplesGiveTheComponentsOfMany)
{
  // Fewer samples than texels take another way to the same result.
  std::vector<std::int32_t> rowOf;
  const TextureTable table = someTextures(16, rowOf, 200);
  const std::vector<float> all(table.values().begin(), table.values().begin() + 100 * 256);
  std::vector<float> thrice = all;
  thrice.insert(thrice.end(), all.begin(), all.end());
  thrice.insert(thrice.end(), all.begin(), all.end()); // 300 samples: the same covariance
  const TextureProjection few(principalComponents(16, all, 20)),
    many(principalComponents(16, thrice, 20));
  for (std::size_t k = 0; k < 10; ++k)
  {
    EXPECT_NEAR(few.variances()[k] / many.variances()[k], 1, 0.01) << k;
  }
}

TEST(VariableSize, NoTextureIsOffByMoreThanIsAllowed)
{
  for (const int resolution : { 1, 2, 12, 16, 64 })
  {
    for (const double error : { 0.01, 0.03 })
    {
      const Stored stored(resolution, Storage::VariableSize, error);
      for (const double d : stored.differences())
      {
        // At full size bytes round by up to half a step, which is below these errors.
        ASSERT_LE(d, error + 1e-6) << resolution;
      }
    }
  }
}

TEST(VariableSize, TakesLessThanFullTexturesAndFlatOnesOnce)
{
  const Stored stored(16, Storage::VariableSize, 0.03);
  EXPECT_LT(stored.table.bytes.size(), 0.7 * 256 * static_cast<double>(stored.full.rows()));
  EXPECT_EQ(stored.packedRows[0], stored.packedRows[10]);
  EXPECT_EQ(stored.packedRows.back(), -1);
}

TEST(Compressed, KeepsToTheErrorOverAllAndThriceForEach)
{
  for (const int resolution : { 4, 16, 32 })
  {
    for (const double error : { 0.01, 0.03 })
    {
      const Stored stored(resolution, Storage::Compressed, error);
      const std::vector<double> all = stored.differences();
      // All textures but those of one value are in the sample here.
      EXPECT_LE(rmsOf(all), error) << resolution;
      EXPECT_LE(*std::max_element(all.begin(), all.end()),
        ComponentPacker::LargestDifference * error + 1e-4);
      // What is reported does not know that values are limited to 0 and the maximum.
      EXPECT_LE(rmsOf(all), stored.table.difference + 1e-6);
      EXPECT_NEAR(stored.table.difference, rmsOf(all), 0.06 * error);
    }
  }
}

TEST(Compressed, TakesLessWhereMoreIsAllowed)
{
  const Stored fine(16, Storage::Compressed, 0.01), coarse(16, Storage::Compressed, 0.03),
    noisy(16, Storage::Compressed, 0.01, 0.04);
  EXPECT_LT(fine.table.size(), 0.8 * 256 * fine.full.rows());
  EXPECT_LT(coarse.table.size(), 0.6 * static_cast<double>(fine.table.size()));
  EXPECT_LT(noisy.table.size(), fine.table.size());
  EXPECT_LE(rmsOf(noisy.differences()), allowedDifference(0.01, 0.04));
}

TEST(Compressed, DarkAndOpenStayExact)
{
  const Stored stored(16, Storage::Compressed, 0.03);
  const OcclusionTextures textures(stored.packed, 16, stored.packedRows.data(), nullptr);
  EXPECT_EQ(textures.at(0, { 0.3f, 0.4f, 0.5f }), 0.0f);
  EXPECT_NEAR(textures.at(1, { 0.3f, 0.4f, 0.5f }), 1.0f, 0.004f);
}

TEST(Compressed, IsTheSameForAnyOrderOfTheTextures)
{
  const Stored stored(16, Storage::Compressed, 0.02);
  TextureTable reversed(16, 0);
  std::vector<std::int32_t> rows;
  for (std::size_t i = stored.rowOf.size() - 1; i-- > 0;)
  {
    rows.push_back(reversed.insert(stored.textureAt(i)));
  }
  BakeSettings settings;
  settings.storage = Storage::Compressed;
  settings.storageError = 0.02;
  const EncodedTable other =
    storeTextures(std::move(reversed), settings, Maximum, 0, ProcessGroup::alone(), rows);
  EXPECT_TRUE(other.packed == stored.table.packed);
  const PackedTextures packed(
    other.packed, other.bytes.data(), static_cast<std::size_t>(other.rows));
  std::vector<float> a(256), b(256);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    packed.decode(static_cast<std::size_t>(rows[i]), a.data());
    stored.packed->decode(
      static_cast<std::size_t>(stored.packedRows[rows.size() - 1 - i]), b.data());
    ASSERT_EQ(a, b) << i;
  }
}

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
  EXPECT_THROW(classBitsOf("89"), std::invalid_argument);
  EXPECT_THROW(classBitsOf("x"), std::invalid_argument);
}
}
