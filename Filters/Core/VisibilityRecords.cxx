// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityRecords.h"

#include "MaskedSums.h"
#include "RimFinder.h"
#include "TexelCaps.h"

#include <hwy/cache_control.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace po
{
namespace
{
/// Caps of less than this share of the sphere are no overlaps: touching spheres have such by
/// rounding. Their points count as outside, which changes a mean by no more than that share.
constexpr double SmallestCap = 1e-5;

bool isSliver(const BuriedCap& cap)
{
  return (1 - cap.cosine) / 2 < SmallestCap;
}

std::size_t countSet(const std::vector<std::uint8_t>& flags)
{
  return static_cast<std::size_t>(
    std::count_if(flags.begin(), flags.end(), [](std::uint8_t flag) { return flag != 0; }));
}
}

VisibilityRecords::VisibilityRecords(const BakeScene& scene, const SweepScene& order,
  const SweepTexels& texels, std::uint64_t seed, const std::vector<std::uint8_t>& listed,
  const std::vector<std::uint8_t>& alone, const std::vector<unsigned>& watched,
  std::unique_ptr<LoggedVisibility> log)
  : scene_(scene)
  , order_(order)
  , texels_(texels)
  , seed_(seed)
  , placeOf_(order.size(), NoPlace)
  , surface_(order.size())
  , rims_(order.size())
  , records_(log ? 0 : countSet(listed))
  , watched_(countSet(listed), 0)
  , log_(std::move(log))
{
  open_.total.assign(texels.slots(), 0.0f);
  open_.subsets.assign(ErrorSubsets * texels.slots(), 0.0f);
  beginEpoch();
  unsigned places = 0;
  // Particles that are not listed are looked at all the same: what they hide must not depend on who
  // asks.
  for (unsigned sphere = 0; sphere < order.size(); ++sphere)
  {
    placeOf_[sphere] = listed[sphere] != 0 ? places++ : NoPlace;
    const Surface known = alone[sphere] != 0 ? Surface::Alone : Surface::Unknown;
    surface_[sphere] = order.source(sphere) < scene.receivers() ? known : Surface::Occluder;
  }
  for (const unsigned sphere : watched)
  {
    watched_[placeOf_[sphere]] = 1;
  }
}

void VisibilityRecords::prefetch(unsigned sphere) const
{
  if (const TexelRims* rims = rims_[sphere].load(std::memory_order_relaxed))
  {
    hwy::Prefetch(rims);
    hwy::Prefetch(reinterpret_cast<const char*>(rims) + 64);
  }
  if (!log_)
  {
    hwy::Prefetch(&placeOf_[sphere]);
  }
}

bool VisibilityRecords::clearCovered(unsigned sphere, GroupMask* mask) const
{
  const TexelRims* known = rims(sphere);
  if (known != nullptr && known->areToldApart())
  {
    if (!intersect(texels_.groups(), known->outside, mask))
    {
      return false;
    }
    hwy::Prefetch(known->rims);
    hwy::Prefetch(known->rims + 8);
    hwy::Prefetch(known->capOf);
    hwy::Prefetch(known->capOf + 16);
    hwy::Prefetch(known->caps);
    hwy::Prefetch(known->caps + 4);
  }
  return true;
}

void VisibilityRecords::prefetchMasks(unsigned sphere, std::size_t axis) const
{
  if (const Record* record = log_ ? nullptr : recordOf(sphere))
  {
    hwy::Prefetch(record);
    hwy::Prefetch(reinterpret_cast<const GroupMask*>(record + 1) + axis * texels_.groups());
  }
}

bool VisibilityRecords::clearInside(unsigned sphere, std::size_t pattern, GroupMask* mask)
{
  const TexelRims* known = rims(sphere);
  if (known == nullptr)
  {
    Surface surface = surface_[sphere].load(std::memory_order_acquire);
    if (surface == Surface::Unknown)
    {
      surface = findSurface(sphere);
    }
    if (surface != Surface::Cut)
    {
      // What shows of one that only occludes inside others hides nothing that is outside.
      return surface != Surface::Buried;
    }
    known = rims(sphere);
  }
  return po::clearInside(patterns(), pattern, *known, mask);
}

void VisibilityRecords::learn(unsigned sphere, Surface surface)
{
  if (surface_[sphere].load(std::memory_order_relaxed) != Surface::Unknown)
  {
    return;
  }
  if (surface == Surface::Whole || surface == Surface::Buried)
  {
    surface_[sphere].store(surface, std::memory_order_release);
  }
  else if (surface == Surface::Cut && isListed(sphere))
  {
    findSurface(sphere);
  }
}

VisibilityRecords::Surface VisibilityRecords::findSurface(unsigned sphere)
{
  thread_local Overlaps overlaps;
  scene_.overlaps.find(order_.source(sphere), overlaps);
  Surface surface = overlaps.buried ? Surface::Buried : Surface::Whole;
  overlaps.caps.erase(
    std::remove_if(overlaps.caps.begin(), overlaps.caps.end(), isSliver), overlaps.caps.end());
  if (!overlaps.buried && !overlaps.caps.empty())
  {
    surface = Surface::Cut;
    thread_local RimFinder finder;
    std::pmr::memory_resource& memory = *memory_.ofThread();
    const TexelRims* known = nullptr;
    // Two threads may make the same at once; both are equal, and one is not used.
    const TexelRims* made = copyTo(memory, finder.list(overlaps.caps), texels_.groups());
    rims_[sphere].compare_exchange_strong(known, made, std::memory_order_acq_rel);
  }
  surface_[sphere].store(surface, std::memory_order_release);
  return surface;
}

float* VisibilityRecords::makeSums(std::size_t count)
{
  const std::size_t size = count * texels_.slots();
  auto* sums = memory_.allocate<float>(size);
  std::fill(sums, sums + size, 0.0f);
  return sums;
}

/// Most spheres that are looked at show points inside others alone; only for those that are seen it
/// is worth while to tell texels apart.
void VisibilityRecords::tellTexelsApart(unsigned sphere)
{
  const TexelRims* known = rims(sphere);
  if (known == nullptr || known->areToldApart())
  {
    return;
  }
  // Two threads may do the same at once; it does not matter whose result stays.
  thread_local RimFinder finder;
  std::pmr::memory_resource& memory = *memory_.ofThread();
  rims_[sphere].store(
    copyTo(memory, finder.find(texels_, *known), texels_.groups()), std::memory_order_release);
}

VisibilityRecords::Record& VisibilityRecords::findOrMakeRecord(unsigned place)
{
  std::atomic<Record*>& record = records_[place];
  Record* known = record.load(std::memory_order_acquire);
  if (known != nullptr)
  {
    return *known;
  }
  // Two threads may make the same at once; both are equal, and one is not used.
  Record* made = new (memory_.allocate<Record>(1))
    Record{ memory_.allocate<GroupMask>(AxesPerBlock * texels_.groups()), makeSums(1),
      watched_[place] != 0 ? makeSums(ErrorSubsets) : nullptr };
  return *(record.compare_exchange_strong(known, made, std::memory_order_acq_rel) ? made : known);
}

void VisibilityRecords::keep(
  unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask)
{
  tellTexelsApart(sphere);
  if (!isListed(sphere))
  {
    return;
  }
  if (log_)
  {
    log_->keep(sphere, axis, upward, facing, mask);
    return;
  }
  Record& record = findOrMakeRecord(placeOf_[sphere]);
  const std::size_t groups = texels_.groups();
  GroupMask* kept = record.masks + axis * groups;
  if (record.seen[axis] == 0)
  {
    record.seen[axis] = 1;
    std::copy(mask, mask + groups, kept);
    return;
  }
  for (std::size_t g = 0; g < groups; ++g)
  {
    kept[g] = static_cast<GroupMask>(kept[g] | mask[g]);
  }
}

void VisibilityRecords::addBlock(const std::vector<AxisWeights>& axes, std::size_t subset)
{
  for (const AxisWeights& axis : axes)
  {
    const MaskedTerms terms{ axis.lit.data(), axis.weight.data() };
    addMasked(texels_.groups(), &terms, 1, open_.total.data());
    addMasked(texels_.groups(), &terms, 1, open_.subsets.data() + subset * texels_.slots());
    for (std::size_t slot = 0; slot < texels_.slots(); ++slot)
    {
      epochs_[epoch_].weights[TexelPatterns::index(axis.pattern, slot)] += axis.weight[slot];
    }
  }
  if (log_)
  {
    log_->endBlock(axes, subset);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, records_.size(), 64),
    [&](const tbb::blocked_range<std::size_t>& places)
    {
      constexpr std::size_t ahead = 4;
      for (std::size_t place = places.begin(); place != places.end(); ++place)
      {
        prefetchRecord(std::min(place + ahead, places.end() - 1));
        if (Record* record = records_[place].load(std::memory_order_relaxed))
        {
          addTo(*record, axes, subset);
        }
      }
    });
}

