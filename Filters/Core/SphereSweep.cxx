// SPDX-License-Identifier: BSD-3-Clause
#include "SphereSweep.h"

#include "Random.h"
#include "Sampling.h"
#include "SweepDirections.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <hwy/base.h>

namespace po
{
namespace
{
/// Directions between two changes of the points in the texels: each point serves two axes.
constexpr int EpochDirections = 4 * static_cast<int>(TexelPatterns::Count);

constexpr std::size_t FirstBlock = 2; ///< axes

/// All spheres take part in the first directions. After them, spheres that were never seen take
/// part along one axis of each block only. One that shows along few axes may miss others up to its
/// first sight: with half as many full directions that is measurable.
constexpr int FullDirections = 32;

/// Closed cells must spare this share of all visits, or they cost more than they save; more where
/// offset masks make a visit cheap.
constexpr double WorthwhileShare = 0.15;
constexpr double WorthwhileWithMasks = 0.45;

bool equalRadii(const SweepScene::Band& band)
{
  return band.largestRadius <= band.smallestRadius * (1 + 1e-6f);
}

/// A bit for each sphere for which wanted(sphere) is true, by block.
template <typename Wanted>
std::vector<BlockBits> bitsOf(const SweepScene& scene, const Wanted& wanted)
{
  std::vector<BlockBits> bits(scene.blocks().size(), 0);
  for (std::size_t i = 0; i < bits.size(); ++i)
  {
    const SweepScene::Block& block = scene.blocks()[i];
    for (unsigned sphere = block.first; sphere < block.last; ++sphere)
    {
      bits[i] |= BlockBits(wanted(sphere) ? 1 : 0) << (sphere - block.first);
    }
  }
  return bits;
}

std::size_t countBits(const std::vector<BlockBits>& bits)
{
  return std::accumulate(bits.begin(), bits.end(), std::size_t(0),
    [](std::size_t sum, BlockBits block) { return sum + hwy::PopCount(block); });
}
}

SphereSweep::SphereSweep(const SweepScene& scene, const Background& background, float distance,
  VisibilityRecords& records, const SweepSkips& skips, const std::vector<std::uint8_t>& alone,
  const ProcessGroup& group, AxisWays ways)
  : scene_(scene)
  , background_(background)
  , distance_(distance)
  , records_(records)
  , skips_(skips)
  , ways_(ways)
  , useOffsetMasks_(skips.offsetMasks && scene.bands().size() == 1 &&
      equalRadii(scene.bands().front()) && OffsetMasks::fits(records.texels()) &&
      !std::isfinite(distance))
  , closedCellsPay_{ skips.closedCells && !std::isfinite(distance),
    skips.closedCells && !std::isfinite(distance) }
  , everSeen_(scene.size())
  , tileSweeps_(
      [this, &records] { return TileWorkspace(records, division_ ? &*division_ : nullptr); })
{
  if (group.size() > 1 && !std::isfinite(distance))
  {
    division_.emplace(group, records);
  }
  allBits_ = bitsOf(scene, [&alone](unsigned sphere) { return alone[sphere] == 0; });
  seenBits_.assign(allBits_.size(), 0);
  all_ = countBits(allBits_);
}

void SphereSweep::run(
  const std::vector<Vec3d>& axes, Progress& progress, std::optional<std::size_t> subset)
{
  for (std::size_t first = 0; first < axes.size() && !progress.aborted();)
  {
    const std::size_t last = std::min(first + blockSize(), axes.size());
    sweepBlock({ axes.begin() + static_cast<std::ptrdiff_t>(first),
                 axes.begin() + static_cast<std::ptrdiff_t>(last) },
      subset.value_or(blocks_ % ErrorSubsets), progress);
    first = last;
  }
}

void SphereSweep::end()
{
  threads_ = threads();
  counted_ = { counters(false), counters(true) };
  tileSweeps_.clear();
  workspaces_.clear();
  everSeen_ = decltype(everSeen_)();
  allBits_ = seenBits_ = {};
}

/// A small block shows soon whether closed cells are worth their cost.
std::size_t SphereSweep::blockSize() const
{
  return blocks_ == 0 ? FirstBlock : (blocks_ == 1 ? AxesPerBlock - FirstBlock : AxesPerBlock);
}

void SphereSweep::sweepBlock(const std::vector<Vec3d>& axes, std::size_t subset, Progress& progress)
{
  for (; epoch_ < directions_ / EpochDirections; ++epoch_)
  {
    records_.nextEpoch();
  }
  std::vector<AxisJob> jobs;
  std::vector<AxisWeights> weights;
  const std::size_t full = fullAxis(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    jobs.push_back(makeJob(axes[i], i, i == full));
    weights.push_back(weightsOf(jobs.back()));
    progress.advance((2 - jobs.back().directions.size()) * scene_.size());
  }
  tbb::parallel_for(
    std::size_t(0), jobs.size(), [&](std::size_t i) { sweepAxis(jobs[i], progress); });
  if (progress.aborted())
  {
    return;
  }
  if (division_)
  {
    division_->deliver(weights, everSeen_);
  }
  records_.addBlock(weights, subset);
  for (const AxisJob& job : jobs)
  {
    neverSeen_ += job.full || !job.own ? 0 : job.directions.size() * (scene_.size() - seen_);
  }
  directions_ += static_cast<int>(2 * axes.size());
  ++blocks_;
  finishBlock();
}

/// The axis of a block along which all spheres take part whatever was seen. It is drawn at random:
/// axes at the same place in their blocks all lie in one band of heights.
std::size_t SphereSweep::fullAxis(std::size_t axes) const
{
  Random random(mixBits(blocks_), axes, 0);
  return random.below(static_cast<std::uint32_t>(axes));
}

SphereSweep::AxisJob SphereSweep::makeJob(Vec3d axis, std::size_t index, bool always)
{
  const bool full =
    always || directions_ < FullDirections || std::isfinite(distance_) || !skips_.neverSeen;
  AxisJob job{ axis, planeBasis(axis), patternTurns_.next(), full, true, {},
    closedCellsPay_[full ? 1 : 0] };
  for (const bool upward : { true, false })
  {
    if (!upward && ways_ == AxisWays::Forward)
    {
      continue;
    }
    const Vec3d towardsLight = upward ? axis : -axis;
    const double light = luminance(background_, towardsLight);
    if (light <= 0 && skips_.blackSky)
    {
      ++blackDirections_;
      continue;
    }
    job.directions.push_back(
      { FacingTexels(records_.texels(), records_.patterns(), job.pattern, job.basis, towardsLight),
        light, nullptr, job.pattern, index, distance_, upward, full });
  }
  job.own = !division_ || division_->isOwn(sweptAxes_);
  sweptAxes_ += job.directions.empty() ? 0 : 1;
  return job;
}

AxisWeights SphereSweep::weightsOf(const AxisJob& job) const
{
  AxisWeights weights{ job.pattern, std::vector<GroupMask>(records_.texels().groups(), 0), {},
    std::vector<float>(records_.texels().slots(), 0.0f) };
  for (const SweptDirection& direction : job.directions)
  {
    weights.facing[direction.upward ? 1 : 0] = direction.facing.facing;
    for (std::size_t slot = 0; slot < weights.weight.size(); ++slot)
    {
      const GroupMask bit = static_cast<GroupMask>(1u << (slot % GroupSize));
      GroupMask& lit = weights.lit[slot / GroupSize];
      if ((direction.facing.facing[slot / GroupSize] & bit) != 0)
      {
        lit = static_cast<GroupMask>(lit | bit);
        weights.weight[slot] =
          static_cast<float>(direction.luminance * static_cast<double>(direction.facing.w[slot]));
      }
    }
  }
  return weights;
}

void SphereSweep::finishBlock()
{
  const std::vector<BlockBits> known = std::exchange(seenBits_,
    bitsOf(scene_,
      [this](unsigned sphere) { return everSeen_[sphere].load(std::memory_order_relaxed) != 0; }));
  seen_ = countBits(seenBits_);
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    for (BlockBits bits = seenBits_[i] & ~known[i]; bits != 0; bits &= bits - 1)
    {
      records_.markSeen(
        scene_.blocks()[i].first + static_cast<unsigned>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
    }
  }
  // The first block shows whether closed cells are worth their cost where all spheres take part,
  // the first partial one where the buried ones are left out.
  const bool firstPartial = directions_ == FullDirections + 2 * static_cast<int>(AxesPerBlock);
  if (blocks_ == 1 || firstPartial)
  {
    judgeClosedCells(blocks_ == 1);
  }
}

void SphereSweep::judgeClosedCells(bool full)
{
  SweepCounters sum = counters(full);
  if (division_)
  {
    for (std::uint64_t* number : { &sum.visits, &sum.closed })
    {
      *number = division_->sum(*number);
    }
  }
  const auto spared = static_cast<double>(sum.closed);
  const auto all = static_cast<double>(sum.visits + sum.closed);
  bool& pay = closedCellsPay_[full ? 1 : 0];
  pay = pay && spared > (useOffsetMasks_ ? WorthwhileWithMasks : WorthwhileShare) * all;
  // Without the buried ones less is spared.
  closedCellsPay_[0] = closedCellsPay_[0] && closedCellsPay_[1];
}

SweepCounters SphereSweep::counters(bool full) const
{
  SweepCounters sum = counted_[full ? 1 : 0];
  for (const TileWorkspace& work : tileSweeps_)
  {
    sum.visits += work.sweep.visits(full);
  }
  for (const Workspace& work : workspaces_)
  {
    sum.closed += work.closed[full ? 1 : 0];
  }
  return sum;
}

SweepParticipants SphereSweep::participants(const AxisJob& job) const
{
  std::uint8_t directions = 0;
  for (const SweptDirection& direction : job.directions)
  {
    directions = static_cast<std::uint8_t>(directions | direction.bit());
  }
  return { job.full ? allBits_ : seenBits_, seenBits_, directions, std::isfinite(distance_),
    job.useClosedCells };
}

void SphereSweep::buildOffsetMasks(AxisJob& job, Workspace& work) const
{
  Random random(mixBits(static_cast<std::uint64_t>(directions_)), job.directions.front().axis, 0);
  for (std::size_t i = 0; i < job.directions.size(); ++i)
  {
    const auto shiftX = static_cast<float>(random.uniform());
    const auto shiftY = static_cast<float>(random.uniform());
    const auto shiftZ = static_cast<float>(random.uniform());
    work.offsetMasks[i].build(job.directions[i].facing, shiftX, shiftY, shiftZ);
    job.directions[i].offsetMasks = &work.offsetMasks[i];
  }
}

void SphereSweep::sweepAxis(AxisJob& job, Progress& progress)
{
  if (!job.own)
  {
    progress.advance(job.directions.size() * scene_.size());
  }
  if (job.directions.empty() || !job.own)
  {
    return;
  }
  Workspace& work = workspaces_.local();
  work.seen.assign(scene_.size(), 0);
  if (useOffsetMasks_)
  {
    buildOffsetMasks(job, work);
  }
  const BlockProjection projection(scene_, job.axis, job.basis);
  TileFiller filler(scene_, projection, participants(job), work.cells);
  for (const SweepScene::Band& band : scene_.bands())
  {
    sweepBand(band, job, filler, work, progress);
    if (progress.aborted())
    {
      return;
    }
  }
  work.closed[job.full ? 1 : 0] += filler.closed();
  for (std::size_t i = 0; i < work.seen.size(); ++i)
  {
    if (work.seen[i] != 0)
    {
      everSeen_[i].store(1, std::memory_order_relaxed);
    }
  }
  progress.advance(job.directions.size() * (scene_.size() - (job.full ? all_ : seen_)));
}

void SphereSweep::sweepBand(const SweepScene::Band& band, const AxisJob& job, TileFiller& filler,
  Workspace& work, Progress& progress)
{
  const ReceiverExtent extent = filler.extentOf(band);
  work.tiles.layOut(extent, band.largestRadius);
  const std::size_t patches = work.tiles.patches();
  const auto workUpTo = [&](std::size_t patch)
  { return extent.count * job.directions.size() * patch / patches; };
  for (std::size_t patch = 0; patch < patches && !progress.aborted(); ++patch)
  {
    work.tiles.begin(patch);
    filler.fill(band, work.seen, work.tiles);
    work.tiles.sortIntoTiles();
    sweepTiles(band, job, work, progress);
    progress.advance(workUpTo(patch + 1) - workUpTo(patch));
  }
}

void SphereSweep::sweepTiles(
  const SweepScene::Band& band, const AxisJob& job, Workspace& work, Progress& progress)
{
  const auto sweepTile = [&](std::size_t index)
  {
    const DepthTile tile = work.tiles.tile(index);
    if (tile.size() == 0 || progress.aborted())
    {
      return;
    }
    TileWorkspace& tileWork = tileSweeps_.local();
    tileWork.order.begin(tile);
    for (const SweptDirection& direction : job.directions)
    {
      tileWork.sweep.run(tile, tileWork.order, band, direction, work.seen);
    }
  };
  // A thread that waits for tiles must not begin another axis in the same workspace.
  tbb::this_task_arena::isolate(
    [&] { tbb::parallel_for(std::size_t(0), work.tiles.size(), sweepTile); });
}
}
