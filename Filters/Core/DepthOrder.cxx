// SPDX-License-Identifier: BSD-3-Clause
#include "DepthOrder.h"

#include <algorithm>
#include <cstring>

namespace po
{
namespace
{
constexpr std::size_t SpheresPerSlab = 8;

/// Sorts as the height does and, among equal heights, as the place does.
std::uint64_t makeKey(float z, std::size_t place)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &z, sizeof(bits));
  // Floats sort like integers once negative ones are inverted.
  const std::uint32_t height = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
  return std::uint64_t(height) << 32 | place;
}

void insertionSort(std::uint64_t* first, std::uint64_t* last)
{
  for (std::uint64_t* i = first + 1; i < last; ++i)
  {
    const std::uint64_t key = *i;
    std::uint64_t* hole = i;
    for (; hole > first && hole[-1] > key; --hole)
    {
      *hole = hole[-1];
    }
    *hole = key;
  }
}
}

void DepthOrder::begin(const DepthTile& tile)
{
  spheres_ = tile.first;
  const std::size_t count = tile.size();
  const std::size_t slabs = count / SpheresPerSlab + 1;
  float low = tile.first->sphere.z;
  float high = low;
  for (const TileSphere* s = tile.first; s != tile.last; ++s)
  {
    low = std::min(low, s->sphere.z);
    high = std::max(high, s->sphere.z);
  }
  const float perSlab = high > low ? static_cast<float>(slabs) / (high - low) : 0.0f;
  starts_.assign(slabs + 1, 0);
  slabOf_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto slab = static_cast<std::uint32_t>((tile.first[i].sphere.z - low) * perSlab);
    slabOf_[i] = std::min(slab, static_cast<std::uint32_t>(slabs - 1));
    ++starts_[slabOf_[i] + 1];
  }
  for (std::size_t slab = 0; slab < slabs; ++slab)
  {
    starts_[slab + 1] += starts_[slab];
  }
  next_.assign(starts_.begin(), starts_.end() - 1);
  keys_.resize(count);
  ordered_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    keys_[next_[slabOf_[i]]++] = makeKey(tile.first[i].sphere.z, i);
  }
  sorted_.assign(slabs, 0);
}

void DepthOrder::sort(std::size_t slab)
{
  constexpr std::ptrdiff_t few = 32;
  std::uint64_t* first = keys_.data() + starts_[slab];
  std::uint64_t* last = keys_.data() + starts_[slab + 1];
  if (last - first <= few)
  {
    insertionSort(first, last);
  }
  else
  {
    std::sort(first, last);
  }
  // Spheres lie all over the tile: fetched together, they wait for memory together.
  std::transform(first, last, ordered_.begin() + starts_[slab],
    [this](std::uint64_t key) { return spheres_[key & 0xFFFFFFFFu]; });
}

DepthOrder::Slab DepthOrder::slab(std::size_t index)
{
  if (sorted_[index] == 0)
  {
    sorted_[index] = 1;
    sort(index);
  }
  return { ordered_.data() + starts_[index], ordered_.data() + starts_[index + 1] };
}
}
