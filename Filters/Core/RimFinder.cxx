// SPDX-License-Identifier: BSD-3-Clause
#include "RimFinder.h"

#include "TexelCaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace po
{
namespace
{
constexpr std::uint32_t Unlisted = std::numeric_limits<std::uint32_t>::max();

template <typename T>
const T* copied(std::pmr::memory_resource& memory, const T* first, std::size_t count)
{
  auto* copy = static_cast<T*>(memory.allocate(count * sizeof(T), alignof(T)));
  std::copy_n(first, count, copy);
  return copy;
}

/// Of the half angle.
float sineOf(const RimCap& cap)
{
  const auto cosine = static_cast<double>(cap.cosine);
  return static_cast<float>(std::sqrt((1 - cosine) * (1 + cosine)));
}
}

RimCap rimCapOf(const BuriedCap& cap)
{
  return { cap.axis.as<float>(), static_cast<float>(cap.cosine) };
}

void RimFinder::Candidates::resize(std::size_t most)
{
  caps.resize(most);
  parts.resize(most);
}

unsigned RimFinder::Candidates::select(const Candidates& others, unsigned discs)
{
  // Which are taken can not be foretold: no branches.
  unsigned all = 0;
  count = 0;
  for (std::size_t i = 0; i < others.count; ++i)
  {
    const unsigned part = others.parts[i] & discs;
    all |= part;
    caps[count] = others.caps[i];
    count += part != 0 ? 1 : 0;
  }
  return all;
}

TexelRims RimFinder::find(const SweepTexels& texels, const std::vector<BuriedCap>& caps)
{
  begin(texels, caps);
  for (std::size_t block = 0; block * GroupSize < texels.groups(); ++block)
  {
    findInBlock(texels, block);
  }
  return { outside_.data(), rims_.data(), rims_.size(), capOf_.data(), caps_.data() };
}

void RimFinder::begin(const SweepTexels& texels, const std::vector<BuriedCap>& caps)
{
  all_.resize(caps.size());
  std::transform(caps.begin(), caps.end(), all_.begin(), rimCapOf);
  sines_.resize(caps.size());
  std::transform(all_.begin(), all_.end(), sines_.begin(), sineOf);
  for (Candidates* candidates : { &every_, &near_, &crossing_ })
  {
    candidates->resize(caps.size());
  }
  every_.count = caps.size();
  std::iota(every_.caps.begin(), every_.caps.end(), 0u);
  places_.assign(caps.size(), Unlisted);
  used_.clear();
  outside_ = texels.allBits();
  rims_.clear();
  capOf_.clear();
  caps_.clear();
}

/// @return the discs that one of the candidates covers
unsigned RimFinder::classify(
  const TexelDiscs& discs, std::size_t group, Candidates& candidates) const
{
  const std::uint32_t* first = candidates.caps.data();
  return classifyCaps(discs, group, { all_.data(), first, first + candidates.count }, sines_.data(),
    candidates.parts.data());
}

/// Many caps cover a whole group, or do not touch it: told for many groups at once.
void RimFinder::findInBlock(const SweepTexels& texels, std::size_t block)
{
  const unsigned covered = classify(texels.groupDiscs(), block, every_);
  const std::size_t first = block * GroupSize;
  for (std::size_t i = 0; i < std::min(GroupSize, texels.groups() - first); ++i)
  {
    const unsigned disc = 1u << i;
    if ((covered & disc) != 0)
    {
      outside_[first + i] = 0;
    }
    else if (near_.select(every_, disc) != 0)
    {
      findInGroup(texels, first + i);
    }
  }
}

/// Lists the caps whose rims cross texels of the group that are not inside.
void RimFinder::findInGroup(const SweepTexels& texels, std::size_t group)
{
  const unsigned covered = classify(texels.discs(), group, near_);
  outside_[group] = static_cast<GroupMask>(outside_[group] & ~covered);
  const unsigned crossed = crossing_.select(near_, outside_[group]);
  if (crossed == 0)
  {
    return;
  }
  for (std::size_t i = 0; i < crossing_.count; ++i)
  {
    capOf_.push_back(placeOf(crossing_.caps[i]));
  }
  rims_.push_back({ static_cast<std::uint16_t>(group), static_cast<GroupMask>(crossed),
    static_cast<std::uint32_t>(capOf_.size()) });
}

/// Of a cap among those that are listed; lists it if it is not.
std::uint32_t RimFinder::placeOf(std::uint32_t cap)
{
  if (places_[cap] == Unlisted)
  {
    places_[cap] = static_cast<std::uint32_t>(caps_.size());
    caps_.push_back(all_[cap]);
    used_.push_back(cap);
  }
  return places_[cap];
}

const TexelRims* copyTo(
  std::pmr::memory_resource& memory, const TexelRims& rims, std::size_t groups)
{
  std::size_t caps = 0;
  const std::size_t places = rims.firstCap(rims.count);
  for (std::size_t i = 0; i < places; ++i)
  {
    caps = std::max<std::size_t>(caps, rims.capOf[i] + 1);
  }
  // Side by side, in the order in which they are looked at.
  auto* copy = new (memory.allocate(sizeof(TexelRims), alignof(TexelRims))) TexelRims;
  copy->outside = copied(memory, rims.outside, groups);
  copy->rims = copied(memory, rims.rims, rims.count);
  copy->count = rims.count;
  copy->capOf = copied(memory, rims.capOf, places);
  copy->caps = copied(memory, rims.caps, caps);
  return copy;
}
}
