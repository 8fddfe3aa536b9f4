// SPDX-License-Identifier: BSD-3-Clause
#include "TexelMask.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TexelMask.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, GroupSize>;

/// The lanes that are set, as the lowest bits of a number.
inline unsigned bitsOf(Floats d, hn::Mask<Floats> lanes)
{
  HWY_ALIGN std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, lanes, bytes);
  return bytes[0] | unsigned(bytes[1]) << 8;
}

inline hn::Mask<Floats> lanesOf(Floats d, unsigned bits)
{
  HWY_ALIGN const std::uint8_t bytes[8] = { static_cast<std::uint8_t>(bits),
    static_cast<std::uint8_t>(bits >> 8) };
  return hn::LoadMaskBits(d, bytes);
}

/// The lanes of one vector that an occluder hides.
class Unbounded
{
public:
  Unbounded(Floats d, const Occluder& o)
    : a_(hn::Set(d, o.a))
    , b_(hn::Set(d, o.b))
    , height_(hn::Set(d, o.height))
    , squaredRadius_(hn::Set(d, o.squaredRadius))
  {
  }

  [[nodiscard]] hn::Mask<Floats> hidden(
    Floats d, const float* u, const float* v, const float* w) const
  {
    const auto du = hn::Sub(hn::LoadU(d, u), a_);
    const auto dv = hn::Sub(hn::LoadU(d, v), b_);
    const auto square = hn::MulAdd(du, du, hn::Mul(dv, dv));
    return hn::And(hn::Lt(square, squaredRadius_), hn::Lt(hn::LoadU(d, w), height_));
  }

private:
  hn::Vec<Floats> a_, b_, height_, squaredRadius_;
};

class Bounded
{
public:
  Bounded(Floats d, const Occluder& o, float distance)
    : a_(hn::Set(d, o.a))
    , b_(hn::Set(d, o.b))
    , height_(hn::Set(d, o.height))
    , squaredRadius_(hn::Set(d, o.squaredRadius))
    , distance_(hn::Set(d, distance))
  {
  }

  [[nodiscard]] hn::Mask<Floats> hidden(
    Floats d, const float* u, const float* v, const float* w) const
  {
    const auto zero = hn::Zero(d);
    const auto du = hn::Sub(hn::LoadU(d, u), a_);
    const auto dv = hn::Sub(hn::LoadU(d, v), b_);
    const auto chord = hn::Sub(squaredRadius_, hn::MulAdd(du, du, hn::Mul(dv, dv)));
    const auto climb = hn::Sub(height_, hn::LoadU(d, w));
    // The light enters the occluder at climb - sqrt(chord) above the point.
    const auto entry = hn::Sub(climb, hn::Sqrt(hn::Max(chord, zero)));
    return hn::And(hn::And(hn::Gt(chord, zero), hn::Gt(climb, zero)), hn::Lt(entry, distance_));
  }

private:
  hn::Vec<Floats> a_, b_, height_, squaredRadius_, distance_;
};

template <typename Rule>
bool hideBy(const FacingTexels& facing, const Rule& rule, GroupMask* mask)
{
  const Floats d;
  const std::size_t groups = facing.groups();
  const float* u = facing.u.data();
  const float* v = facing.v.data();
  const float* w = facing.w.data();
  unsigned left = 0;
  for (std::size_t g = 0; g < groups; ++g)
  {
    if (mask[g] == 0)
    {
      continue;
    }
    unsigned hidden = 0;
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const std::size_t i = g * GroupSize + lane;
      hidden |= bitsOf(d, rule.hidden(d, u + i, v + i, w + i)) << lane;
    }
    mask[g] = static_cast<GroupMask>(mask[g] & ~hidden);
    left |= mask[g];
  }
  return left != 0;
}

bool hide(const FacingTexels& facing, const Occluder& occluder, GroupMask* mask)
{
  return hideBy(facing, Unbounded(Floats(), occluder), mask);
}

bool hideWithin(
  const FacingTexels& facing, const Occluder& occluder, float distance, GroupMask* mask)
{
  return hideBy(facing, Bounded(Floats(), occluder, distance), mask);
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

void addFacing(const FacingTexels& facing, const GroupMask* mask, float* sums)
{
  const std::size_t groups = facing.groups();
  const float* weights = facing.weight.data();
  for (std::size_t g = 0; g < groups; ++g)
  {
    if (mask[g] != 0)
    {
      addGroup(mask[g], weights + g * GroupSize, sums + facing.group[g] * GroupSize);
    }
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

void clearBuried(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t groups)
{
  const Floats d;
  const auto x = hn::Set(d, axis.x);
  const auto y = hn::Set(d, axis.y);
  const auto z = hn::Set(d, axis.z);
  const auto limit = hn::Set(d, cosine);
  for (std::size_t pattern = 0; pattern < TexelPatterns::Count; ++pattern)
  {
    unsigned buried = 0;
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const std::size_t i = patterns.index(pattern, group * GroupSize + lane);
      const auto xy = hn::MulAdd(
        hn::LoadU(d, patterns.y.data() + i), y, hn::Mul(hn::LoadU(d, patterns.x.data() + i), x));
      const auto height = hn::MulAdd(hn::LoadU(d, patterns.z.data() + i), z, xy);
      buried |= bitsOf(d, hn::Gt(height, limit)) << lane;
    }
    GroupMask& mask = bits[pattern * groups + group];
    mask = static_cast<GroupMask>(mask & ~buried);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(hide);
HWY_EXPORT(hideWithin);
HWY_EXPORT(addFacing);
HWY_EXPORT(addAll);
HWY_EXPORT(clearBuried);

bool hideTexels(const FacingTexels& facing, const Occluder& occluder, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(hide)(facing, occluder, mask);
}

bool hideTexelsWithin(
  const FacingTexels& facing, const Occluder& occluder, float distance, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(hideWithin)(facing, occluder, distance, mask);
}

void clearCap(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t groups)
{
  HWY_DYNAMIC_DISPATCH(clearBuried)(patterns, group, axis, cosine, bits, groups);
}

void addWeights(const FacingTexels& facing, const GroupMask* mask, float* sums)
{
  HWY_DYNAMIC_DISPATCH(addFacing)(facing, mask, sums);
}

void addMasked(std::size_t groups, const GroupMask* mask, const float* terms, float* sums)
{
  HWY_DYNAMIC_DISPATCH(addAll)(groups, mask, terms, sums);
}
}
#endif
