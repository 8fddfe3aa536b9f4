// SPDX-License-Identifier: BSD-3-Clause
#include "MaskedSums.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "MaskedSums.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
using Masks = hn::CappedTag<GroupMask, 16>;

inline bool both(std::size_t groups, const GroupMask* other, GroupMask* mask)
{
  const Masks d;
  auto left = hn::Zero(d);
  std::size_t g = 0;
  for (; g + hn::Lanes(d) <= groups; g += hn::Lanes(d))
  {
    const auto common = hn::And(hn::LoadU(d, mask + g), hn::LoadU(d, other + g));
    hn::StoreU(common, d, mask + g);
    left = hn::Or(left, common);
  }
  unsigned rest = 0;
  for (; g < groups; ++g)
  {
    mask[g] = static_cast<GroupMask>(mask[g] & other[g]);
    rest |= mask[g];
  }
  return rest != 0 || !hn::AllTrue(d, hn::Eq(left, hn::Zero(d)));
}

inline void addGroup(GroupMask mask, const float* terms, float* sums)
{
  const Floats d;
  for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
  {
    const auto set = lanesOf(d, unsigned(mask) >> lane);
    const auto term = hn::IfThenElseZero(set, hn::LoadU(d, terms + lane));
    hn::StoreU(hn::Add(hn::LoadU(d, sums + lane), term), d, sums + lane);
  }
}

void addList(std::size_t groups, const MaskedTerms* list, std::size_t count, float* sums)
{
  const Floats d;
  for (std::size_t g = 0; g < groups; ++g)
  {
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const std::size_t i = g * GroupSize + lane;
      auto sum = hn::LoadU(d, sums + i);
      for (std::size_t k = 0; k < count; ++k)
      {
        const auto set = lanesOf(d, unsigned(list[k].mask[g]) >> lane);
        sum = hn::Add(sum, hn::IfThenElseZero(set, hn::LoadU(d, list[k].terms + i)));
      }
      hn::StoreU(sum, d, sums + i);
    }
  }
}

void addPoints(const GroupMask* mask, std::size_t stride, const float* terms, float* sums)
{
  const Floats d;
  for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
  {
    auto sum = hn::LoadU(d, sums + lane);
    for (std::size_t p = 0; p < PointsPerTexel; ++p)
    {
      const auto set = lanesOf(d, unsigned(mask[p * stride]) >> lane);
      sum = hn::Add(sum, hn::IfThenElseZero(set, hn::LoadU(d, terms + p * GroupSize + lane)));
    }
    hn::StoreU(sum, d, sums + lane);
  }
}

void addAll(std::size_t groups, const GroupMask* mask, const float* terms, float* sums)
{
  for (std::size_t g = 0; g < groups; ++g)
  {
    if (mask[g] != 0)
    {
      addGroup(mask[g], terms + g * GroupSize, sums + g * GroupSize);
    }
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(both);
HWY_EXPORT(addAll);
HWY_EXPORT(addList);
HWY_EXPORT(addPoints);

bool intersect(std::size_t groups, const GroupMask* other, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(both)(groups, other, mask);
}

void addMasked(std::size_t groups, const GroupMask* mask, const float* terms, float* sums)
{
  HWY_DYNAMIC_DISPATCH(addAll)(groups, mask, terms, sums);
}

void addMasked(std::size_t groups, const MaskedTerms* list, std::size_t count, float* sums)
{
  HWY_DYNAMIC_DISPATCH(addList)(groups, list, count, sums);
}

void addOverPoints(const GroupMask* mask, std::size_t stride, const float* terms, float* sums)
{
  HWY_DYNAMIC_DISPATCH(addPoints)(mask, stride, terms, sums);
}
}
#endif
