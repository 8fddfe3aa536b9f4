// SPDX-License-Identifier: BSD-3-Clause
#include "Constants.h"
#include "Random.h"
#include "TexelLookup.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{
using po::Pi;

TEST(TexelMap, AreasAddUpToTheSphere)
{
  for (int resolution = 1; resolution <= 64; ++resolution)
  {
    double sum = 0;
    for (int row = 0; row < resolution; ++row)
    {
      sum += resolution * po::texelArea(resolution, row);
    }
    EXPECT_NEAR(sum, 4 * Pi, 1e-12) << resolution;
  }
}

TEST(TexelMap, CoordinatesRoundTrip)
{
  po::Random random(1, 0, 0);
  for (int i = 0; i < 10000; ++i)
  {
    const po::TextureCoordinate c{ random.uniform(), random.uniform() };
    const po::TextureCoordinate back = po::textureCoordinate(po::textureDirection(c));
    EXPECT_NEAR(back.u, c.u, 1e-12) << c.v;
    EXPECT_NEAR(back.v, c.v, 1e-14);
  }
}

TEST(TexelMap, AxesLieWhereTheConventionSays)
{
  EXPECT_EQ(po::textureCoordinate({ 0, 0, 2 }).v, 0);
  EXPECT_EQ(po::textureCoordinate({ 0, 0, -2 }).v, 1);
  EXPECT_EQ(po::textureCoordinate({ 1, 0, 0 }).u, 0);
  EXPECT_NEAR(po::textureCoordinate({ 0, 1, 0 }).u, 0.25, 1e-15);
  EXPECT_NEAR(po::textureCoordinate({ -1, 0, 0 }).u, 0.5, 1e-15);
  EXPECT_NEAR(po::textureCoordinate({ 0, -1, 0 }).u, 0.75, 1e-15);
  // Just short of the seam the azimuth must not become 1.
  EXPECT_LT(po::textureCoordinate({ 1, -1e-30, 0 }).u, 1);
  EXPECT_LT(po::textureCoordinate({ 1, -0.0, 0 }).u, 1);
  // A micro-radian from the pole is resolved.
  EXPECT_NEAR(po::textureCoordinate({ 1e-6, 0, 1 }).v, 1e-6 / Pi, 1e-18);
}

/// Texels and weights of one direction.
struct Found
{
  int column0, column1, row0, row1;
  float columnWeight, rowWeight;
};

Found find(int resolution, po::Vec3f direction)
{
  po::TexelLookup lookup;
  for (std::size_t i = 0; i < po::TexelLookup::Size; ++i)
  {
    lookup.x[i] = direction.x;
    lookup.y[i] = direction.y;
    lookup.z[i] = direction.z;
  }
  po::findTexels(resolution, lookup);
  constexpr std::size_t Last = po::TexelLookup::Size - 1;
  std::array<int, 4> rows{}, columns{};
  for (std::size_t k = 0; k < 4; ++k)
  {
    rows[k] = lookup.texel[k][Last] / resolution;
    columns[k] = lookup.texel[k][Last] % resolution;
  }
  EXPECT_EQ(rows[0], rows[1]);
  EXPECT_EQ(rows[2], rows[3]);
  EXPECT_EQ(columns[0], columns[2]);
  EXPECT_EQ(columns[1], columns[3]);
  return { columns[0], columns[1], rows[0], rows[2], lookup.columnWeight[Last],
    lookup.rowWeight[Last] };
}

TEST(TexelLookup, AgreesWithTheExactCoordinates)
{
  constexpr int resolution = 64;
  po::Random random(5, 0, 0);
  for (int i = 0; i < 100000; ++i)
  {
    const po::TextureCoordinate c{ random.uniform(), random.uniform() };
    const po::Vec3f d = 3.0f * po::textureDirection(c).as<float>();
    const po::TextureCoordinate exact = po::textureCoordinate(d.as<double>());
    const Found found = find(resolution, d);
    const double x = exact.u * resolution - 0.5, y = exact.v * resolution - 0.5;
    const double across = std::abs(found.column0 + double(found.columnWeight) - x);
    const double down = found.row0 + double(found.rowWeight) - y;
    ASSERT_LT(std::min(across, std::abs(across - resolution)), 64 * 3e-7) << c.u << ' ' << c.v;
    // Above the middle of the first row both rows are the first.
    ASSERT_TRUE(std::abs(down) < 64 * 3e-7 || (found.row0 == 0 && found.row1 == 0 && y < 0))
      << c.u << ' ' << c.v;
    ASSERT_EQ(found.column1, (found.column0 + 1) % resolution);
    ASSERT_EQ(found.row1, y < 0 ? 0 : std::min(found.row0 + 1, resolution - 1));
  }
}

