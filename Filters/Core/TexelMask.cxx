// SPDX-License-Identifier: BSD-3-Clause
#include "TexelMask.h"

#include <cmath>
#include <cstring>

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
  HWY_ALIGN std::uint8_t bytes[8] = {}; // least significant first
  hn::StoreMaskBits(d, lanes, bytes);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
#else
  return bytes[0] | unsigned(bytes[1]) << 8;
#endif
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
  const float* u = facing.u.data();
  const float* v = facing.v.data();
  const float* w = facing.w.data();
  unsigned left = 0;
  for (const std::uint32_t g : facing.facingGroups)
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

/// The occluders of a chunk, seen from a receiver: which of them meet its disc, and how.
struct Meeting
{
  unsigned near = 0; ///< those right in front, which hide most
  unsigned far = 0;  ///< the others that meet the disc
  bool covered = false;
};

/// In the square of the distance across at which two discs touch.
constexpr float NearShare = 0.25f;

Meeting meet(const OccluderChunk& chunk, const ProjectedSphere& r)
{
  const Floats d;
  Meeting meeting;
  const auto radius = hn::Set(d, r.radius);
  for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
  {
    const auto dx = hn::Sub(hn::LoadU(d, chunk.x.data() + lane), hn::Set(d, r.x));
    const auto dy = hn::Sub(hn::LoadU(d, chunk.y.data() + lane), hn::Set(d, r.y));
    const auto gap = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
    const auto occluder = hn::LoadU(d, chunk.radius.data() + lane);
    const auto touch = hn::Add(occluder, radius);
    const auto square = hn::Mul(touch, touch);
    const unsigned met = bitsOf(d, hn::Lt(gap, square));
    if (met == 0)
    {
      continue;
    }
    const unsigned near = bitsOf(d, hn::Lt(gap, hn::Mul(square, hn::Set(d, NearShare)))) & met;
    // One whose disc holds the receiver's, and whose centre is above all of it, hides it all.
    const auto margin = hn::Sub(occluder, radius);
    const auto height = hn::Sub(hn::LoadU(d, chunk.z.data() + lane), hn::Set(d, r.z));
    const auto covers = hn::And(hn::And(hn::Gt(margin, hn::Zero(d)), hn::Ge(height, radius)),
      hn::Lt(gap, hn::Mul(margin, margin)));
    meeting.covered = meeting.covered || (bitsOf(d, covers) & near) != 0;
    meeting.near |= near << lane;
    meeting.far |= (met & ~near) << lane;
  }
  return meeting;
}

Occluder seenFrom(const ProjectedSphere& r, const OccluderChunk& chunk, std::size_t i)
{
  const float scale = 1 / r.radius;
  const float radius = chunk.radius[i] * scale;
  return { (chunk.x[i] - r.x) * scale, (chunk.y[i] - r.y) * scale, (chunk.z[i] - r.z) * scale,
    radius * radius };
}

/// Calls hide(chunk, place) for the bits that are set, until it returns false.
template <typename Hide>
bool forEachBit(unsigned bits, const Hide& hide)
{
  for (; bits != 0; bits &= bits - 1)
  {
    if (!hide(static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits))))
    {
      return false;
    }
  }
  return true;
}

/// Calls hide(chunk, covered, bits) until it returns false; spheres right in front, which hide
/// most, come first in each chunk, so that hidden receivers are done with soon.
template <typename Hide>
bool hideBehindList(OccluderList occluders, const ProjectedSphere& receiver, const Hide& hide)
{
  for (int index = occluders.first; index != OccluderList::Empty;)
  {
    const OccluderChunk& chunk = occluders.chunks[index];
    const Meeting meeting = meet(chunk, receiver);
    if (!hide(chunk, meeting.covered, meeting.near) || !hide(chunk, false, meeting.far))
    {
      return false;
    }
    index = chunk.next;
  }
  return true;
}

bool behind(const FacingTexels& facing, OccluderList occluders, const ProjectedSphere& receiver,
  GroupMask* mask)
{
  return hideBehindList(occluders, receiver,
    [&](const OccluderChunk& chunk, bool covered, unsigned bits)
    {
      return !covered &&
        forEachBit(
          bits, [&](std::size_t i) { return hide(facing, seenFrom(receiver, chunk, i), mask); });
    });
}

bool behindWithin(const FacingTexels& facing, OccluderList occluders,
  const ProjectedSphere& receiver, float distance, GroupMask* mask)
{
  const float scaled = distance / receiver.radius;
  return hideBehindList(occluders, receiver,
    [&](const OccluderChunk& chunk, bool, unsigned bits)
    {
      return forEachBit(bits,
        [&](std::size_t i)
        {
          const Occluder occluder = seenFrom(receiver, chunk, i);
          const float lowest = occluder.height - std::sqrt(occluder.squaredRadius) - 1;
          return lowest >= scaled || hideWithin(facing, occluder, scaled, mask);
        });
    });
}

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

/// Takes what the occluders of the set bits hide, by their places in the table; false if nothing is
/// left. That is asked at the end only, so that the loads need not wait for each other.
inline bool lookUp(const OffsetMasks& masks, unsigned bits, const std::int32_t* column,
  const std::int32_t* row, GroupMask* mask)
{
  if (bits == 0)
  {
    return true;
  }
  const Masks d;
  bool open = false;
  for (std::size_t g = 0; g < OffsetMasks::Groups; g += hn::Lanes(d))
  {
    auto left = hn::LoadU(d, mask + g);
    forEachBit(bits,
      [&](std::size_t i)
      {
        left = hn::And(left, hn::LoadU(d, masks.at(column[i], row[i]) + g));
        return true;
      });
    hn::StoreU(left, d, mask + g);
    open = open || !hn::AllTrue(d, hn::Eq(left, hn::Zero(d)));
  }
  return open;
}

