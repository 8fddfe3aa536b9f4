// SPDX-License-Identifier: BSD-3-Clause
#include "Constants.h"
#include "Sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace
{
using po::Pi;

TEST(Sampling, EveryStratumHasTheSameAreaAndHoldsItsPoints)
{
  for (const int count : { 1, 2, 3, 7, 16, 49, 50, 97, 1000 })
  {
    const po::StratifiedSquare square(count);
    ASSERT_EQ(square.size(), count);
    for (int k = 0; k < count; ++k)
    {
      const po::Point2 low = square.point(k, 0, 0);
      const po::Point2 high = square.point(k, 1, 1);
      EXPECT_NEAR((high.x - low.x) * (high.y - low.y), 1.0 / count, 1e-14) << count << " " << k;
      EXPECT_GE(low.x, 0);
      EXPECT_LE(high.x, 1 + 1e-14);
      EXPECT_GE(low.y, 0);
      EXPECT_LE(high.y, 1 + 1e-14);
    }
  }
}

TEST(Sampling, FortyNineStrataAreSevenBySeven)
{
  const po::StratifiedSquare square(49);
  const po::Point2 corner = square.point(8, 0, 0);
  EXPECT_NEAR(corner.x, 1.0 / 7, 1e-15);
  EXPECT_NEAR(corner.y, 1.0 / 7, 1e-15);
}

TEST(Sampling, StrataCoverTheSquareOnce)
{
  // The mean of x + 10 y over the strata's middles is that of the square.
  for (const int count : { 5, 49, 97 })
  {
    const po::StratifiedSquare square(count);
    double sum = 0;
    for (int k = 0; k < count; ++k)
    {
      const po::Point2 middle = square.point(k, 0.5, 0.5);
      sum += middle.x + 10 * middle.y;
    }
    EXPECT_NEAR(sum / count, 5.5, 1e-13) << count;
  }
}

TEST(Sampling, PermutationsAreUniform)
{
  // All 24 permutations of 4 equally likely: chi-square with 23 degrees of freedom, bound at
  // confidence 1 - 1e-6 (seed fixed, so the outcome is too).
  std::array<int, 256> histogram{};
  std::vector<std::uint32_t> order(4);
  constexpr int draws = 48000;
  for (int i = 0; i < draws; ++i)
  {
    po::Random random(7, static_cast<std::uint64_t>(i), 0);
    po::randomPermutation(random, order);
    ++histogram[order[0] + 4 * order[1] + 16 * order[2] + 64 * order[3]];
  }
  double chiSquare = 0;
  int kinds = 0;
  for (const int observed : histogram)
  {
    kinds += observed > 0 ? 1 : 0;
    chiSquare += observed > 0 ? std::pow(observed - draws / 24.0, 2) / (draws / 24.0) : 0;
  }
  EXPECT_EQ(kinds, 24);
  EXPECT_LT(chiSquare, 71.0);
}

TEST(Sampling, RandomNumbersAreUniformAcrossTexelsAndParticles)
{
  // First number of each generator: 64 bins, 63 degrees of freedom, confidence 1 - 1e-6.
  std::array<int, 64> histogram{};
  constexpr int particles = 256;
  constexpr int texels = 256;
  for (std::uint64_t particle = 0; particle < particles; ++particle)
  {
    for (std::uint64_t texel = 0; texel < texels; ++texel)
    {
      po::Random random(1, particle, texel);
      const double u = random.uniform();
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      ++histogram[static_cast<std::size_t>(64 * u)];
    }
  }
  constexpr double expected = particles * texels / 64.0;
  double chiSquare = 0;
  for (const int observed : histogram)
  {
    chiSquare += std::pow(observed - expected, 2) / expected;
  }
  EXPECT_LT(chiSquare, 131.0);
}

TEST(Sampling, DiskAndHemisphereInvertTheirMaps)
{
  po::Random random(3, 0, 0);
  for (int i = 0; i < 10000; ++i)
  {
    const po::Point2 square{ random.uniform(), random.uniform() };
    const po::Point2 disk = po::diskFromSquare(square);
    EXPECT_LE(std::hypot(disk.x, disk.y), 1 + 1e-15);
    const po::Point2 back = po::squareFromDisk(disk);
    EXPECT_NEAR(back.x, square.x, 1e-12);
    EXPECT_NEAR(back.y, square.y, 1e-12);
    const po::Vec3d direction = po::cosineHemisphereFromSquare(square);
    EXPECT_NEAR(po::length(direction), 1, 1e-12);
    const po::Point2 again = po::squareFromCosineHemisphere(direction);
    EXPECT_NEAR(again.x, square.x, 1e-12);
    EXPECT_NEAR(again.y, square.y, 1e-12);
  }
  EXPECT_EQ(po::diskFromSquare({ 0.5, 0.5 }).x, 0);
}

TEST(Sampling, HemisphereFollowsTheCosine)
{
  // Bins of equal probability: cos^2(theta) is uniform, so is the azimuth. 10 x 12 bins, 119
  // degrees of freedom, confidence 1 - 1e-6.
  constexpr int rings = 10;
  constexpr int sectors = 12;
  constexpr int draws = 240000;
  std::array<int, rings * sectors> histogram{};
  po::Random random(11, 0, 0);
  double meanCosine = 0;
  for (int i = 0; i < draws; ++i)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    const po::Vec3d d = po::cosineHemisphereFromSquare({ x, y });
    const double azimuth = std::atan2(d.y, d.x) / (2 * Pi) + 0.5;
    const int ring = std::min(static_cast<int>(rings * d.z * d.z), rings - 1);
    const int sector = std::min(static_cast<int>(sectors * azimuth), sectors - 1);
    ++histogram[static_cast<std::size_t>(ring * sectors + sector)];
    meanCosine += d.z / draws;
  }
  const double expected = static_cast<double>(draws) / (rings * sectors);
  double chiSquare = 0;
  for (const int observed : histogram)
  {
    chiSquare += std::pow(observed - expected, 2) / expected;
  }
  EXPECT_LT(chiSquare, 204.0);
  // E[cos] = 2/3, variance 1/18: five standard errors.
  EXPECT_NEAR(meanCosine, 2.0 / 3, 5 * std::sqrt(1.0 / 18 / draws));
}

