// SPDX-License-Identifier: BSD-3-Clause
#include "Dilation.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace
{
bool touches(const po::TexelNeighbours& neighbours, std::size_t a, std::size_t b)
{
  const auto& list = neighbours.of(a);
  return std::find(list.begin(), list.end(), b) != list.end();
}

TEST(Dilation, NeighboursAreMutualAndNeverThemselves)
{
  for (const int resolution : { 1, 2, 3, 4, 5, 16, 17, 64 })
  {
    const po::TexelNeighbours neighbours(resolution);
    const auto texels = static_cast<std::size_t>(resolution * resolution);
    for (std::size_t a = 0; a < texels; ++a)
    {
      EXPECT_FALSE(touches(neighbours, a, a));
      for (const std::size_t b : neighbours.of(a))
      {
        EXPECT_TRUE(touches(neighbours, b, a)) << resolution << ": " << a << " " << b;
      }
    }
  }
}

TEST(Dilation, NeighboursWrapInAzimuthAndCrossThePole)
{
  constexpr int resolution = 16;
  const po::TexelNeighbours neighbours(resolution);
  const auto at = [](int row, int column) { return po::texelIndex(resolution, row, column); };
  EXPECT_EQ(neighbours.of(at(7, 7)).size(), 8u);
  EXPECT_TRUE(touches(neighbours, at(7, 0), at(7, 15)));
  EXPECT_TRUE(touches(neighbours, at(7, 0), at(8, 15)));
  EXPECT_TRUE(touches(neighbours, at(0, 3), at(0, 11))); // straight over the pole
  EXPECT_TRUE(touches(neighbours, at(0, 3), at(0, 10)));
  EXPECT_FALSE(touches(neighbours, at(0, 3), at(0, 7))); // a quarter turn away
  EXPECT_TRUE(touches(neighbours, at(15, 3), at(15, 11)));
  EXPECT_FALSE(touches(neighbours, at(0, 3), at(15, 3))); // the poles do not touch each other
}

TEST(Dilation, KnownTexelsStayAndUnknownOnesTakeTheMeanOfTheirRing)
{
  constexpr int resolution = 8;
  const po::TexelNeighbours neighbours(resolution);
  std::vector<float> values(64, 1.0f);
  std::vector<std::uint8_t> known(64, 1);
  const std::size_t hole = po::texelIndex(resolution, 4, 0);
  known[hole] = 0;
  values[hole] = 99;
  values[po::texelIndex(resolution, 4, 7)] = 9; // one of eight, across the seam
  po::dilate(neighbours, values.data(), known);
  EXPECT_FLOAT_EQ(values[hole], (9.0f + 7.0f) / 8);
  EXPECT_FLOAT_EQ(values[po::texelIndex(resolution, 4, 7)], 9);
  EXPECT_TRUE(std::all_of(known.begin(), known.end(), [](auto k) { return k == 1; }));
}

TEST(Dilation, OneKnownTexelFillsTheWholeTexture)
{
  for (const int resolution : { 1, 2, 3, 5, 16 })
  {
    const po::TexelNeighbours neighbours(resolution);
    const auto texels = static_cast<std::size_t>(resolution * resolution);
    std::vector<float> values(texels, -1.0f);
    std::vector<std::uint8_t> known(texels, 0);
    values[texels / 2] = 0.25f;
    known[texels / 2] = 1;
    po::dilate(neighbours, values.data(), known);
    for (const float value : values)
    {
      EXPECT_FLOAT_EQ(value, 0.25f);
    }
  }
}

TEST(Dilation, NothingKnownGivesZero)
{
  const po::TexelNeighbours neighbours(4);
  std::vector<float> values(16, 5.0f);
  std::vector<std::uint8_t> known(16, 0);
  po::dilate(neighbours, values.data(), known);
  EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0.0f), 0.0f);
}

TEST(Dilation, FillsAPolarCapFromItsRimEvenly)
{
  // All rows above 3 are unknown, the rim is 0.5: every ring must become 0.5, the pole included.
  constexpr int resolution = 16;
  const po::TexelNeighbours neighbours(resolution);
  std::vector<float> values(256, 0.5f);
  std::vector<std::uint8_t> known(256, 1);
  std::fill(known.begin(), known.begin() + 3 * resolution, std::uint8_t(0));
  po::dilate(neighbours, values.data(), known);
  for (const float value : values)
  {
    EXPECT_FLOAT_EQ(value, 0.5f);
  }
}
}
