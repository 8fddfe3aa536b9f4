// SPDX-License-Identifier: BSD-3-Clause
/// Numbers that are no spheres, or hardly, and counts that do not fit small integers.

#include "OcclusionTextures.h"
#include "SphereCloud.h"
#include "StressCase.h"
#include "TextureTable.h"

#include <gtest/gtest.h>

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace
{
using namespace stress;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Tiny = std::numeric_limits<double>::denorm_min();
constexpr double Huge = std::numeric_limits<double>::max();

po::SphereCloud cloudOf(const std::vector<Ball>& balls)
{
  return po::makeSphereCloud(
    balls.size(), [&](std::size_t i) { return balls[i].center; },
    [&](std::size_t i) { return balls[i].radius; });
}

std::vector<Ball> goodBalls()
{
  return scenes().front().balls;
}

/// What is no sphere, each counted for one reason.
std::vector<Ball> badBalls()
{
  return { { { NaN, 0, 0 }, 1 }, { { 0, Infinity, 0 }, 1 }, { { 0, 0, -Infinity }, 1 },
    { { 0, 0, 0 }, NaN }, { { 1, 0, 0 }, Infinity }, { { 1, 0, 0 }, 0 }, { { 1, 0, 0 }, -0.0 },
    { { 1, 0, 0 }, -3 }, { { 1, 0, 0 }, -Infinity }, { { NaN, NaN, NaN }, NaN } };
}

TEST(StressInput, WhatIsNoSphereChangesNoBitsOfTheOthers)
{
  const std::vector<Ball> good = goodBalls();
  std::vector<Ball> mixed = good;
  const std::vector<Ball> bad = badBalls();
  mixed.insert(mixed.end(), bad.begin(), bad.end());
  const po::SphereCloud cloud = cloudOf(mixed);
  EXPECT_EQ(cloud.spheres.size(), good.size());
  EXPECT_EQ(cloud.rejected.nonFinitePosition, 4u);
  EXPECT_EQ(cloud.rejected.nonFiniteRadius, 3u);
  EXPECT_EQ(cloud.rejected.nonPositiveRadius, 3u);
  std::vector<std::size_t> watched(good.size());
  std::iota(watched.begin(), watched.end(), std::size_t(0));
  for (const Method method : Methods)
  {
    SCOPED_TRACE(nameOf(method));
    EXPECT_EQ(bake(mixed, watched, method, 64).values, bake(good, watched, method, 64).values);
  }
}

TEST(StressInput, OneAbsurdParticleLeavesTheOthersAsTheyAre)
{
  // Far out of range of what floats can hold beside the others, in place or size: it is left out,
  // and the others are baked as if it were not there.
  const std::vector<Ball> good = goodBalls();
  const po::SphereCloud alone = cloudOf(good);
  for (const Ball& absurd :
    { Ball{ { 1e300, 0, 0 }, 1 }, Ball{ { Huge, -Huge, Huge }, 1 }, Ball{ { 0, 0, 0 }, 1e300 },
      Ball{ { 0, 0, 0 }, Huge }, Ball{ { -1e40, 0, 1e40 }, 1e40 }, Ball{ { 3, 0, 0 }, Tiny } })
  {
    SCOPED_TRACE(absurd.radius);
    std::vector<Ball> mixed = good;
    mixed.insert(mixed.begin() + 5, absurd);
    const po::SphereCloud cloud = cloudOf(mixed);
    EXPECT_EQ(cloud.spheres.size(), good.size());
    EXPECT_EQ(cloud.rejected.outOfRange, 1u);
    EXPECT_EQ(cloud.rejected.total(), 1u);
    std::vector<std::size_t> watched{ 0, 1, 2, 10, 20, 30 };
    const Baked before = bake(good, { 0, 1, 2, 9, 19, 29 }, Method::Sweep, 512);
    const Baked after = bake(mixed, watched, Method::Sweep, 512);
    ASSERT_EQ(after.values.size(), before.values.size());
    for (std::size_t i = 0; i < after.values.size(); ++i)
    {
      EXPECT_GE(after.shares[i], 0);
      if (before.shares[i] > 0.5f)
      {
        EXPECT_NEAR(after.values[i], before.values[i], 0.015);
      }
    }
  }
}

TEST(StressInput, DenormalNumbersAreNumbers)
{
  // All of a scene in denormals: radii of some 4,000 steps of the smallest.
  const double unit = 4096 * Tiny;
  std::vector<Ball> balls = goodBalls();
  for (Ball& b : balls)
  {
    b = { unit * b.center, unit * b.radius };
  }
  const po::SphereCloud cloud = cloudOf(balls);
  ASSERT_EQ(cloud.spheres.size(), balls.size());
  const std::vector<std::size_t> watched{ 0, 3, 9, 20 };
  for (const Method method : Methods)
  {
    const Baked tiny = bake(balls, watched, method, 512);
    const Baked usual = bake(goodBalls(), watched, method, 512);
    for (std::size_t i = 0; i < tiny.values.size(); ++i)
    {
      if (usual.shares[i] > 0.5f)
      {
        // Random numbers hang on the bits of a sphere: rays differ by their noise, 6 deviations.
        EXPECT_NEAR(tiny.values[i], usual.values[i], method == Method::Sweep ? 0.03 : 0.19)
          << nameOf(method);
      }
    }
  }
}

TEST(StressInput, MinusZeroIsZero)
{
  std::vector<Ball> plus{ { { 0, 0, 0 }, 1 }, { { 2, 0, 0 }, 1 }, { { 0, 2, 2 }, 1.5 } };
  std::vector<Ball> minus{ { { -0.0, 0, -0.0 }, 1 }, { { 2, -0.0, 0 }, 1 },
    { { -0.0, 2, 2 }, 1.5 } };
  for (const Method method : Methods)
  {
    EXPECT_EQ(
      bake(plus, { 0, 1, 2 }, method, 64).values, bake(minus, { 0, 1, 2 }, method, 64).values);
  }
}

TEST(StressInput, NothingAndOneAndMoreThanSixteenBits)
{
  for (const Method method : Methods)
  {
    SCOPED_TRACE(nameOf(method));
    EXPECT_TRUE(bake({}, {}, method, 16).values.empty());
    const Baked one = bake({ { { 7, 8, 9 }, 3 } }, { 0 }, method, 16);
    EXPECT_EQ(one.values, std::vector<float>(Texels, 1.0f));

    // 2^16 + 1 balls in a row, each nearest to nothing within the distance but for the last two,
    // which touch.
    std::vector<Ball> many;
    for (int i = 0; i < (1 << 16) + 1; ++i)
    {
      many.push_back({ { 4.0 * (i % 256), 4.0 * (i / 256), 0 }, 1 });
    }
    many.back().center = { 4.0 * 255 + 2, 4.0 * 255, 0 };
    const Baked baked = bake(many, { 0, 255, 32768, 65533, 65535, 65536 }, method, 16, 1, 0.5);
    EXPECT_EQ(std::count(baked.values.begin(), baked.values.begin() + 4 * Texels, 1.0f),
      static_cast<std::ptrdiff_t>(4 * Texels));
    for (const std::size_t place : { 4, 5 })
    {
      const float* values = baked.values.data() + place * Texels;
      EXPECT_LT(*std::min_element(values, values + Texels), 1.0f);
    }
  }
}

/// Memory that is only taken where it is written to.
class SparseBytes
{
public:
  explicit SparseBytes(std::size_t size)
    : size_(size)
    , data_(mmap(
        nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0))
  {
  }
  ~SparseBytes()
  {
    if (isThere())
    {
      munmap(data_, size_);
    }
  }
  SparseBytes(const SparseBytes&) = delete;
  SparseBytes& operator=(const SparseBytes&) = delete;
  [[nodiscard]] bool isThere() const { return data_ != MAP_FAILED; }
  template <typename T>
  [[nodiscard]] T* as() const
  {
    return static_cast<T*>(data_);
  }

private:
  std::size_t size_;
  void* data_;
};

TEST(StressInput, TexturesBeyondTheReachOf32Bits)
{
  // 64 x 64 texels of 2^20 + 3 textures: index 2^32 and more. Of the table only the last rows are
  // ever touched.
  constexpr std::size_t rows = (1 << 20) + 3;
  constexpr std::size_t texels = 64 * 64;
  const SparseBytes bytes(rows * texels);
  const SparseBytes floats(rows * texels * sizeof(float));
  if (!bytes.isThere() || !floats.isThere())
  {
    GTEST_SKIP() << "no address space";
  }
  std::fill_n(bytes.as<std::uint8_t>() + (rows - 1) * texels, texels, std::uint8_t(255));
  std::fill_n(floats.as<float>() + (rows - 1) * texels, texels, 0.25f);
  const std::int32_t last = static_cast<std::int32_t>(rows) - 1;
  const po::OcclusionTextures coded(64, bytes.as<std::uint8_t>(), 0.5, &last, nullptr);
  const po::OcclusionTextures plain(64, floats.as<float>(), &last, nullptr);
  EXPECT_FLOAT_EQ(coded.at(0, { 0.3f, -0.5f, 0.1f }), 0.5f);
  EXPECT_FLOAT_EQ(plain.at(0, { 0.3f, -0.5f, 0.1f }), 0.25f);
}
}