void VisibilityRecords::prefetchRecord(std::size_t place) const
{
  if (const Record* record = records_[place].load(std::memory_order_relaxed))
  {
    hwy::Prefetch(record);
    hwy::Prefetch(record->sums);
    hwy::Prefetch(record->masks);
  }
}

void VisibilityRecords::addTo(
  Record& record, const std::vector<AxisWeights>& axes, std::size_t subset) const
{
  const std::size_t groups = texels_.groups();
  std::array<MaskedTerms, AxesPerBlock> terms;
  std::size_t count = 0;
  for (std::size_t k = 0; k < axes.size(); ++k)
  {
    if (record.seen[k] != 0)
    {
      record.seen[k] = 0;
      terms[count++] = { record.masks + k * groups, axes[k].weight.data() };
    }
  }
  if (count > 0)
  {
    addMasked(groups, terms.data(), count, record.sums);
  }
  if (count > 0 && record.subsets != nullptr)
  {
    addMasked(groups, terms.data(), count, record.subsets + subset * texels_.slots());
  }
}

void VisibilityRecords::nextEpoch()
{
  epoch_ = (epoch_ + 1) % MostEpochs;
  if (epoch_ == epochs_.size())
  {
    beginEpoch();
  }
}

void VisibilityRecords::beginEpoch()
{
  epochs_.push_back({ TexelPatterns(texels_, seed_, static_cast<std::uint32_t>(epochs_.size())),
    std::vector<float>(TexelPatterns::Count * texels_.slots(), 0.0f) });
}