TEST(TexelLookup, StaysInsideAtAxesAndNowhere)
{
  for (const po::Vec3f d : { po::Vec3f{ 0, 0, 2 }, po::Vec3f{ 0, 0, -2 }, po::Vec3f{ 1, 0, 0 },
         po::Vec3f{ 1, -1e-30f, 0 }, po::Vec3f{ -1, -0.0f, 0 }, po::Vec3f{ 0, 0, 0 } })
  {
    for (const int resolution : { 1, 2, 64 })
    {
      const Found found = find(resolution, d);
      for (const int i : { found.column0, found.column1, found.row0, found.row1 })
      {
        EXPECT_TRUE(i >= 0 && i < resolution) << d.x << ' ' << d.y << ' ' << d.z;
      }
      for (const float weight : { found.columnWeight, found.rowWeight })
      {
        EXPECT_TRUE(weight >= 0 && weight <= 1) << d.x << ' ' << d.y << ' ' << d.z;
      }
    }
  }
  EXPECT_EQ(find(64, { 0, 0, 2 }).row1, 0);
  EXPECT_EQ(find(64, { 0, 0, -2 }).row0, 63);
  EXPECT_EQ(find(64, { 1, 0, 0 }).column0, 63);
  EXPECT_NEAR(find(64, { 1, 0, 0 }).columnWeight, 0.5, 1e-5);
  EXPECT_EQ(find(64, { -1, 0, 0 }).column0, 31);
}

TEST(TexelMap, TexelPointsStayInTheirTexelAndAreUniform)
{
  constexpr int resolution = 7;
  constexpr int side = 40;
  for (int row = 0; row < resolution; ++row)
  {
    const double reach = po::texelAngularRadius(resolution, row);
    for (const int column : { 0, 3, 6 })
    {
      const po::Vec3d center =
        po::textureDirection({ (column + 0.5) / resolution, (row + 0.5) / resolution });
      double meanHeight = 0;
      for (int a = 0; a < side; ++a)
      {
        for (int b = 0; b < side; ++b)
        {
          const po::Vec3d p =
            po::texelPoint(resolution, row, column, (a + 0.5) / side, (b + 0.5) / side);
          const po::TextureCoordinate c = po::textureCoordinate(p);
          EXPECT_EQ(static_cast<int>(c.u * resolution), column);
          EXPECT_EQ(static_cast<int>(c.v * resolution), row);
          EXPECT_LE(std::acos(std::min(1.0, po::dot(p, center))), reach);
          meanHeight += p.z / (side * side);
        }
      }
      // Area is uniform in z, so the mean height is that of the row's edges.
      const double edges =
        (std::cos(Pi * row / resolution) + std::cos(Pi * (row + 1) / resolution)) / 2;
      EXPECT_NEAR(meanHeight, edges, 1e-12);
    }
  }
}

TEST(TexelMap, BilinearLookupIsExactAtCentresWrapsAndClamps)
{
  constexpr int resolution = 16;
  const po::BilinearTexels center =
    po::bilinearTexels(resolution, { 3.5 / resolution, 5.5 / resolution });
  EXPECT_EQ(center.index[0], po::texelIndex(resolution, 5, 3));
  EXPECT_FLOAT_EQ(center.weight[0], 1);

  const po::BilinearTexels seam = po::bilinearTexels(resolution, { 0, 5.5 / resolution });
  EXPECT_EQ(seam.index[0], po::texelIndex(resolution, 5, resolution - 1));
  EXPECT_EQ(seam.index[1], po::texelIndex(resolution, 5, 0));
  EXPECT_FLOAT_EQ(seam.weight[0], 0.5f);

  const po::BilinearTexels pole = po::bilinearTexels(resolution, { 3.5 / resolution, 0 });
  for (const std::size_t index : pole.index)
  {
    EXPECT_LT(index, static_cast<std::size_t>(resolution));
  }
}

TEST(TexelMap, BilinearWeightsAddUpToOneForEveryResolution)
{
  po::Random random(2, 0, 0);
  for (int resolution = 1; resolution <= 64; ++resolution)
  {
    for (int i = 0; i < 200; ++i)
    {
      // The closed range, both ends included.
      const double u = i == 0 ? 0 : random.uniform();
      const double v = i == 0 ? 0 : i == 1 ? 1 : random.uniform();
      const po::BilinearTexels texels = po::bilinearTexels(resolution, { u, v });
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k)
      {
        sum += texels.weight[k];
        EXPECT_GE(texels.weight[k], 0);
        EXPECT_LT(texels.index[k], static_cast<std::size_t>(resolution * resolution));
      }
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}
}
