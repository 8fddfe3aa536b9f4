// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityRecords.h"

#include "HeapMemory.h"
#include "MaskedSums.h"
#include "RimFinder.h"
#include "TexelCaps.h"

#include <algorithm>
#include <utility>

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
}

VisibilityRecords::VisibilityRecords(const BakeScene& scene, const SweepScene& order,
  const SweepTexels& texels, std::uint64_t seed, const std::vector<std::uint8_t>& listed,
  const std::vector<std::uint8_t>& alone, const std::vector<unsigned>& watched,
  std::unique_ptr<LoggedVisibility> log)
  : scene_(scene)
  , order_(order)
  , texels_(texels)
  , seed_(seed)
  , spheres_(log ? 0 : order.size())
  , surfaces_(log ? order.size() : 0)
  , wasSeen_(log ? order.size() : 0, 0)
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
    const Surface known = alone[sphere] != 0 ? Surface::Alone : Surface::Unknown;
    surfaceOf(sphere) = order.source(sphere) < scene.receivers() ? known : Surface::Occluder;
    if (!log_)
    {
      spheres_[sphere].place = listed[sphere] != 0 ? places++ : NoPlace;
    }
  }
  if (log_)
  {
    compactRims_ = std::make_unique<CompactRims>(scene.set(), texels, order.size());
  }
  else
  {
    std::vector<std::uint8_t> isWatched(places, 0);
    for (const unsigned sphere : watched)
    {
      isWatched[spheres_[sphere].place] = 1;
    }
    stored_ = std::make_unique<StoredVisibility>(texels, std::move(isWatched), memory_);
  }
}

void VisibilityRecords::prefetchRims(unsigned sphere) const
{
  if (compactRims_)
  {
    compactRims_->prefetch(sphere);
  }
  else if (const TexelRims* rims = spheres_[sphere].rims.load(std::memory_order_relaxed))
  {
    hwy::Prefetch(rims);
    hwy::Prefetch(reinterpret_cast<const char*>(rims) + 64);
  }
}

void VisibilityRecords::prefetchResult(unsigned sphere) const
{
  constexpr std::size_t line = 64;      // bytes
  constexpr std::size_t mostRims = 384; // mostly these are fewer
  const auto fetch = [](const void* first, std::size_t bytes)
  {
    for (std::size_t at = 0; first != nullptr && at < bytes; at += line)
    {
      hwy::Prefetch(static_cast<const char*>(first) + at);
    }
  };
  const float* seen = sums(sphere);
  fetch(seen, texels_.slots() * sizeof(float));
  if (seen != nullptr && !log_)
  {
    fetch(spheres_[sphere].rims.load(std::memory_order_relaxed), mostRims);
  }
}

bool VisibilityRecords::clearCovered(unsigned sphere, GroupMask* mask)
{
  if (compactRims_)
  {
    return wasSeen_[sphere] == 0 || !findCompactRims(sphere) ||
      compactRims_->clearCovered(sphere, mask);
  }
  const TexelRims* known = spheres_[sphere].wasSeen ? findRims(sphere) : nullptr;
  if (known == nullptr)
  {
    return true;
  }
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
  return true;
}

void VisibilityRecords::prefetchMasks(unsigned sphere, std::size_t axis) const
{
  if (stored_ && isListed(sphere))
  {
    stored_->prefetch(spheres_[sphere].place, axis);
  }
}

bool VisibilityRecords::clearInside(unsigned sphere, std::size_t pattern, GroupMask* mask)
{
  if (compactRims_)
  {
    return findCompactRims(sphere)
      ? compactRims_->clearInside(sphere, order_.source(sphere), patterns(), pattern, mask)
      : surface(sphere) != Surface::Buried;
  }
  if (const TexelRims* known = findRims(sphere))
  {
    return po::clearInside(patterns(), pattern, *known, mask);
  }
  // What shows of one that only occludes inside others hides nothing that is outside.
  return surface(sphere) != Surface::Buried;
}

/// Null where nothing cuts a sphere.
const TexelRims* VisibilityRecords::findRims(unsigned sphere)
{
  const TexelRims* known = rims(sphere);
  if (known != nullptr ||
    spheres_[sphere].surface.load(std::memory_order_acquire) != Surface::Unknown)
  {
    // Another thread may have found them in between: rims are there before the surface is known.
    return known != nullptr ? known : rims(sphere);
  }
  findSurface(sphere);
  return rims(sphere);
}

