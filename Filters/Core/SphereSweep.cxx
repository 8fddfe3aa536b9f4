// SPDX-License-Identifier: BSD-3-Clause
#include "SphereSweep.h"

#include "SweepDirections.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace po
{
namespace
{
/// Directions between two changes of the points in the texels: each point serves four of them.
constexpr int EpochDirections = 4 * static_cast<int>(TexelPatterns::Count);
static_assert(EpochDirections % SweepBlock == 0);

/// After the first block, spheres that were never visible take part in every eighth direction only.
/// A sphere that shows in few directions may miss the others up to its first sight: at most about 8
/// directions' light, 8 / D of what a direction shows of it.
constexpr std::size_t FullEvery = 8;
}

SphereSweep::SphereSweep(
  const BakeScene& scene, const Background& background, float distance, VisibilityRecords& records)
  : scene_(scene)
  , background_(background)
  , distance_(distance)
  , records_(records)
  , octaves_(scene.rays.spheres())
  , everVisible_(scene.rays.spheres().size())
  , workspaces_([&records] { return Workspace(records); })
{
}

void SphereSweep::run(const std::vector<Vec3d>& directions, Progress& progress)
{
  std::vector<Direction> block;
  for (std::size_t i = 0; i < directions.size() && !progress.aborted(); ++i)
  {
    const double light = luminance(background_, directions[i]);
    if (light > 0)
    {
      block.push_back({ directions[i], light });
    }
    else
    {
      progress.advance(scene_.rays.spheres().size());
    }
    if (block.size() == SweepBlock || (i + 1 == directions.size() && !block.empty()))
    {
      sweepBlock(block, progress);
      block.clear();
    }
  }
}

void SphereSweep::sweepBlock(const std::vector<Direction>& block, Progress& progress)
{
  if (directions_ > 0 && directions_ % EpochDirections == 0)
  {
    records_.nextEpoch();
  }
  std::vector<std::size_t> patterns;
  std::vector<FacingTexels> facing;
  for (std::size_t i = 0; i < block.size(); ++i)
  {
    patterns.push_back((static_cast<std::size_t>(directions_) + i) % TexelPatterns::Count);
    facing.emplace_back(records_.texels(), records_.patterns(), patterns[i], block[i].towardsLight,
      block[i].luminance);
  }
  tbb::parallel_for(std::size_t(0), block.size(),
    [&](std::size_t i)
    {
      const bool full = directions_ == 0 || i % FullEvery == 0 || std::isfinite(distance_);
      sweepDirection(
        block[i].towardsLight, { facing[i], patterns[i], i, distance_ }, full, progress);
    });
  if (progress.aborted())
  {
    return;
  }
  const std::size_t subset = static_cast<std::size_t>(directions_) / SweepBlock % SweepSubsets;
  records_.addBlock(facing, patterns, subset);
  visible_.clear();
  for (unsigned id = 0; id < everVisible_.size(); ++id)
  {
    if (everVisible_[id].load(std::memory_order_relaxed) != 0)
    {
      visible_.push_back(id);
    }
  }
  directions_ += static_cast<int>(block.size());
}

void SphereSweep::project(Vec3d towardsLight, bool full, Workspace& work)
{
  const PlaneBasis basis = planeBasis(towardsLight);
  const std::vector<Sphere>& spheres = scene_.rays.spheres();
  work.projected.clear();
  const auto add = [&](unsigned id)
  {
    const Sphere& s = spheres[id];
    const Vec3d c = s.center().as<double>();
    work.projected.push_back(
      { static_cast<float>(dot(c, basis.x)), static_cast<float>(dot(c, basis.y)),
        static_cast<float>(dot(c, towardsLight)), s.radius, id });
  };
  if (full)
  {
    for (unsigned id = 0; id < spheres.size(); ++id)
    {
      add(id);
    }
  }
  else
  {
    std::for_each(visible_.begin(), visible_.end(), add);
  }
}

void SphereSweep::sweepDirection(
  Vec3d towardsLight, const SweptDirection& direction, bool full, Progress& progress)
{
  Workspace& work = workspaces_.local();
  project(towardsLight, full, work);
  work.hidden.assign(everVisible_.size(), 0);
  std::uint64_t reported = 0;
  for (std::size_t octave = 0; octave < octaves_.size(); ++octave)
  {
    work.tiles.build(work.projected, octaves_, octave, work.hidden);
    for (std::size_t i = 0; i < work.tiles.size(); ++i)
    {
      const DepthTile tile = work.tiles.tile(i);
      work.tileSweep.run(tile, octaves_.largestRadius(octave), direction, work.hidden);
      const auto receivers = static_cast<std::uint64_t>(std::count_if(
        tile.first, tile.last, [](const TileSphere& s) { return s.role == TileRole::Receiver; }));
      reported += receivers;
      if (!progress.advance(receivers))
      {
        return;
      }
    }
  }
  for (const ProjectedSphere& s : work.projected)
  {
    if (work.hidden[s.id] == 0)
    {
      everVisible_[s.id].store(1, std::memory_order_relaxed);
    }
  }
  progress.advance(everVisible_.size() - reported); // those that were skipped
}
}
