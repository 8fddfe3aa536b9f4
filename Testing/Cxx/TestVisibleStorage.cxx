// SPDX-License-Identifier: BSD-3-Clause
// Storing textures of particles that others cover in part: only what is visible counts.
#include "TextureStorageTestSupport.h"

#include "ComponentPacker.h"
#include "TexelWeights.h"
#include "TextureSample.h"
#include "ThreadGroup.h"
#include "VisibleFit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace
{
using namespace storage_test;

/// Outside shares where a cap about an axis is inside another sphere.
std::vector<float> sharesOutside(int resolution, Vec3d axis, double cosine)
{
  std::vector<float> shares;
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = 0; column < resolution; ++column)
    {
      const Vec3d point =
        textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
      shares.push_back(dot(point, axis) > cosine ? 0.0f : 1.0f);
    }
  }
  return shares;
}

TEST(TexelWeights, OfAWholeParticleAreNone)
{
  EXPECT_EQ(TexelWeights(16).of(std::vector<float>(256, 1.0f).data()), nullptr);
}

TEST(TexelWeights, AreTheVisibleAreaThatIsInterpolatedFromATexel)
{
  // Rows 0 to 3 of 8 are outside.
  std::vector<float> shares(64, 0.0f);
  std::fill_n(shares.begin(), 32, 1.0f);
  TexelWeights rows(8);
  const std::uint8_t* weights = rows.of(shares.data());
  for (std::size_t column = 0; column < 8; ++column)
  {
    EXPECT_EQ(weights[column], TexelWeights::Whole) << "interpolation stops at the pole";
    EXPECT_EQ(weights[3 * 8 + column], 223) << "7/8";
    EXPECT_EQ(weights[4 * 8 + column], 32) << "1/8";
    EXPECT_EQ(weights[5 * 8 + column], 1) << "seen by nobody";
  }
  std::vector<float> one(64, 0.0f);
  one[2 * 8] = 1;
  weights = rows.of(one.data());
  EXPECT_EQ(weights[2 * 8], 143) << "9/16";
  EXPECT_EQ(weights[2 * 8 + 7], 24) << "3/32, across the seam";
  EXPECT_EQ(weights[1 * 8 + 7], 4) << "1/64";
}

TEST(TextureTable, TellsTexturesApartByWhatIsVisible)
{
  const std::vector<float> values = textureOf(4, [](Vec3d p) { return 0.5 + 0.3 * p.x; });
  std::vector<std::uint8_t> some(16, 255), other(16, 255);
  some[3] = 7;
  other[3] = 8;
  TextureTable table(4, 0);
  EXPECT_EQ(table.insert(values.data()), 0);
  EXPECT_EQ(table.insert({ values.data(), some.data() }), 1);
  EXPECT_EQ(table.insert({ values.data(), other.data() }), 2);
  EXPECT_EQ(table.insert({ values.data(), some.data() }), 1);
  EXPECT_EQ(table.insert(values.data()), 0);
  EXPECT_EQ(table.texture(0).weights, nullptr);
  EXPECT_EQ(table.texture(2).weights[3], 8);
  EXPECT_EQ(table.rows(), 3);
}

TEST(TextureResampler, FitsWhatCountsAndKeepsTheRestNear)
{
  // Smooth where it counts, a step elsewhere.
  const auto texture =
    textureOf(16, [](Vec3d p) { return p.z > 0 ? 0.5 + 0.2 * p.x : (p.y > 0 ? 1.0 : 0.0); });
  const std::vector<float> shares = sharesOutside(16, { 0, 0, -1 }, 0);
  TexelWeights weights(16);
  const std::uint8_t* bytes = weights.of(shares.data());
  std::vector<float> areas = texelShares(16);
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    areas[i] *= static_cast<float>(bytes[i]) / 255;
  }
  const TextureResampler resampler(16, 4);
  std::vector<float> plain(16), fitted(16), shown(256);
  resampler.reduce(texture.data(), plain.data());
  resampler.reduce(texture.data(), areas.data(), fitted.data());
  const auto error = [&](const std::vector<float>& reduced)
  {
    resampler.enlarge(reduced.data(), shown.data());
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < 256; ++i)
    {
      sum += static_cast<double>(areas[i] * (shown[i] - texture[i]) * (shown[i] - texture[i]));
      area += static_cast<double>(areas[i]);
    }
    return std::sqrt(sum / area);
  };
  EXPECT_LT(error(fitted), 0.85 * error(plain)); // texels at the rim count too
  EXPECT_LT(difference(16, texture.data(), shown.data()), 0.5) << "plausible where nobody looks";
}

