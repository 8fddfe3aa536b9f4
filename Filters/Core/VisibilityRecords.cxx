// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityRecords.h"

#include "TexelMask.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace po
{
namespace
{
constexpr std::uint8_t Listed = 1;
constexpr std::uint8_t Watched = 2;

/// Caps of less than this share of the sphere are no overlaps: touching spheres have such by
/// rounding. Their points count as outside, which changes a mean by no more than that share.
constexpr double SmallestCap = 1e-5;

/// Keeps the bits of exposed points; false if none is left.
bool clearUnexposed(const GroupMask* exposed, const FacingTexels& facing, GroupMask* mask)
{
  unsigned left = 0;
  for (std::size_t g = 0; g < facing.groups(); ++g)
  {
    mask[g] = static_cast<GroupMask>(mask[g] & exposed[facing.group[g]]);
    left |= mask[g];
  }
  return left != 0;
}
}

VisibilityRecords::VisibilityRecords(const BakeScene& scene, const SweepTexels& texels,
  std::uint64_t seed, std::vector<std::uint8_t> listed, const std::vector<unsigned>& watched)
  : scene_(scene)
  , texels_(texels)
  , seed_(seed)
  , patterns_(texels, seed, 0)
  , listed_(std::move(listed))
  , records_(listed_.size())
  , whole_(listed_.size())
{
  open_.total.assign(texels.slots(), 0.0f);
  open_.subsets.assign(SweepSubsets * texels.slots(), 0.0f);
  open_.pastPatterns.assign(TexelPatterns::Count * texels.slots(), 0.0f);
  open_.latestPatterns.assign(TexelPatterns::Count * texels.slots(), 0.0f);
  for (const unsigned particle : watched)
  {
    listed_[particle] |= Watched;
  }
}

VisibilityRecords::~VisibilityRecords() = default;

bool VisibilityRecords::clearInside(
  unsigned particle, std::size_t pattern, const FacingTexels& facing, GroupMask* mask)
{
  if (listed_[particle] == 0)
  {
    return true; // only occludes: what shows of it inside others hides nothing that is outside
  }
  if (whole_[particle].load(std::memory_order_relaxed) != 0)
  {
    return true;
  }
  const VisibilityRecord& record = findOrMake(particle);
  if (!record.buried && record.caps.empty())
  {
    whole_[particle].store(1, std::memory_order_relaxed);
    return true;
  }
  if (record.buried || record.exposure.bits.empty())
  {
    return !record.buried;
  }
  return clearUnexposed(record.exposure.ofPattern(pattern, texels_.groups()), facing, mask);
}

void VisibilityRecords::keep(
  unsigned particle, std::size_t index, const FacingTexels& facing, const GroupMask* mask)
{
  if (listed_[particle] != 0)
  {
    VisibilityRecord& record = findOrMake(particle);
    std::copy(mask, mask + facing.groups(), record.masks.data() + index * texels_.groups());
    record.seen[index] = 1;
  }
}

VisibilityRecord& VisibilityRecords::findOrMake(unsigned particle)
{
  VisibilityRecord* known = records_[particle].load(std::memory_order_acquire);
  if (known != nullptr)
  {
    return *known;
  }
  // Two threads may make the same record at once; both are equal, and one is dropped.
  std::unique_ptr<VisibilityRecord> made = make(particle);
  if (records_[particle].compare_exchange_strong(known, made.get(), std::memory_order_acq_rel))
  {
    known = made.get();
    owned_.push_back(std::move(made));
  }
  return *known;
}

std::unique_ptr<VisibilityRecord> VisibilityRecords::make(unsigned particle) const
{
  auto record = std::make_unique<VisibilityRecord>();
  record->particle = particle;
  record->watched = (listed_[particle] & Watched) != 0;
  Overlaps overlaps;
  scene_.overlaps.find(particle, overlaps);
  record->buried = overlaps.buried;
  if (record->buried)
  {
    return record;
  }
  record->sums.assign(texels_.slots(), 0.0f);
  record->masks.assign(SweepBlock * texels_.groups(), 0);
  if (record->watched)
  {
    record->subsetSums.assign(SweepSubsets * texels_.slots(), 0.0f);
  }
  overlaps.caps.erase(std::remove_if(overlaps.caps.begin(), overlaps.caps.end(),
                        [](const BuriedCap& cap) { return (1 - cap.cosine) / 2 < SmallestCap; }),
    overlaps.caps.end());
  if (!overlaps.caps.empty())
  {
    record->caps = std::move(overlaps.caps);
    record->exposure = exposeTexels(texels_, patterns_, record->caps);
    record->pastWeights.assign(texels_.slots(), 0.0f);
    addPatternWeights(*record, open_.pastPatterns, record->pastWeights);
  }
  return record;
}

void VisibilityRecords::addMasks(
  VisibilityRecord& record, const std::vector<FacingTexels>& directions, std::size_t subset) const
{
  for (std::size_t index = 0; index < directions.size(); ++index)
  {
    if (record.seen[index] == 0)
    {
      continue;
    }
    record.seen[index] = 0;
    const GroupMask* mask = record.masks.data() + index * texels_.groups();
    addWeights(directions[index], mask, record.sums.data());
    if (record.watched)
    {
      addWeights(directions[index], mask, record.subsetSums.data() + subset * texels_.slots());
    }
  }
}

void VisibilityRecords::addBlock(const std::vector<FacingTexels>& directions,
  const std::vector<std::size_t>& patterns, std::size_t subset)
{
  for (std::size_t index = 0; index < directions.size(); ++index)
  {
    const FacingTexels& facing = directions[index];
    addWeights(facing, facing.facing.data(), open_.total.data());
    addWeights(facing, facing.facing.data(), open_.subsets.data() + subset * texels_.slots());
    addWeights(facing, facing.facing.data(),
      open_.latestPatterns.data() + patterns[index] * texels_.slots());
  }
  tbb::parallel_for(std::size_t(0), owned_.size(),
    [&](std::size_t i) { addMasks(*owned_[i], directions, subset); });
}

void VisibilityRecords::addPatternWeights(const VisibilityRecord& record,
  const std::vector<float>& patternWeights, std::vector<float>& sums) const
{
  const std::size_t groups = texels_.groups();
  const bool allOutside = record.exposure.bits.empty();
  const std::vector<GroupMask> all(allOutside ? groups : 0, AllOfGroup);
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    const GroupMask* exposed = allOutside ? all.data() : record.exposure.ofPattern(p, groups);
    addMasked(groups, exposed, patternWeights.data() + p * texels_.slots(), sums.data());
  }
}