bool behindEqual(const FacingTexels& facing, const OffsetMasks& masks, OccluderList occluders,
  const ProjectedSphere& r, GroupMask* mask)
{
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const float touch = 4 * r.radius * r.radius;
  const auto scale = hn::Set(d, OffsetMasks::CellsPerRadius / r.radius);
  const auto originX = hn::Set(d, masks.originX());
  const auto originY = hn::Set(d, masks.originY());
  HWY_ALIGN std::int32_t column[OccluderChunk::Size];
  HWY_ALIGN std::int32_t row[OccluderChunk::Size];
  for (int index = occluders.first; index != OccluderList::Empty;)
  {
    const OccluderChunk& chunk = occluders.chunks[index];
    unsigned apart = 0;
    unsigned overlapping = 0;
    for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
    {
      const auto dx = hn::Sub(hn::LoadU(d, chunk.x.data() + lane), hn::Set(d, r.x));
      const auto dy = hn::Sub(hn::LoadU(d, chunk.y.data() + lane), hn::Set(d, r.y));
      const auto dz = hn::Sub(hn::LoadU(d, chunk.z.data() + lane), hn::Set(d, r.z));
      const auto gap = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
      const unsigned met = bitsOf(d, hn::Lt(gap, hn::Set(d, touch)));
      if (met == 0)
      {
        continue;
      }
      // Touching spheres count as apart, whichever way rounding makes them.
      const auto distance = hn::MulAdd(dz, dz, gap);
      const unsigned cut = met & bitsOf(d, hn::Lt(distance, hn::Set(d, touch * (1 - 1e-4f))));
      apart |= (met & ~cut) << lane;
      overlapping |= cut << lane;
      hn::Store(hn::ConvertTo(di, hn::MulAdd(dx, scale, originX)), di, column + lane);
      hn::Store(hn::ConvertTo(di, hn::MulAdd(dy, scale, originY)), di, row + lane);
    }
    const bool open = lookUp(masks, apart, column, row, mask) &&
      forEachBit(
        overlapping, [&](std::size_t i) { return hide(facing, seenFrom(r, chunk, i), mask); });
    if (!open)
    {
      return false;
    }
    index = chunk.next;
  }
  return true;
}

void discs(const FacingTexels& facing, float a, float step, int count, float b, GroupMask* masks)
{
  const Floats d;
  const auto one = hn::Set(d, 1.0f);
  for (const std::uint32_t g : facing.facingGroups)
  {
    for (std::size_t lane = 0; lane < GroupSize; lane += hn::Lanes(d))
    {
      const auto u = hn::LoadU(d, facing.u.data() + g * GroupSize + lane);
      const auto dv = hn::Sub(hn::LoadU(d, facing.v.data() + g * GroupSize + lane), hn::Set(d, b));
      const auto dv2 = hn::Mul(dv, dv);
      for (int k = 0; k < count; ++k)
      {
        const auto du = hn::Sub(u, hn::Set(d, a + static_cast<float>(k) * step));
        const unsigned inside = bitsOf(d, hn::Lt(hn::MulAdd(du, du, dv2), one));
        GroupMask& mask = masks[static_cast<std::size_t>(k) * OffsetMasks::Groups + g];
        mask = static_cast<GroupMask>(mask & ~(inside << lane));
      }
    }
  }
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

void clearBuried(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t stride)
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
      const std::size_t i = TexelPatterns::index(pattern, group * GroupSize + lane);
      const auto xy = hn::MulAdd(
        hn::LoadU(d, patterns.y.data() + i), y, hn::Mul(hn::LoadU(d, patterns.x.data() + i), x));
      const auto height = hn::MulAdd(hn::LoadU(d, patterns.z.data() + i), z, xy);
      buried |= bitsOf(d, hn::Gt(height, limit)) << lane;
    }
    GroupMask& mask = bits[pattern * stride];
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
HWY_EXPORT(behind);
HWY_EXPORT(behindWithin);
HWY_EXPORT(behindEqual);
HWY_EXPORT(both);
HWY_EXPORT(discs);
HWY_EXPORT(addAll);
HWY_EXPORT(addList);
HWY_EXPORT(addPoints);
HWY_EXPORT(classify);
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

bool hideBehind(const FacingTexels& facing, OccluderList occluders, const ProjectedSphere& receiver,
  GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(behind)(facing, occluders, receiver, mask);
}

bool hideBehindWithin(const FacingTexels& facing, OccluderList occluders,
  const ProjectedSphere& receiver, float distance, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(behindWithin)(facing, occluders, receiver, distance, mask);
}

bool hideBehindEqual(const FacingTexels& facing, const OffsetMasks& masks, OccluderList occluders,
  const ProjectedSphere& receiver, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(behindEqual)(facing, masks, occluders, receiver, mask);
}

bool intersect(std::size_t groups, const GroupMask* other, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(both)(groups, other, mask);
}

void clearDiscs(
  const FacingTexels& facing, float a, float step, int count, float b, GroupMask* masks)
{
  HWY_DYNAMIC_DISPATCH(discs)(facing, a, step, count, b, masks);
}

void classifyCap(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part)
{
  HWY_DYNAMIC_DISPATCH(classify)(discs, axis, cosine, sine, covered, part);
}

void clearCap(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t stride)
{
  HWY_DYNAMIC_DISPATCH(clearBuried)(patterns, group, axis, cosine, bits, stride);
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
