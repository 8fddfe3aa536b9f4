// SPDX-License-Identifier: BSD-3-Clause
/// What a sweep projects, and what it leaves out at once.

#include "BlockProjection.h"
#include "ClosedCells.h"
#include "Constants.h"
#include "EstimateDifference.h"
#include "Random.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
po::ProjectedBlock blockOf(const std::vector<po::ProjectedSphere>& spheres)
{
  po::ProjectedBlock block;
  for (const po::ProjectedSphere& sphere : spheres)
  {
    block.x[block.count] = sphere.x;
    block.y[block.count] = sphere.y;
    block.z[block.count] = sphere.z;
    block.radius[block.count] = sphere.radius;
    block.index[block.count] = sphere.index;
    ++block.count;
  }
  return block;
}

TEST(ClosedCells, SpheresMayReachBeyondAllIntegers)
{
  po::ClosedCells cells;
  cells.begin({ 0, 0, 1, 1 }, 1, 1);
  // In cells its radius is far beyond 2^31: it closes all of them.
  cells.close(blockOf({ { 0, 0, 5, 1e12f, 0 } }));
  cells.finish();
  // The last two stick out of the cells: they are not hidden, however far they reach.
  const po::HiddenSpheres hidden = cells.hidden(
    blockOf({ { 0.5f, 0.5f, 3.9f, 1, 1 }, { 0.5f, 0.5f, 4.1f, 1, 2 }, { 0.5f, 0.5f, 5.9f, 1, 3 },
      { 0.5f, 0.5f, 6.1f, 1, 4 }, { 1e12f, 0.5f, -1e13f, 1, 5 }, { 0.5f, 1e12f, -1e13f, 1, 6 } }));
  EXPECT_EQ(hidden.upward, 0b1u);
  EXPECT_EQ(hidden.downward, 0b1000u);
}

TEST(ClosedCells, WhatSticksOutIsNotHidden)
{
  // Four spheres close all cells, the last one at height 2; receivers have radii up to 1.
  po::ClosedCells cells;
  cells.begin({ 0, 0, 8, 8 }, 1, 1);
  cells.close(blockOf({ { -4, -4, 5, 12, 0 }, { -4, 12, 4, 12, 1 }, { 12, -4, 3, 12, 2 } }));
  cells.finish();
  const po::ProjectedBlock receivers = blockOf({ { 4, 4, -100, 1, 3 }, { 9, 9, -100, 1, 4 },
    { 9, 9, 0.99f, 1, 5 }, { 9, 9, 1.01f, 1, 6 }, { 2, 2, 3.99f, 1, 7 }, { 2, 2, 4.01f, 1, 8 } });
  EXPECT_EQ(cells.hidden(receivers).upward, 0b010001u);
  cells.close(blockOf({ { 12, 12, 2, 12, 2 } }));
  cells.finish();
  EXPECT_EQ(cells.hidden(receivers).upward, 0b010111u);
  EXPECT_EQ(cells.hidden(receivers).downward, 0u);
}

/// Tests points of receivers that face the light against the spheres that close cells, one by one.
/// @return of 1000 receivers those that closed cells hide
int countHidden(float smallestRadius, float largestRadius)
{
  po::Random random(7, 1, 0);
  const auto number = [&](double low, double high)
  { return static_cast<float>(low + (high - low) * random.uniform()); };
  std::vector<po::ProjectedSphere> closers;
  po::ClosedCells cells;
  cells.begin({ 0, 0, 6, 6 }, smallestRadius, largestRadius);
  for (unsigned i = 0; i < 400; ++i)
  {
    closers.push_back(
      { number(-1, 7), number(-1, 7), number(2, 4), number(smallestRadius, largestRadius), i });
    cells.close(blockOf({ closers.back() }));
  }
  cells.finish();
  int told = 0;
  for (int trial = 0; trial < 1000; ++trial)
  {
    const po::ProjectedSphere receiver{ number(0, 6), number(0, 6), number(-1, 3),
      number(smallestRadius, largestRadius), 0 };
    const bool hidden = cells.hidden(blockOf({ receiver })).upward != 0;
    told += hidden ? 1 : 0;
    for (int point = 0; hidden && point < 200; ++point)
    {
      const double angle = 2 * po::Pi * random.uniform();
      const double across = receiver.radius * std::sqrt(random.uniform());
      const double x = receiver.x + across * std::cos(angle);
      const double y = receiver.y + across * std::sin(angle);
      const double z =
        receiver.z + std::sqrt(receiver.radius * double(receiver.radius) - across * across);
      EXPECT_TRUE(std::any_of(closers.begin(), closers.end(),
        [=](const po::ProjectedSphere& s)
        { return std::hypot(x - s.x, y - s.y) < s.radius && z < s.z + 1e-5f; }));
    }
  }
  return told;
}

TEST(ClosedCells, OnlyWhatIsHiddenEverywhereIsTold)
{
  for (const float smallestRadius : { 1.0f, 0.995f, 0.5f })
  {
    const int told = countHidden(smallestRadius, 1);
    EXPECT_GT(told, 200) << smallestRadius;
    EXPECT_LT(told, 900) << smallestRadius;
  }
}

TEST(BlockProjection, AgreesWithDoublePrecision)
{
  const po::SphereSet set(syntheticScene(po::SyntheticFamily::Gas, 1000));
  const po::SweepScene scene(set);
  const po::Vec3d axis = po::normalized(po::Vec3d{ 1, -2, 3 });
  const po::PlaneBasis basis = po::planeBasis(axis);
  const po::BlockProjection projection(scene, axis, basis);
  const po::Vec3d origin{ 1, 2, 3 };
  po::ProjectedBlock projected;
  std::size_t count = 0;
  for (const po::SweepScene::Block& block : scene.blocks())
  {
    const bool whole = block.last - block.first == po::SweepScene::BlockSize;
    const po::BlockBits wanted = whole ? 0xF00000000000FFFF : 1;
    projection.project(block, wanted, origin, projected);
    ASSERT_EQ(projected.count, whole ? 20u : 1u);
    for (std::size_t i = 0; i < projected.count; ++i)
    {
      const unsigned index = block.first + static_cast<unsigned>(i < 16 ? i : 60 + i - 16);
      EXPECT_EQ(projected.index[i], index);
      EXPECT_EQ(projected.radius[i], scene.sphere(index).radius);
      const po::Vec3d offset = scene.center(index) - origin;
      const double rounding = 3e-7 * po::length(offset);
      EXPECT_NEAR(projected.x[i], po::dot(offset, basis.x), rounding);
      EXPECT_NEAR(projected.y[i], po::dot(offset, basis.y), rounding);
      EXPECT_NEAR(projected.z[i], po::dot(offset, axis), rounding);
      const po::Vec3f middle = projection.project(block.middle, origin);
      EXPECT_LE(std::abs(projected.x[i] - middle.x), projection.reachX(block) + rounding);
      EXPECT_LE(std::abs(projected.y[i] - middle.y), projection.reachY(block) + rounding);
      ++count;
    }
  }
  EXPECT_GE(count, 300u);
}
}
