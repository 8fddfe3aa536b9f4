// SPDX-License-Identifier: BSD-3-Clause
#include "TexelCaps.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TexelCaps.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// A cap, in all lanes.
struct CapLanes
{
  explicit CapLanes(Floats d, const RimCap& cap)
    : x(hn::Set(d, cap.axis.x))
    , y(hn::Set(d, cap.axis.y))
    , z(hn::Set(d, cap.axis.z))
    , cosine(hn::Set(d, cap.cosine))
  {
  }

  hn::Vec<Floats> x, y, z, cosine;
};

/// The discs from a slot on.
class DiscLanes
{
public:
  DiscLanes(Floats d, const TexelDiscs& discs, std::size_t slot)
    : x_(hn::LoadU(d, discs.x.data() + slot))
    , y_(hn::LoadU(d, discs.y.data() + slot))
    , z_(hn::LoadU(d, discs.z.data() + slot))
    , cosRadius_(hn::LoadU(d, discs.cosRadius.data() + slot))
    , sinRadius_(hn::LoadU(d, discs.sinRadius.data() + slot))
  {
  }

  /// Those that a cap covers, and those that it does not touch, as bits.
  struct Sides
  {
    unsigned covered, apart;
  };

  [[nodiscard]] Sides test(Floats d, const CapLanes& cap, float sine) const
  {
    // Rounding may cost time, but never a wrong answer.
    const auto slack = hn::Set(d, 1e-6f);
    const auto xy = hn::MulAdd(y_, cap.y, hn::Mul(x_, cap.x));
    const auto height = hn::MulAdd(z_, cap.z, xy);
    // cos(half angle -+ radius), for caps larger than the disc and with a gap larger than it
    const auto cc = hn::Mul(cap.cosine, cosRadius_);
    const auto s = hn::Set(d, sine);
    const auto inner = hn::Add(hn::MulAdd(s, sinRadius_, cc), slack);
    const auto outer = hn::Sub(hn::NegMulAdd(s, sinRadius_, cc), slack);
    return { bitsOf(d, hn::And(hn::Gt(height, inner), hn::Lt(cap.cosine, cosRadius_))),
      bitsOf(d, hn::And(hn::Lt(height, outer), hn::Gt(cap.cosine, hn::Neg(cosRadius_)))) };
  }

private:
  hn::Vec<Floats> x_, y_, z_, cosRadius_, sinRadius_;
};

/// @return those of the lanes that are covered
inline unsigned classifyLanes(const DiscLanes& discs, std::size_t lane, const CapList& caps,
  const float* sines, GroupMask* parts)
{
  const Floats d;
  const unsigned all = (1u << hn::Lanes(d)) - 1;
  unsigned covered = 0;
  for (const std::uint32_t* place = caps.first; place != caps.last && covered != all; ++place)
  {
    const DiscLanes::Sides sides = discs.test(d, CapLanes(d, caps.caps[*place]), sines[*place]);
    covered |= sides.covered;
    const unsigned part = all & ~(sides.covered | sides.apart);
    *parts = static_cast<GroupMask>(*parts | part << lane);
    ++parts;
  }
  return covered;
}

GroupMask classify(const TexelDiscs& discs, std::size_t group, const CapList& caps,
  const float* sines, GroupMask* parts)
{
  const Floats d;
  std::fill_n(parts, caps.last - caps.first, GroupMask(0));
  unsigned covered = 0;
  for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
  {
    const DiscLanes lanes(d, discs, group * GroupSize + lane);
    covered |= classifyLanes(lanes, lane, caps, sines, parts) << lane;
  }
  return static_cast<GroupMask>(covered);
}

/// The points from a place on, and which of them lie inside caps.
class PointLanes
{
public:
  /// @param points patterns or texel by texel
  template <typename Points>
  PointLanes(Floats d, const Points& points, std::size_t i)
    : x_(hn::LoadU(d, points.x.data() + i))
    , y_(hn::LoadU(d, points.y.data() + i))
    , z_(hn::LoadU(d, points.z.data() + i))
    , inside_(noLanes(d))
  {
  }

  void test(const CapLanes& cap)
  {
    const auto xy = hn::MulAdd(y_, cap.y, hn::Mul(x_, cap.x));
    inside_ = hn::Or(inside_, hn::Gt(hn::MulAdd(z_, cap.z, xy), cap.cosine));
  }

  [[nodiscard]] hn::Mask<Floats> inside() const { return inside_; }

private:
  hn::Vec<Floats> x_, y_, z_;
  hn::Mask<Floats> inside_;
};

/// The points of a pattern that lie inside any of the caps, as bits.
inline unsigned insideOf(
  const TexelPatterns& patterns, std::size_t pattern, std::size_t group, const CapList& caps)
{
  const Floats d;
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
  {
    PointLanes points(d, patterns, TexelPatterns::index(pattern, group * GroupSize + lane));
    for (const std::uint32_t* place = caps.first; place != caps.last; ++place)
    {
      points.test(CapLanes(d, caps.caps[*place]));
    }
    bits |= bitsOf(d, points.inside()) << lane;
  }
  return bits;
}

