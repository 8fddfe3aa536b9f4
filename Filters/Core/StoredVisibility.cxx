// SPDX-License-Identifier: BSD-3-Clause
#include "StoredVisibility.h"

#include "MaskedSums.h"
#include "TextureFormula.h"

#include <hwy/cache_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace po
{
StoredVisibility::StoredVisibility(
  const SweepTexels& texels, std::vector<std::uint8_t> watched, RecordMemory& memory)
  : groups_(texels.groups())
  , slots_(texels.slots())
  , watched_(std::move(watched))
  , memory_(memory)
  , chunks_((watched_.size() + ChunkPlaces - 1) / ChunkPlaces)
{
}

void StoredVisibility::prefetch(std::size_t place, std::size_t axis) const
{
  if (Chunk* chunk = chunks_[place / ChunkPlaces].load(std::memory_order_acquire))
  {
    hwy::Prefetch(&chunk->seen[axis]);
    hwy::Prefetch(chunk->masks() + maskAt(place, axis));
  }
}

void StoredVisibility::keep(std::size_t place, std::size_t axis, const GroupMask* mask)
{
  Chunk& chunk = findOrMakeChunk(place);
  GroupMask* kept = chunk.masks() + maskAt(place, axis);
  std::uint8_t& seen = chunk.seen[axis][place % ChunkPlaces];
  if (seen == 0)
  {
    seen = 1;
    std::copy(mask, mask + groups_, kept);
    return;
  }
  for (std::size_t g = 0; g < groups_; ++g)
  {
    kept[g] = static_cast<GroupMask>(kept[g] | mask[g]);
  }
}

StoredVisibility::Chunk& StoredVisibility::findOrMakeChunk(std::size_t place)
{
  std::atomic<Chunk*>& chunk = chunks_[place / ChunkPlaces];
  Chunk* known = chunk.load(std::memory_order_acquire);
  if (known != nullptr)
  {
    return *known;
  }
  // Two threads may make the same at once; both are equal, and one is not used.
  const std::size_t masks = AxesPerBlock * ChunkPlaces * groups_ * sizeof(GroupMask);
  const std::size_t size = 1 + (masks + sizeof(Chunk) - 1) / sizeof(Chunk);
  Chunk* made = new (memory_.allocate<Chunk>(size)) Chunk;
  return *(chunk.compare_exchange_strong(known, made, std::memory_order_acq_rel) ? made : known);
}

float* StoredVisibility::makeSums(bool watched)
{
  const std::size_t size = (watched ? 1 + ErrorSubsets : 1) * slots_;
  auto* sums = memory_.allocate<float>(size);
  std::fill(sums, sums + size, 0.0f);
  return sums;
}

void StoredVisibility::addBlock(const std::vector<AxisWeights>& axes, std::size_t subset)
{
  tbb::parallel_for(std::size_t(0), chunks_.size(),
    [&](std::size_t chunk)
    {
      if (chunks_[chunk].load(std::memory_order_relaxed) != nullptr)
      {
        addChunk(chunk, axes, subset);
      }
    });
}

void StoredVisibility::addChunk(
  std::size_t index, const std::vector<AxisWeights>& axes, std::size_t subset)
{
  Chunk& chunk = *chunks_[index].load(std::memory_order_relaxed);
  const std::size_t first = index * ChunkPlaces;
  const std::size_t last = std::min(first + ChunkPlaces, watched_.size());
  for (std::size_t place = first; place < last; ++place)
  {
    std::array<MaskedTerms, AxesPerBlock> terms;
    std::size_t count = 0;
    for (std::size_t k = 0; k < axes.size(); ++k)
    {
      std::uint8_t& seen = chunk.seen[k][place - first];
      if (seen != 0)
      {
        seen = 0;
        terms[count++] = { chunk.masks() + maskAt(place, k), axes[k].weight.data() };
      }
    }
    if (count == 0)
    {
      continue;
    }
    const bool watched = watched_[place] != 0;
    float*& sums = chunk.sums[place - first];
    sums = sums != nullptr ? sums : makeSums(watched);
    addMasked(groups_, terms.data(), count, sums);
    if (watched)
    {
      addMasked(groups_, terms.data(), count, sums + (1 + subset) * slots_);
    }
  }
}

const float* StoredVisibility::sums(std::size_t place) const
{
  const Chunk* chunk = chunks_[place / ChunkPlaces].load(std::memory_order_acquire);
  return chunk != nullptr ? chunk->sums[place % ChunkPlaces] : nullptr;
}

const float* StoredVisibility::subsetSums(std::size_t place) const
{
  const float* all = sums(place);
  return all != nullptr ? all + slots_ : nullptr;
}
}