/// Textures of which random caps are covered.
struct Covered
{
  explicit Covered(int resolution, int count = 600)
    : table(resolution, 0)
  {
    std::vector<std::int32_t> rows;
    const TextureTable whole = someTextures(resolution, rows, count);
    TexelWeights weights(resolution);
    Random random(11, 0, 0);
    for (std::int32_t row = 0; row < whole.rows(); ++row)
    {
      const float* values = whole.texture(row).values;
      const auto shares = sharesOutside(resolution, anyDirection(random), random.uniform() - 0.9);
      const bool flat = hasOneValue(values, whole.texelsPerRow());
      rowOf.push_back(table.insert({ values, flat ? nullptr : weights.of(shares.data()) }));
    }
  }

  [[nodiscard]] EncodedTable stored(Storage storage, double error, bool weighed = true) const
  {
    BakeSettings settings;
    settings.textureResolution = table.resolution();
    settings.storage = storage;
    settings.storageError = error;
    packedRows = rowOf;
    TextureTable copy(table.resolution(), 0);
    for (std::int32_t row = 0; row < table.rows(); ++row)
    {
      const WeighedTexture texture = table.texture(row);
      copy.insert({ texture.values, weighed ? texture.weights : nullptr });
    }
    return storeTextures(std::move(copy), settings, Maximum, 0, ProcessGroup::alone(), packedRows);
  }

  TextureTable table;
  std::vector<std::int32_t> rowOf;
  mutable std::vector<std::int32_t> packedRows; ///< of what was stored last
};

/// Over what is visible of each texture, and of all.
struct VisibleDifferences
{
  VisibleDifferences(const Covered& covered, const EncodedTable& stored)
  {
    const PackedTextures packed(
      stored.packed, stored.bytes.data(), static_cast<std::size_t>(stored.rows));
    const std::vector<float> shares = texelShares(stored.resolution);
    std::vector<float> shown(shares.size());
    double all = 0, area = 0;
    for (std::size_t i = 0; i < covered.rowOf.size(); ++i)
    {
      const WeighedTexture own = covered.table.texture(covered.rowOf[i]);
      packed.decode(static_cast<std::size_t>(covered.packedRows[i]), shown.data());
      double square = 0, visible = 0;
      for (std::size_t t = 0; t < shown.size(); ++t)
      {
        const double weight = own.weights ? own.weights[t] / 255.0 * shares[t] : shares[t];
        const double d = static_cast<double>(shown[t] - own.values[t]);
        square += weight * d * d;
        visible += weight;
        largestHidden = std::max(largestHidden, weight < 0.004 ? std::abs(d) : 0.0);
      }
      largest = std::max(largest, std::sqrt(square / visible));
      all += square;
      area += visible;
    }
    rms = std::sqrt(all / area);
  }

  double rms = 0, largest = 0, largestHidden = 0;
};

TEST(VisibleStorage, BoundsHoldForWhatIsVisible)
{
  for (const int resolution : { 1, 4, 12, 16 })
  {
    const Covered covered(resolution);
    for (const double error : { 0.01, 0.03 })
    {
      SCOPED_TRACE(resolution);
      const EncodedTable sized = covered.stored(Storage::VariableSize, error);
      const VisibleDifferences ofSized(covered, sized);
      EXPECT_LE(ofSized.largest, error + 1e-6);
      EXPECT_NEAR(sized.difference, ofSized.rms, 1e-5);
      const EncodedTable compressed = covered.stored(Storage::Compressed, error);
      const VisibleDifferences ofCompressed(covered, compressed);
      EXPECT_LE(ofCompressed.rms, error);
      EXPECT_LE(ofCompressed.largest, ComponentPacker::LargestDifference * error + 1e-4);
      EXPECT_NEAR(compressed.difference, ofCompressed.rms, 0.06 * error);
      EXPECT_LE(ofCompressed.largestHidden, Maximum);
    }
  }
}

