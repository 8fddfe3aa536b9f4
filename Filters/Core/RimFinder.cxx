// SPDX-License-Identifier: BSD-3-Clause
#include "RimFinder.h"

#include "TexelCaps.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
}

RimCap rimCapOf(const BuriedCap& cap)
{
  return { cap.axis.as<float>(), static_cast<float>(cap.cosine) };
}

TexelRims RimFinder::find(const SweepTexels& texels, const std::vector<BuriedCap>& caps)
{
  all_.resize(caps.size());
  std::transform(caps.begin(), caps.end(), all_.begin(), rimCapOf);
  classify(texels);
  listByGroup();
  return { outside_.data(), rims_.data(), rims_.size(), capOf_.data(), caps_.data() };
}

void RimFinder::classify(const SweepTexels& texels)
{
  const std::size_t groups = texels.groups();
  outside_ = texels.allBits();
  covered_.resize(groups);
  parts_.resize(all_.size() * groups);
  for (std::size_t i = 0; i < all_.size(); ++i)
  {
    const auto cosine = static_cast<double>(all_[i].cosine);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    classifyCap(texels.discs(), all_[i].axis, all_[i].cosine, static_cast<float>(sine),
      covered_.data(), parts_.data() + i * groups);
    for (std::size_t g = 0; g < groups; ++g)
    {
      outside_[g] = static_cast<GroupMask>(outside_[g] & ~covered_[g]);
    }
  }
}

/// Lists, group by group, the caps whose rims cross texels that are not inside.
void RimFinder::listByGroup()
{
  rims_.clear();
  capOf_.clear();
  caps_.clear();
  used_.clear();
  const std::size_t groups = outside_.size();
  places_.assign(all_.size(), Unlisted);
  for (std::size_t g = 0; g < groups; ++g)
  {
    unsigned crossed = 0;
    for (std::size_t i = 0; i < all_.size(); ++i)
    {
      const unsigned part = parts_[i * groups + g] & outside_[g];
      crossed |= part;
      if (part == 0)
      {
        continue;
      }
      if (places_[i] == Unlisted)
      {
        places_[i] = static_cast<std::uint32_t>(caps_.size());
        caps_.push_back(all_[i]);
        used_.push_back(static_cast<std::uint32_t>(i));
      }
      capOf_.push_back(places_[i]);
    }
    if (crossed != 0)
    {
      rims_.push_back({ static_cast<std::uint16_t>(g), static_cast<GroupMask>(crossed),
        static_cast<std::uint32_t>(capOf_.size()) });
    }
  }
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
