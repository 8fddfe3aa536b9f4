// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityRecords.h"

#include "MaskedSums.h"

#include <hwy/cache_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

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
  , patterns_(texels, seed, 0)
  , surface_(order.size())
  , cuts_(order.size())
  , exposures_(order.size())
  , chunks_((countSet(listed) + ChunkSpheres - 1) / ChunkSpheres)
  , watched_(ChunkSpheres * chunks_.size(), 0)
  , log_(std::move(log))
{
  open_.total.assign(texels.slots(), 0.0f);
  open_.subsets.assign(ErrorSubsets * texels.slots(), 0.0f);
  open_.pastPatterns.assign(TexelPatterns::Count * texels.slots(), 0.0f);
  open_.latestPatterns.assign(TexelPatterns::Count * texels.slots(), 0.0f);
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

void VisibilityRecords::prefetch(unsigned sphere, std::size_t pattern) const
{
  if (const GroupMask* bits = exposures_[sphere].load(std::memory_order_relaxed))
  {
    hwy::Prefetch(bits + pattern * texels_.groups());
  }
}

bool VisibilityRecords::clearInside(unsigned sphere, std::size_t pattern, GroupMask* mask)
{
  const GroupMask* bits = exposures_[sphere].load(std::memory_order_acquire);
  if (bits == nullptr)
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
    bits = exposures_[sphere].load(std::memory_order_acquire);
  }
  return intersect(texels_.groups(), bits + pattern * texels_.groups(), mask);
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
    // Two threads may make the same at once; both are equal, and one is dropped.
    std::unique_ptr<CutSphere> made = makeCut(sphere, overlaps.caps);
    CutSphere* cut = nullptr;
    if (cuts_[sphere].compare_exchange_strong(cut, made.get(), std::memory_order_acq_rel))
    {
      cut = made.get();
      ownedCuts_.push_back(std::move(made));
    }
    // Both publish the bits: the thread that came second may go on before the first one does.
    exposures_[sphere].store(cut->exposure.bits.data(), std::memory_order_release);
  }
  surface_[sphere].store(surface, std::memory_order_release);
  return surface;
}

std::unique_ptr<CutSphere> VisibilityRecords::makeCut(
  unsigned sphere, const std::vector<BuriedCap>& caps)
{
  std::unique_ptr<CutSphere> cut(
    new CutSphere{ sphere, caps, TexelExposure(memory_.ofThread()), {} });
  exposeTexels(texels_, patterns_, cut->caps, cut->exposure);
  if (epoch_ > 0)
  {
    cut->pastWeights.assign(cut->exposure.rimGroups.size() * GroupSize, 0.0f);
    addOverPoints(*cut, open_.pastPatterns, cut->pastWeights.data());
  }
  return cut;
}

float* VisibilityRecords::makeSums(std::size_t count)
{
  const std::size_t size = count * texels_.slots();
  auto* sums = memory_.allocate<float>(size);
  std::fill(sums, sums + size, 0.0f);
  return sums;
}

VisibilityRecords::Chunk& VisibilityRecords::findOrMakeChunk(unsigned place)
{
  std::atomic<Chunk*>& chunk = chunks_[place / ChunkSpheres];
  Chunk* known = chunk.load(std::memory_order_acquire);
  if (known != nullptr)
  {
    return *known;
  }
  // Two threads may make the same at once; both are equal, and one is not used.
  Chunk* made = new (memory_.allocate<Chunk>(1)) Chunk{ makeSums(ChunkSpheres),
    memory_.allocate<GroupMask>(AxesPerBlock * ChunkSpheres * texels_.groups()) };
  return *(chunk.compare_exchange_strong(known, made, std::memory_order_acq_rel) ? made : known);
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
  Chunk& chunk = findOrMakeChunk(placeOf_[sphere]);
  const std::size_t place = placeOf_[sphere] % ChunkSpheres;
  const std::size_t groups = texels_.groups();
  GroupMask* kept = chunk.masks + (axis * ChunkSpheres + place) * groups;
  if (chunk.seen[axis][place] == 0)
  {
    chunk.seen[axis][place] = 1;
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
      open_.latestPatterns[TexelPatterns::index(axis.pattern, slot)] += axis.weight[slot];
    }
  }
  if (log_)
  {
    log_->endBlock(axes, subset);
    return;
  }
  tbb::parallel_for(std::size_t(0), chunks_.size(),
    [&](std::size_t i)
    {
      if (chunks_[i].load(std::memory_order_relaxed) != nullptr)
      {
        addChunk(i, axes, subset);
      }
    });
}