TEST(Sampling, CosineDensityIntegratesToOne)
{
  constexpr int steps = 2000;
  double integral = 0;
  for (int i = 0; i < steps; ++i)
  {
    const double theta = Pi / 2 * (i + 0.5) / steps;
    integral += po::cosineHemispherePdf({ std::sin(theta), 0, std::cos(theta) }) * 2 * Pi *
      std::sin(theta) * (Pi / 2 / steps);
  }
  EXPECT_NEAR(integral, 1, 1e-6);
  EXPECT_EQ(po::cosineHemispherePdf({ 0, 0, -1 }), 0);
}

TEST(Sampling, BasisIsOrthonormalForEveryNormal)
{
  po::Random random(5, 0, 0);
  std::vector<po::Vec3d> normals{ { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 },
    po::normalized(po::Vec3d{ 1e-9, 1e-9, -1 }) };
  for (int i = 0; i < 1000; ++i)
  {
    normals.push_back(po::normalized(
      po::Vec3d{ random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5 }));
  }
  for (const po::Vec3d n : normals)
  {
    const po::Vec3d a = po::aboutNormal(n, { 1, 0, 0 });
    const po::Vec3d b = po::aboutNormal(n, { 0, 1, 0 });
    const po::Vec3d c = po::aboutNormal(n, { 0, 0, 1 });
    EXPECT_NEAR(po::length(a), 1, 1e-12);
    EXPECT_NEAR(po::length(b), 1, 1e-12);
    EXPECT_NEAR(po::dot(a, b), 0, 1e-12);
    EXPECT_NEAR(po::dot(a, c), 0, 1e-12);
    EXPECT_NEAR(po::dot(b, c), 0, 1e-12);
    EXPECT_NEAR(po::length(c - n), 0, 1e-15);
  }
}
}
