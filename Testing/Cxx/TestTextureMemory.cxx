// SPDX-License-Identifier: BSD-3-Clause
/// What a bake keeps for the next one, and what it finds changed.

#include "Random.h"
#include "SceneChanges.h"
#include "TextureMemory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
constexpr std::size_t Texels = 4;

/// Textures that can be told apart by their number; every third one is of one value.
std::vector<float> texturesOf(const std::vector<int>& numbers)
{
  std::vector<float> texels;
  for (const int number : numbers)
  {
    for (std::size_t k = 0; k < Texels; ++k)
    {
      texels.push_back(static_cast<float>(number) + (number % 3 == 0 ? 0 : 0.1f) * k);
    }
  }
  return texels;
}

/// Runs a bake with a memory and returns the values that come out, in order.
/// @param earlier see TextureMemory::begin
/// @param baked the numbers of the textures that are baked
std::vector<float> run(po::TextureMemory& memory, const std::vector<std::int32_t>& earlier,
  const std::vector<int>& baked, double error = 0)
{
  std::vector<float> all;
  const po::TextureMemory::Sink sink = [&](const po::RawTextures& raw)
  {
    EXPECT_EQ(raw.firstParticle, all.size() / Texels);
    for (std::size_t i = 0; i < raw.count * Texels; ++i)
    {
      all.push_back(raw.values[i]);
      EXPECT_EQ(raw.outsideShares[i], -raw.values[i]);
    }
  };
  memory.begin(earlier);
  const std::vector<float> values = texturesOf(baked);
  std::vector<float> shares = values;
  std::for_each(shares.begin(), shares.end(), [](float& share) { share = -share; });
  const std::size_t half = baked.size() / 2;
  memory.add({ 0, half, values.data(), shares.data() }, sink);
  memory.add(
    { half, baked.size() - half, values.data() + half * Texels, shares.data() + half * Texels },
    sink);
  memory.finish(error, sink);
  return all;
}
}

TEST(TextureMemory, PutsWhatIsBakedBetweenWhatWasKept)
{
  po::TextureMemory memory(2);
  EXPECT_EQ(run(memory, { -1, -1, -1, -1 }, { 1, 2, 3, 4 }), texturesOf({ 1, 2, 3, 4 }));
  EXPECT_EQ(memory.reused(), 0u);
  EXPECT_EQ(run(memory, { 3, -1, 2, -1, 0 }, { 5, 6 }), texturesOf({ 4, 5, 3, 6, 1 }));
  EXPECT_EQ(memory.reused(), 3u);
  EXPECT_EQ(run(memory, { 4, 3, 1, 0, 2 }, {}), texturesOf({ 1, 6, 5, 4, 3 }));
  EXPECT_EQ(run(memory, {}, {}), texturesOf({}));
}

TEST(TextureMemory, TakesNoMoreThanItSays)
{
  po::TextureMemory memory(2);
  std::vector<int> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = static_cast<int>(3 * i + 1);
  }
  const std::vector<std::int32_t> none(numbers.size(), -1);
  run(memory, none, numbers);
  const double bytes = memory.bytes();
  EXPECT_GE(bytes, numbers.size() * 2 * Texels * sizeof(float));
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(run(memory, none, numbers), texturesOf(numbers));
    EXPECT_EQ(memory.bytes(), bytes); // slots are used again
  }
}

TEST(TextureMemory, ErrorsAreThoseOfTheBakesThatTexturesAreFrom)
{
  po::TextureMemory memory(2);
  run(memory, { -1, -1 }, { 1, 2 }, 0.3);
  EXPECT_DOUBLE_EQ(memory.estimatedError(), 0.3);
  run(memory, { 0, -1 }, { 3 }, 0.1);
  EXPECT_DOUBLE_EQ(memory.estimatedError(), std::sqrt((0.09 + 0.01) / 2));
  run(memory, { 1, 0 }, {}, 0);
  EXPECT_DOUBLE_EQ(memory.estimatedError(), std::sqrt((0.09 + 0.01) / 2));
}

