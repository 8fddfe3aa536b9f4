// SPDX-License-Identifier: BSD-3-Clause
/// What a sweep projects, and what it leaves out at once.

#include "BlockProjection.h"
#include "ClosedCells.h"
#include "Constants.h"
#include "EstimateDifference.h"
#include "Random.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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
  cells.begin({ 0, 0, 1, 1 }, 1);
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
  cells.begin({ 0, 0, 8, 8 }, 1);
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
  cells.begin({ 0, 0, 6, 6 }, largestRadius);
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
  for (const float smallestRadius : { 1.0f, 0.995f, 0.5f, 0.1f })
  {
    const int told = countHidden(smallestRadius, 1);
    EXPECT_GT(told, 200) << smallestRadius;
    EXPECT_LT(told, 900) << smallestRadius;
  }
}

/// Closed cells of a square patch at the origin, one by one in double precision.
class PlainCells
{
public:
  PlainCells(double width, double reach)
    : reach_(reach)
    , cell_(reach / po::ClosedCells::CellsPerReach * (1 + 1e-4))
    , side_(static_cast<int>(std::ceil((width + 8 * reach) / cell_)))
    , heights_(static_cast<std::size_t>(side_ * side_), -HUGE_VAL)
  {
  }

  /// Closes the cells of which a disc covers all corners.
  void close(double x, double y, double height, double radius)
  {
    for (int row = 0; row < side_; ++row)
    {
      for (int column = 0; column < side_; ++column)
      {
        const bool covered = std::hypot(farther(x, column), farther(y, row)) <= radius;
        double& known = heights_[static_cast<std::size_t>(row * side_ + column)];
        known = covered ? std::max(known, height) : known;
      }
    }
  }

  /// Up to which height all points of a receiver are hidden.
  [[nodiscard]] double around(double x, double y) const
  {
    constexpr int reach = po::ClosedCells::CellsPerReach;
    const auto cellAt = [this](double place) { return static_cast<int>((place - low()) / cell_); };
    double lowest = HUGE_VAL;
    for (int i = -reach; i <= reach; ++i)
    {
      for (int j = -reach; j <= reach; ++j)
      {
        const int place = (cellAt(y) + i) * side_ + cellAt(x) + j;
        lowest = std::min(lowest, heights_[static_cast<std::size_t>(place)] + drop(i) + drop(j));
      }
    }
    return lowest;
  }

private:
  [[nodiscard]] double low() const { return -4 * reach_; }
  [[nodiscard]] double farther(double place, int cell) const
  {
    const double edge = low() + cell * cell_;
    return std::max(std::abs(place - edge), std::abs(place - edge - cell_));
  }
  [[nodiscard]] double drop(int cells) const
  {
    const double gap = std::max(std::abs(cells) - 1, 0) * cell_;
    return gap * gap / (2 * reach_);
  }

  double reach_, cell_;
  int side_;
  std::vector<double> heights_;
};

struct RandomDiscs
{
  int count;
  double largest; ///< their radii are down to a hundredth of it
  std::uint64_t seed;
};

/// Asks up to which height random discs hide receivers of radius 1 in a square patch: plain cells
/// tell of discs that are a little smaller, and a little larger.
void expectPlainCells(const RandomDiscs& discs)
{
  constexpr double width = 6;
  constexpr double rounding = 1e-4;
  po::Random random(discs.seed, 1, 0);
  const auto number = [&](double low, double high)
  { return low + (high - low) * random.uniform(); };
  po::ClosedCells cells;
  cells.begin({ 0, 0, width, width }, 1);
  PlainCells fewer(width, 1);
  PlainCells more(width, 1);
  for (int i = 0; i < discs.count; ++i)
  {
    const double x = number(-discs.largest - 2, width + discs.largest + 2);
    const double y = number(-discs.largest - 2, width + discs.largest + 2);
    const double z = number(0, 4);
    const double radius = discs.largest * std::pow(0.01, random.uniform() * random.uniform());
    cells.close(blockOf({ { float(x), float(y), float(z), float(radius), 0 } }));
    fewer.close(x, y, z, radius - rounding);
    more.close(x, y, z, radius + rounding);
  }
  cells.finish();
  constexpr int receivers = 1000;
  int hidden = 0;
  int exact = 0;
  for (int i = 0; i < receivers; ++i)
  {
    const double x = number(-2, width + 2);
    const double y = number(-2, width + 2);
    const auto isHidden = [&](double top) {
      return cells.hidden(blockOf({ { float(x), float(y), float(top - 1), 1, 0 } })).upward != 0;
    };
    const double least = std::max(fewer.around(x, y), -100.0);
    const double most = std::max(more.around(x, y), -100.0);
    EXPECT_TRUE(least == -100 || isHidden(least - rounding)) << x << ' ' << y << ' ' << least;
    EXPECT_FALSE(isHidden(most + rounding)) << x << ' ' << y << ' ' << most;
    hidden += least > -100 ? 1 : 0;
    exact += least == most ? 1 : 0;
  }
  EXPECT_GT(hidden, receivers / 50);
  EXPECT_GT(exact, receivers * 9 / 10);
}

TEST(ClosedCells, CellsThatOneDiscCoversAreClosedAndNoOthers)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    expectPlainCells({ 1500, 1, 0 }); // the smallest ones cover no cell
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
      expectPlainCells({ 20, 6, seed }); // larger than receivers, and beyond the edge
    }
  }
  hwy::SetSupportedTargetsForTest(0);
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
