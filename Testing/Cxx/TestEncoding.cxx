// SPDX-License-Identifier: BSD-3-Clause
#include "Gamma2.h"
#include "TextureTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace
{
TEST(Encoding, RoundTripsWithinHalfAStep)
{
  for (const double maximum : { 1.0, 0.3, 7.25, 1e-20 })
  {
    for (int i = 0; i <= 10000; ++i)
    {
      const double value = maximum * i / 10000;
      const double back = po::decodeGamma2(po::encodeGamma2(value, maximum), maximum);
      const double error = std::abs(std::sqrt(back / maximum) - std::sqrt(value / maximum));
      EXPECT_LE(error, 0.5 / 255 + 1e-12) << value << " of " << maximum;
    }
  }
}

TEST(Encoding, EveryByteSurvives)
{
  for (int byte = 0; byte < 256; ++byte)
  {
    const auto b = static_cast<std::uint8_t>(byte);
    EXPECT_EQ(po::encodeGamma2(po::decodeGamma2(b, 0.7), 0.7), b);
  }
}

TEST(Encoding, EndsAreExact)
{
  EXPECT_EQ(po::encodeGamma2(0, 1), 0);
  EXPECT_EQ(po::encodeGamma2(1, 1), 255);
  EXPECT_EQ(po::encodeGamma2(0, 0), 0); // a table that is dark throughout
  EXPECT_EQ(po::decodeGamma2(0, 0), 0);
  EXPECT_EQ(po::encodeGamma2(-1, 1), 0);
  EXPECT_EQ(po::encodeGamma2(2, 1), 255);
  EXPECT_EQ(po::encodeGamma2(std::numeric_limits<double>::quiet_NaN(), 1), 0);
}

TEST(TextureTable, StoresEqualTexturesOnce)
{
  po::TextureTable table(2, 4);
  const float open[] = { 1, 1, 1, 1 };
  const float dark[] = { 0, 0, 0, 0 };
  const float half[] = { 0, 1, 0, 1 };
  EXPECT_EQ(table.insert(open), 0);
  EXPECT_EQ(table.insert(dark), 1);
  EXPECT_EQ(table.insert(open), 0);
  EXPECT_EQ(table.insert(half), 2);
  EXPECT_EQ(table.insert(half), 2);
  EXPECT_EQ(table.rows(), 3);
}

TEST(TextureTable, EncodingMergesTexturesThatRoundToTheSameBytes)
{
  po::TextureTable table(1, 4);
  const float values[] = { 1.0f, 0.5f, 0.5000001f, 0.25f };
  std::vector<std::int32_t> rowOf;
  for (const float& value : values)
  {
    rowOf.push_back(table.insert(&value));
  }
  rowOf.push_back(-1); // a particle without a texture
  const po::EncodedTable encoded = po::encode(std::move(table), po::Encoding::UInt8Gamma2, rowOf);
  EXPECT_EQ(encoded.rows, 3);
  EXPECT_EQ(rowOf, (std::vector<std::int32_t>{ 0, 1, 1, 2, -1 }));
  EXPECT_EQ(encoded.bytes.size(), 3u);
  EXPECT_EQ(encoded.bytes[0], 255);
  EXPECT_EQ(encoded.maximum, 1.0);
}

TEST(TextureTable, FloatEncodingKeepsTheValues)
{
  po::TextureTable table(1, 2);
  const float values[] = { 0.125f, 3.5f };
  std::vector<std::int32_t> rowOf{ table.insert(&values[0]), table.insert(&values[1]) };
  const po::EncodedTable encoded = po::encode(std::move(table), po::Encoding::Float32Linear, rowOf);
  EXPECT_EQ(encoded.floats, (std::vector<float>{ 0.125f, 3.5f }));
  EXPECT_EQ(encoded.maximum, 3.5);
  EXPECT_TRUE(encoded.bytes.empty());
}
}