/// Does anything cut a sphere? Out of core.
bool VisibilityRecords::findCompactRims(unsigned sphere)
{
  if (!compactRims_->isListed(sphere) &&
    surfaceOf(sphere).load(std::memory_order_acquire) == Surface::Unknown)
  {
    findSurface(sphere);
  }
  return compactRims_->isListed(sphere);
}

void VisibilityRecords::learn(unsigned sphere, Surface surface)
{
  if (surfaceOf(sphere).load(std::memory_order_relaxed) != Surface::Unknown)
  {
    return;
  }
  if (surface == Surface::Whole || surface == Surface::Buried)
  {
    surfaceOf(sphere).store(surface, std::memory_order_release);
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
    keepRims(sphere, overlaps.caps);
  }
  surfaceOf(sphere).store(surface, std::memory_order_release);
  return surface;
}

void VisibilityRecords::keepRims(unsigned sphere, const std::vector<BuriedCap>& caps)
{
  if (compactRims_)
  {
    compactRims_->keep(sphere, order_.source(sphere), caps);
    return;
  }
  thread_local RimFinder finder;
  const TexelRims* known = nullptr;
  // Two threads may make the same at once; both are equal, and one is not used.
  const TexelRims* made = copyTo(*memory_.ofThread(), finder.find(texels_, caps), texels_.groups());
  spheres_[sphere].rims.compare_exchange_strong(known, made, std::memory_order_acq_rel);
}

void VisibilityRecords::keep(
  unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask)
{
  if (!isListed(sphere))
  {
    return;
  }
  if (log_)
  {
    log_->keep(sphere, axis, upward, facing, mask);
    return;
  }
  stored_->keep(spheres_[sphere].place, axis, mask);
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
  stored_->addBlock(axes, subset);
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
  return isListed(sphere) ? stored_->sums(spheres_[sphere].place) : nullptr;
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
  return isListed(sphere) ? stored_->subsetSums(spheres_[sphere].place) : nullptr;
}

const TexelRims* VisibilityRecords::rims(unsigned sphere) const
{
  if (compactRims_)
  {
    return compactRims_->find(sphere, order_.source(sphere));
  }
  if (!loggedRims_)
  {
    return spheres_[sphere].rims.load(std::memory_order_acquire);
  }
  const auto watched = watchedRims_.find(sphere);
  if (watched != watchedRims_.end())
  {
    return watched->second;
  }
  return loggedRims_->find(log_->placeInPart(sphere));
}

void VisibilityRecords::end(const std::vector<unsigned>& list, const std::vector<unsigned>& watched)
{
  if (!compactRims_)
  {
    return;
  }
  for (const unsigned sphere : watched)
  {
    const TexelRims* known = rims(sphere);
    watchedRims_[sphere] =
      known != nullptr ? copyTo(watchedMemory_, *known, texels_.groups()) : nullptr;
  }
  auto logged = std::make_unique<LoggedRims>(texels_.groups(), log_->placesPerPart());
  for (const unsigned sphere : list)
  {
    // Of spheres that were not seen they are not looked at.
    logged->append(wasSeen_[sphere] != 0 ? rims(sphere) : nullptr);
  }
  loggedRims_ = std::move(logged);
  compactRims_.reset();
  log_->endSweep();
}

std::size_t VisibilityRecords::loadFor(std::size_t place) const
{
  if (!log_)
  {
    return std::numeric_limits<std::size_t>::max();
  }
  const std::size_t before = log_->part();
  const std::size_t count = log_->loadFor(place);
  if (loggedRims_ && log_->part() != before)
  {
    loggedRims_->load(log_->part());
    returnFreeMemory(); // tables that grow leave much behind
  }
  return count;
}

bool VisibilityRecords::isBuried(unsigned sphere) const
{
  return surfaceOf(sphere).load(std::memory_order_acquire) == Surface::Buried;
}

bool VisibilityRecords::isAlone(unsigned sphere) const
{
  return surfaceOf(sphere).load(std::memory_order_relaxed) == Surface::Alone;
}

std::uint64_t VisibilityRecords::countListed(Surface surface) const
{
  std::uint64_t count = 0;
  for (unsigned sphere = 0; sphere < spheres(); ++sphere)
  {
    count += isListed(sphere) && surfaceOf(sphere).load(std::memory_order_relaxed) == surface;
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