TEST(VisibleStorage, TakesLessThanIfAllWereVisible)
{
  const Covered covered(16);
  for (const Storage storage : { Storage::VariableSize, Storage::Compressed })
  {
    const std::size_t visible = covered.stored(storage, 0.02).size();
    EXPECT_LT(static_cast<double>(visible),
      0.9 * static_cast<double>(covered.stored(storage, 0.02, false).size()));
  }
}

TEST(VisibleFit, CodesWhatIsVisibleCloserThanAProjectionOfAll)
{
  const Covered covered(16);
  const TextureSample sample = sampleTextures(covered.table, 4096, ProcessGroup::alone());
  EXPECT_FALSE(sample.isWhole());
  const TextureBasis basis = principalComponents(16, sample.values, 24);
  const VisibleFit fit(basis);
  const TextureProjection projection(basis);
  const SizePacker areas(16, Maximum, 0.01);
  const std::vector<std::uint8_t> bits(basis.components(), 3);
  std::vector<float> weights;
  double fitted = 0, projected = 0;
  for (std::size_t i = 0; i < sample.size(256); ++i)
  {
    const WeighedTexture texture = sample.texture(i, 256);
    const auto area = areas.areaOf(texture, weights);
    const VisibleFit::Texture prepared = fit.prepare(texture.values, area.weights);
    fitted += VisibleFit::squareLeft(prepared, VisibleFit::fit(prepared, bits));
    std::vector<float> coefficients(basis.components());
    projection.project(texture.values, coefficients.data());
    for (std::size_t k = 0; k < bits.size(); ++k)
    {
      coefficients[k] = Quantizer::decode(Quantizer::encode(coefficients[k], bits[k]), bits[k]);
    }
    projected += VisibleFit::squareLeft(prepared, coefficients);
  }
  EXPECT_LT(fitted, 0.6 * projected);
}

TEST(VisibleFit, TellsTheSquareThatIsLeft)
{
  const Covered covered(8, 200);
  const TextureSample sample = sampleTextures(covered.table, 4096, ProcessGroup::alone());
  const TextureBasis basis = principalComponents(8, sample.values, 10);
  const SizePacker areas(8, Maximum, 0.01);
  const std::vector<std::uint8_t> bits = { 4, 3, 3, 2, 2, 1 };
  std::vector<float> weights;
  for (std::size_t i = 0; i < sample.size(64); ++i)
  {
    const WeighedTexture texture = sample.texture(i, 64);
    const auto area = areas.areaOf(texture, weights);
    const VisibleFit::Texture prepared = VisibleFit(basis).prepare(texture.values, area.weights);
    const std::vector<float> coefficients = VisibleFit::fit(prepared, bits);
    double expected = 0;
    for (std::size_t t = 0; t < 64; ++t)
    {
      double shown = static_cast<double>(basis.value(0, t));
      for (std::size_t k = 0; k < bits.size(); ++k)
      {
        shown += static_cast<double>(coefficients[k] * basis.value(1 + k, t));
      }
      const double d = shown - static_cast<double>(texture.values[t]);
      expected += static_cast<double>(area.weights[t]) * d * d;
    }
    EXPECT_NEAR(VisibleFit::squareLeft(prepared, coefficients), expected, 1e-6);
  }
}

TEST(TextureSample, IsTheSameHoweverTexturesAreDivided)
{
  const Covered covered(16);
  const TextureSample alone = sampleTextures(covered.table, 100, ProcessGroup::alone());
  for (const int processes : { 2, 3 })
  {
    std::vector<TextureSample> samples(static_cast<std::size_t>(processes));
    inParallel(processes,
      [&](const ProcessGroup& group)
      {
        const int process = group.rank();
        TextureTable own(16, 0);
        for (std::int32_t row = process; row < covered.table.rows(); row += processes)
        {
          own.insert(covered.table.texture(row));
        }
        samples[static_cast<std::size_t>(process)] = sampleTextures(own, 100, group);
      });
    for (const TextureSample& sample : samples)
    {
      EXPECT_EQ(sample.values, alone.values);
      EXPECT_EQ(sample.weights, alone.weights);
      EXPECT_EQ(sample.population, alone.population);
    }
  }
}
}