const VisibilityRecords::Record* VisibilityRecords::recordOf(unsigned sphere) const
{
  return isListed(sphere) ? records_[placeOf_[sphere]].load(std::memory_order_acquire) : nullptr;
}

const float* VisibilityRecords::sums(unsigned sphere) const
{
  if (isAlone(sphere))
  {
    return open_.total.data();
  }
  if (log_)
  {
    return log_->sums(sphere);
  }
  const Record* record = recordOf(sphere);
  return record != nullptr ? record->sums : nullptr;
}

const float* VisibilityRecords::subsetSums(unsigned sphere) const
{
  if (isAlone(sphere))
  {
    return open_.subsets.data();
  }
  if (log_)
  {
    return log_->subsetSums(sphere);
  }
  const Record* record = recordOf(sphere);
  return record != nullptr ? record->subsets : nullptr;
}

const TexelRims* VisibilityRecords::rims(unsigned sphere) const
{
  return rims_[sphere].load(std::memory_order_acquire);
}

bool VisibilityRecords::isBuried(unsigned sphere) const
{
  return surface_[sphere].load(std::memory_order_acquire) == Surface::Buried;
}

bool VisibilityRecords::isAlone(unsigned sphere) const
{
  return surface_[sphere].load(std::memory_order_relaxed) == Surface::Alone;
}

std::uint64_t VisibilityRecords::countListed(Surface surface) const
{
  std::uint64_t count = 0;
  for (unsigned sphere = 0; sphere < placeOf_.size(); ++sphere)
  {
    count += isListed(sphere) && surface_[sphere].load(std::memory_order_relaxed) == surface;
  }
  return count;
}

std::uint64_t VisibilityRecords::alone() const
{
  return countListed(Surface::Alone);
}

std::uint64_t VisibilityRecords::buried() const
{
  return countListed(Surface::Buried);
}
}
