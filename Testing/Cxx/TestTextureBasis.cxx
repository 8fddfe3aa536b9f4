// SPDX-License-Identifier: BSD-3-Clause
#include "TextureStorageTestSupport.h"

#include "TextureBasis.h"

#include <gtest/gtest.h>

#include <array>

namespace
{
using namespace storage_test;

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
}