/// The points of a texel that lie outside all caps, a bit each.
inline std::uint32_t outsideOf(const TexelPoints& points, std::size_t slot, const CapList& caps)
{
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint32_t inside = 0;
  // Two vectors at a time, which do not wait for each other.
  for (std::size_t p = 0; p < TexelPatterns::Count; p += 2 * lanes)
  {
    PointLanes first(d, points, slot * TexelPatterns::Count + p);
    PointLanes second(d, points, slot * TexelPatterns::Count + p + lanes);
    for (const std::uint32_t* place = caps.first; place != caps.last; ++place)
    {
      const CapLanes cap(d, caps.caps[*place]);
      first.test(cap);
      second.test(cap);
    }
    inside |= bitsOf(d, first.inside()) << p;
    inside |= bitsOf(d, second.inside()) << (p + lanes);
  }
  return ~inside;
}

/// The points of a group's texels that lie outside all caps, a bit each.
class GroupPoints
{
public:
  GroupPoints(const TexelPoints& points, std::size_t group, const CapList& caps, GroupMask outside,
    GroupMask crossed)
  {
    static_assert(TexelPatterns::Count == 32);
    for (std::size_t i = 0; i < GroupSize; ++i)
    {
      outside_[i] = (outside >> i & 1) != 0 ? ~std::uint32_t(0) : 0;
    }
    for (unsigned left = crossed; left != 0; left &= left - 1)
    {
      const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
      outside_[i] = outsideOf(points, group * GroupSize + i, caps);
    }
  }

  /// @param terms [TexelPatterns::Count][GroupSize] of the points
  void sum(const float* terms, float* sums) const
  {
    const Floats d;
    const hn::RebindToUnsigned<Floats> bits;
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const auto outside = hn::Load(bits, outside_ + lane);
      auto sum = hn::Zero(d);
      for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
      {
        const auto counts =
          hn::RebindMask(d, hn::TestBit(outside, hn::Set(bits, std::uint32_t(1) << p)));
        sum = hn::Add(sum, hn::IfThenElseZero(counts, hn::LoadU(d, terms + p * GroupSize + lane)));
      }
      hn::StoreU(sum, d, sums + lane);
    }
  }

  void count(float* counts) const
  {
    std::transform(outside_, outside_ + GroupSize, counts,
      [](std::uint32_t points) { return static_cast<float>(hwy::PopCount(points)); });
  }

private:
  HWY_ALIGN std::uint32_t outside_[GroupSize];
};

void sumOverOutside(const TexelPoints& points, std::size_t group, const CapList& caps,
  GroupMask outside, GroupMask crossed, const float* weights, const float* irradiance,
  OutsideSums& sums)
{
  const GroupPoints exposed(points, group, caps, outside, crossed);
  exposed.count(sums.points.data());
  exposed.sum(weights, sums.weights.data());
  if (irradiance != nullptr)
  {
    exposed.sum(irradiance, sums.irradiance.data());
  }
}

void clearBuried(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask* bits, std::size_t stride)
{
  for (std::size_t pattern = 0; pattern < TexelPatterns::Count; ++pattern)
  {
    GroupMask& mask = bits[pattern * stride];
    mask = static_cast<GroupMask>(mask & ~insideOf(patterns, pattern, group, caps));
  }
}

/// Clears the points of a group that lie inside any of the caps.
inline void clearGroup(const TexelPatterns& patterns, std::size_t pattern, std::size_t group,
  const CapList& caps, GroupMask* mask)
{
  mask[group] = static_cast<GroupMask>(mask[group] & ~insideOf(patterns, pattern, group, caps));
}

bool clearRims(
  const TexelPatterns& patterns, std::size_t pattern, const TexelRims& rims, GroupMask* mask)
{
  const std::size_t groups = patterns.groups();
  for (std::size_t g = 0; g < groups; ++g)
  {
    mask[g] = static_cast<GroupMask>(mask[g] & rims.outside[g]);
  }
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    if ((mask[rims.rims[rim].group] & rims.rims[rim].crossed) != 0)
    {
      clearGroup(patterns, pattern, rims.rims[rim].group, rims.capsOf(rim), mask);
    }
  }
  unsigned left = 0;
  for (std::size_t g = 0; g < groups; ++g)
  {
    left |= mask[g];
  }
  return left != 0;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(classify);
HWY_EXPORT(sumOverOutside);
HWY_EXPORT(clearBuried);
HWY_EXPORT(clearRims);

GroupMask classifyCaps(const TexelDiscs& discs, std::size_t group, const CapList& caps,
  const float* sines, GroupMask* parts)
{
  return HWY_DYNAMIC_DISPATCH(classify)(discs, group, caps, sines, parts);
}

void sumOutside(const TexelPoints& points, std::size_t group, const CapList& caps,
  GroupMask outside, GroupMask crossed, const float* weights, const float* irradiance,
  OutsideSums& sums)
{
  HWY_DYNAMIC_DISPATCH(sumOverOutside)
  (points, group, caps, outside, crossed, weights, irradiance, sums);
}

void clearCaps(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask* bits, std::size_t stride)
{
  HWY_DYNAMIC_DISPATCH(clearBuried)(patterns, group, caps, bits, stride);
}

bool clearInside(
  const TexelPatterns& patterns, std::size_t pattern, const TexelRims& rims, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(clearRims)(patterns, pattern, rims, mask);
}
}
#endif