TEST(SceneChanges, WhatMovedIsThereTwice)
{
  const std::vector<po::Sphere> before = { { 0, 0, 0, 1 }, { 5, 0, 0, 1 }, { 9, 0, 0, 1 } };
  const std::vector<po::Sphere> now = { { 0, 0, 0, 1 }, { 9, 0, 0, 1 }, { 20, 0, 0, 2 } };
  const po::SceneChanges changes = po::findChanges(before, {}, now, {});
  EXPECT_EQ(changes.earlier, (std::vector<std::int32_t>{ 0, 2, -1 }));
  EXPECT_TRUE(changes.inOrder);
  ASSERT_EQ(changes.balls.size(), 2u);
  EXPECT_EQ(changes.balls[0].x, 5);
  EXPECT_EQ(changes.balls[1].x, 20);
  EXPECT_EQ(changes.balls[1].radius, 2);
}

TEST(SceneChanges, EqualSpheresAreCounted)
{
  const po::Sphere s{ 1, 2, 3, 1 };
  EXPECT_TRUE(po::findChanges({ s, s }, {}, { s, s }, {}).balls.empty());
  EXPECT_EQ(po::findChanges({ s, s }, {}, { s }, {}).balls.size(), 1u);
  EXPECT_EQ(po::findChanges({ s }, {}, { s, s }, {}).balls.size(), 1u);
  EXPECT_EQ(po::findChanges({ s }, {}, { { 1, 2, 3, 1.0000001f } }, {}).balls.size(), 2u);
}

TEST(SceneChanges, AnotherOrderIsNoticed)
{
  const po::Sphere a{ 1, 2, 3, 1 }, b{ 2, 2, 3, 1 }, c{ 3, 2, 3, 1 };
  EXPECT_TRUE(po::findChanges({ a, c }, {}, { a, b, c }, {}).inOrder);
  EXPECT_FALSE(po::findChanges({ a, c }, {}, { c, b, a }, {}).inOrder);
}

TEST(SceneChanges, BallsHoldTheTrianglesThatChange)
{
  const po::OccluderMesh before{ { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, { 9, 9, 9 } },
    { { 0, 1, 2 }, { 1, 2, 3 } } };
  const po::OccluderMesh now{ { { 9, 9, 8 }, { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 } },
    { { 2, 3, 0 }, { 1, 2, 3 } } }; // other numbers; one corner has moved
  const po::SceneChanges changes = po::findChanges({}, before, {}, now);
  ASSERT_EQ(changes.balls.size(), 2u);
  for (const po::Sphere& ball : changes.balls)
  {
    for (const po::Vec3f corner : { po::Vec3f{ 3, 0, 0 }, po::Vec3f{ 0, 3, 0 } })
    {
      EXPECT_LE(length(corner - ball.center()), ball.radius);
    }
  }
  EXPECT_TRUE(po::findChanges({}, before, {}, before).balls.empty());
}

TEST(SceneChanges, MarksWhatBruteForceFindsWithinReach)
{
  po::Random random(5, 0, 0);
  const auto some = [&](int count)
  {
    std::vector<po::Sphere> spheres;
    for (int i = 0; i < count; ++i)
    {
      const auto coordinate = [&] { return static_cast<float>(20 * random.uniform()); };
      const double radius = std::pow(10.0, -2 + 2.3 * random.uniform());
      spheres.push_back({ coordinate(), coordinate(), coordinate(), static_cast<float>(radius) });
    }
    return spheres;
  };
  const std::vector<po::Sphere> spheres = some(2000), balls = some(30);
  constexpr double Reach = 0.7;
  const std::vector<std::uint8_t> marks = po::markWithin(spheres, balls, Reach);
  int marked = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
  {
    double gap = HUGE_VAL;
    for (const po::Sphere& ball : balls)
    {
      gap = std::min(gap,
        length((ball.center() - spheres[i].center()).as<double>()) - ball.radius -
          spheres[i].radius);
    }
    if (std::abs(gap - Reach) > 0.005)
    {
      EXPECT_EQ(marks[i] != 0, gap < Reach) << i;
    }
    marked += marks[i];
  }
  EXPECT_GT(marked, 100);
  EXPECT_LT(marked, 1900);
  EXPECT_EQ(po::markWithin(spheres, {}, Reach), std::vector<std::uint8_t>(2000, 0));
}
