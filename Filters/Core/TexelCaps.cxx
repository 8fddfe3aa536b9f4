// SPDX-License-Identifier: BSD-3-Clause
#include "TexelCaps.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TexelCaps.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
void classify(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part)
{
  // Rounding may cost time, but never a wrong answer.
  constexpr float slack = 1e-6f;
  const Floats d;
  const auto c = hn::Set(d, cosine);
  const auto s = hn::Set(d, sine);
  const std::size_t groups = discs.x.size() / GroupSize;
  for (std::size_t g = 0; g < groups; ++g)
  {
    unsigned all = 0;
    unsigned none = 0;
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const std::size_t i = g * GroupSize + lane;
      const auto xy = hn::MulAdd(hn::LoadU(d, discs.y.data() + i), hn::Set(d, axis.y),
        hn::Mul(hn::LoadU(d, discs.x.data() + i), hn::Set(d, axis.x)));
      const auto height = hn::MulAdd(hn::LoadU(d, discs.z.data() + i), hn::Set(d, axis.z), xy);
      const auto cosRadius = hn::LoadU(d, discs.cosRadius.data() + i);
      const auto sinRadius = hn::LoadU(d, discs.sinRadius.data() + i);
      // cos(half angle -+ radius), for caps larger than the texel and with a gap larger than it
      const auto cc = hn::Mul(c, cosRadius);
      const auto inner = hn::Add(hn::MulAdd(s, sinRadius, cc), hn::Set(d, slack));
      const auto outer = hn::Sub(hn::NegMulAdd(s, sinRadius, cc), hn::Set(d, slack));
      all |= bitsOf(d, hn::And(hn::Gt(height, inner), hn::Lt(c, cosRadius))) << lane;
      none |= bitsOf(d, hn::And(hn::Lt(height, outer), hn::Gt(c, hn::Neg(cosRadius)))) << lane;
    }
    covered[g] = static_cast<GroupMask>(all);
    part[g] = static_cast<GroupMask>(~(all | none));
  }
}

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

/// The points from a place on, and which of them lie inside caps.
class PointLanes
{
public:
  PointLanes(Floats d, const TexelPatterns& patterns, std::size_t i)
    : x_(hn::LoadU(d, patterns.x.data() + i))
    , y_(hn::LoadU(d, patterns.y.data() + i))
    , z_(hn::LoadU(d, patterns.z.data() + i))
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

template <bool WithIrradiance>
void sumPoints(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask outside, const float* weights, const float* irradiance, OutsideSums& sums)
{
  const Floats d;
  const auto one = hn::Set(d, 1.0f);
  for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
  {
    const auto texels = lanesOf(d, unsigned(outside) >> lane);
    auto points = hn::Zero(d);
    auto weight = hn::Zero(d);
    auto light = hn::Zero(d);
    const auto add = [&](std::size_t p, const PointLanes& lanes)
    {
      const std::size_t inGroup = p * GroupSize + lane;
      const auto counts = hn::AndNot(lanes.inside(), texels);
      points = hn::Add(points, hn::IfThenElseZero(counts, one));
      weight = hn::Add(weight, hn::IfThenElseZero(counts, hn::LoadU(d, weights + inGroup)));
      if constexpr (WithIrradiance)
      {
        light = hn::Add(light, hn::IfThenElseZero(counts, hn::LoadU(d, irradiance + inGroup)));
      }
    };
    // Four patterns at a time, which do not wait for each other.
    static_assert(TexelPatterns::Count % 4 == 0);
    for (std::size_t p = 0; p < TexelPatterns::Count; p += 4)
    {
      const auto pointsOf = [&](std::size_t pattern)
      { return PointLanes(d, patterns, TexelPatterns::index(pattern, group * GroupSize + lane)); };
      PointLanes a = pointsOf(p), b = pointsOf(p + 1), c = pointsOf(p + 2), e = pointsOf(p + 3);
      for (const std::uint32_t* place = caps.first; place != caps.last; ++place)
      {
        const CapLanes cap(d, caps.caps[*place]);
        a.test(cap);
        b.test(cap);
        c.test(cap);
        e.test(cap);
      }
      add(p, a);
      add(p + 1, b);
      add(p + 2, c);
      add(p + 3, e);
    }
    hn::StoreU(points, d, sums.points.data() + lane);
    hn::StoreU(weight, d, sums.weights.data() + lane);
    hn::StoreU(light, d, sums.irradiance.data() + lane);
  }
}

void sumOverOutside(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask outside, const float* weights, const float* irradiance, OutsideSums& sums)
{
  (irradiance == nullptr ? sumPoints<false> : sumPoints<true>)(patterns, group, caps, outside,
    weights, irradiance, sums);
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

void classifyCap(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part)
{
  HWY_DYNAMIC_DISPATCH(classify)(discs, axis, cosine, sine, covered, part);
}

void sumOutside(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask outside, const float* weights, const float* irradiance, OutsideSums& sums)
{
  HWY_DYNAMIC_DISPATCH(sumOverOutside)
  (patterns, group, caps, outside, weights, irradiance, sums);
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