void VisibilityRecords::addChunk(
  std::size_t index, const std::vector<AxisWeights>& axes, std::size_t subset)
{
  Chunk& chunk = *chunks_[index].load(std::memory_order_relaxed);
  const std::size_t groups = texels_.groups();
  for (std::size_t place = 0; place < ChunkSpheres; ++place)
  {
    std::array<MaskedTerms, AxesPerBlock> terms;
    std::size_t count = 0;
    for (std::size_t k = 0; k < axes.size(); ++k)
    {
      if (chunk.seen[k][place] != 0)
      {
        chunk.seen[k][place] = 0;
        terms[count++] = { chunk.masks + (k * ChunkSpheres + place) * groups,
          axes[k].weight.data() };
      }
    }
    if (count == 0)
    {
      continue;
    }
    chunk.everSeen[place] = 1;
    addMasked(groups, terms.data(), count, chunk.sums + place * texels_.slots());
    if (watched_[index * ChunkSpheres + place] != 0)
    {
      float*& sums = chunk.subsets[place];
      sums = sums != nullptr ? sums : makeSums(ErrorSubsets);
      addMasked(groups, terms.data(), count, sums + subset * texels_.slots());
    }
  }
}

void VisibilityRecords::addOverPoints(
  const CutSphere& cut, const std::vector<float>& terms, float* sums) const
{
  const TexelExposure& exposure = cut.exposure;
  for (std::size_t i = 0; i < exposure.rimGroups.size(); ++i)
  {
    const std::uint32_t g = exposure.rimGroups[i];
    po::addOverPoints(exposure.bits.data() + g, texels_.groups(),
      terms.data() + TexelPatterns::index(0, g * GroupSize), sums + i * GroupSize);
  }
}

void VisibilityRecords::nextEpoch()
{
  patterns_ = TexelPatterns(texels_, seed_, ++epoch_);
  tbb::parallel_for(std::size_t(0), ownedCuts_.size(),
    [&](std::size_t i)
    {
      CutSphere& cut = *ownedCuts_[i];
      cut.pastWeights.resize(cut.exposure.rimGroups.size() * GroupSize, 0.0f);
      addOverPoints(cut, open_.latestPatterns, cut.pastWeights.data());
      exposeTexels(texels_, patterns_, cut.caps, cut.exposure);
    });
  std::transform(open_.pastPatterns.begin(), open_.pastPatterns.end(), open_.latestPatterns.begin(),
    open_.pastPatterns.begin(), std::plus<>());
  std::fill(open_.latestPatterns.begin(), open_.latestPatterns.end(), 0.0f);
}

const VisibilityRecords::Chunk* VisibilityRecords::chunkIfSeen(unsigned sphere) const
{
  if (!isListed(sphere))
  {
    return nullptr;
  }
  const unsigned place = placeOf_[sphere];
  const Chunk* chunk = chunks_[place / ChunkSpheres].load(std::memory_order_acquire);
  return chunk != nullptr && chunk->everSeen[place % ChunkSpheres] != 0 ? chunk : nullptr;
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
  const Chunk* chunk = chunkIfSeen(sphere);
  return chunk != nullptr ? chunk->sums + placeOf_[sphere] % ChunkSpheres * texels_.slots()
                          : nullptr;
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
  const Chunk* chunk = chunkIfSeen(sphere);
  return chunk != nullptr ? chunk->subsets[placeOf_[sphere] % ChunkSpheres] : nullptr;
}

const CutSphere* VisibilityRecords::cut(unsigned sphere) const
{
  return cuts_[sphere].load(std::memory_order_acquire);
}

std::vector<float> VisibilityRecords::outsideWeights(const CutSphere& cut) const
{
  const TexelExposure& exposure = cut.exposure;
  std::vector<float> weights(texels_.slots(), 0.0f);
  addMasked(texels_.groups(), exposure.ofPattern(0, 0), open_.total.data(), weights.data());
  std::vector<float> rim = cut.pastWeights;
  rim.resize(exposure.rimGroups.size() * GroupSize, 0.0f);
  addOverPoints(cut, open_.latestPatterns, rim.data());
  for (std::size_t i = 0; i < rim.size(); ++i)
  {
    const std::size_t slot = exposure.rimGroups[i / GroupSize] * GroupSize + i % GroupSize;
    // A texel that no rim crosses: the same sum in another order. Keep the one that the sums are
    // compared with, so that an open texel is exactly 1.
    const bool whole = rim[i] > open_.total[slot] * (1 - 1e-4f);
    weights[slot] = whole ? open_.total[slot] : rim[i];
  }
  return weights;
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