void VisibilityRecords::nextEpoch()
{
  patterns_ = TexelPatterns(texels_, seed_, ++epoch_);
  tbb::parallel_for(std::size_t(0), owned_.size(),
    [&](std::size_t i)
    {
      VisibilityRecord& record = *owned_[i];
      if (!record.caps.empty())
      {
        addPatternWeights(record, open_.latestPatterns, record.pastWeights);
        record.exposure = exposeTexels(texels_, patterns_, record.caps);
      }
    });
  std::transform(open_.pastPatterns.begin(), open_.pastPatterns.end(), open_.latestPatterns.begin(),
    open_.pastPatterns.begin(), std::plus<>());
  std::fill(open_.latestPatterns.begin(), open_.latestPatterns.end(), 0.0f);
}

std::vector<float> VisibilityRecords::outsideWeights(const VisibilityRecord& record) const
{
  if (record.caps.empty())
  {
    return open_.total;
  }
  std::vector<float> weights = record.pastWeights;
  addPatternWeights(record, open_.latestPatterns, weights);
  for (std::size_t slot = 0; slot < weights.size(); ++slot)
  {
    // A texel that no rim crosses: the same sum in another order. Take the one that `sums` is
    // compared with, so that an open texel is exactly 1.
    const float total = open_.total[slot];
    weights[slot] = weights[slot] > total * (1 - 1e-4f) ? total : weights[slot];
  }
  return weights;
}

std::uint64_t VisibilityRecords::buried() const
{
  return static_cast<std::uint64_t>(
    std::count_if(owned_.begin(), owned_.end(), [](const auto& record) { return record->buried; }));
}
}
