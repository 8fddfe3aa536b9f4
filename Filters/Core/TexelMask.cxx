// SPDX-License-Identifier: BSD-3-Clause
#include "TexelMask.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TexelMask.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// The texels of one vector, and which of them an occluder hides.
class Unbounded
{
public:
  Unbounded(Floats d, const FacingTexels& facing, std::size_t i)
    : u_(hn::LoadU(d, facing.u.data() + i))
    , v_(hn::LoadU(d, facing.v.data() + i))
    , w_(hn::LoadU(d, facing.w.data() + i))
  {
  }

  [[nodiscard]] hn::Mask<Floats> hidden(Floats d, const OccluderBatch& o, std::size_t k) const
  {
    const auto du = hn::Sub(u_, hn::Set(d, o.a[k]));
    const auto dv = hn::Sub(v_, hn::Set(d, o.b[k]));
    const auto square = hn::MulAdd(du, du, hn::Mul(dv, dv));
    return hn::And(
      hn::Lt(square, hn::Set(d, o.squaredRadius[k])), hn::Lt(w_, hn::Set(d, o.height[k])));
  }

private:
  hn::Vec<Floats> u_, v_, w_;
};

/// The same where light is blocked only within a distance.
class Bounded
{
public:
  Bounded(Floats d, const FacingTexels& facing, std::size_t i, float distance)
    : u_(hn::LoadU(d, facing.u.data() + i))
    , v_(hn::LoadU(d, facing.v.data() + i))
    , w_(hn::LoadU(d, facing.w.data() + i))
    , distance_(hn::Set(d, distance))
  {
  }

  [[nodiscard]] hn::Mask<Floats> hidden(Floats d, const OccluderBatch& o, std::size_t k) const
  {
    const auto zero = hn::Zero(d);
    const auto du = hn::Sub(u_, hn::Set(d, o.a[k]));
    const auto dv = hn::Sub(v_, hn::Set(d, o.b[k]));
    const auto square = hn::MulAdd(du, du, hn::Mul(dv, dv));
    const auto chord = hn::Sub(hn::Set(d, o.squaredRadius[k]), square);
    const auto climb = hn::Sub(hn::Set(d, o.height[k]), w_);
    // The light enters the occluder at climb - sqrt(chord) above the point.
    const auto entry = hn::Sub(climb, hn::Sqrt(hn::Max(chord, zero)));
    return hn::And(hn::And(hn::Gt(chord, zero), hn::Gt(climb, zero)), hn::Lt(entry, distance_));
  }

private:
  hn::Vec<Floats> u_, v_, w_, distance_;
};

/// @param more that Texels takes beside the texels
template <typename Texels, typename... Parameters>
bool hideBy(
  const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask, Parameters... more)
{
  const Floats d;
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
      const Texels texels(d, facing, g * GroupSize + lane, more...);
      auto lanes = noLanes(d);
      for (std::size_t k = 0; k < occluders.count; ++k)
      {
        lanes = hn::Or(lanes, texels.hidden(d, occluders, k));
      }
      hidden |= bitsOf(d, lanes) << lane;
    }
    mask[g] = static_cast<GroupMask>(mask[g] & ~hidden);
    left |= mask[g];
  }
  return left != 0;
}

bool hide(const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask)
{
  return hideBy<Unbounded>(facing, occluders, mask);
}

bool hideWithin(
  const FacingTexels& facing, const OccluderBatch& occluders, float distance, GroupMask* mask)
{
  return hideBy<Bounded>(facing, occluders, mask, distance);
}

/// A vector of a chunk's occluders, seen from a receiver.
class OccluderLanes
{
public:
  OccluderLanes(Floats d, const OccluderChunk& chunk, std::size_t lane, const ProjectedSphere& r)
    : receiver_(r)
    , dx_(hn::Sub(hn::LoadU(d, chunk.x.data() + lane), hn::Set(d, r.x)))
    , dy_(hn::Sub(hn::LoadU(d, chunk.y.data() + lane), hn::Set(d, r.y)))
    , dz_(hn::Sub(hn::LoadU(d, chunk.z.data() + lane), hn::Set(d, r.z)))
    , radius_(hn::LoadU(d, chunk.radius.data() + lane))
    , gap_(hn::MulAdd(dx_, dx_, hn::Mul(dy_, dy_)))
  {
  }

  /// Those whose disc meets the receiver's.
  /// @param share in the square of the distance across at which the discs touch: less than 1 for
  /// those right in front only
  [[nodiscard]] hn::Mask<Floats> meet(Floats d, float share) const
  {
    const auto touch = hn::Add(radius_, hn::Set(d, receiver_.radius));
    return hn::Lt(gap_, hn::Mul(hn::Mul(touch, touch), hn::Set(d, share)));
  }

  /// Those that hide all of the receiver: the disc holds the receiver's, the centre is above it.
  [[nodiscard]] hn::Mask<Floats> cover(Floats d) const
  {
    const auto radius = hn::Set(d, receiver_.radius);
    const auto margin = hn::Sub(radius_, radius);
    return hn::And(hn::And(hn::Gt(margin, hn::Zero(d)), hn::Ge(dz_, radius)),
      hn::Lt(gap_, hn::Mul(margin, margin)));
  }

  /// Those that block light within a distance of some point of the receiver, in its radii.
  [[nodiscard]] hn::Mask<Floats> reach(Floats d, float distance) const
  {
    const auto below = hn::Sub(hn::Sub(dz_, radius_), hn::Set(d, receiver_.radius));
    return hn::Lt(below, hn::Set(d, distance * receiver_.radius));
  }

  void addTo(OccluderBatch& batch, Floats d, hn::Mask<Floats> chosen) const
  {
    const auto scale = hn::Set(d, 1 / receiver_.radius);
    const auto radius = hn::Mul(radius_, scale);
    const std::size_t end = batch.count;
    hn::StoreU(hn::Compress(hn::Mul(dx_, scale), chosen), d, batch.a.data() + end);
    hn::StoreU(hn::Compress(hn::Mul(dy_, scale), chosen), d, batch.b.data() + end);
    hn::StoreU(hn::Compress(hn::Mul(dz_, scale), chosen), d, batch.height.data() + end);
    hn::StoreU(hn::Compress(hn::Mul(radius, radius), chosen), d, batch.squaredRadius.data() + end);
    batch.count += hn::CountTrue(d, chosen);
  }

private:
  const ProjectedSphere& receiver_;
  hn::Vec<Floats> dx_, dy_, dz_, radius_, gap_;
};

constexpr float AllThatMeet = 1;
constexpr float RightInFront = 0.25f;

/// Gathers the occluders of a chunk that meet a receiver, those right in front, which hide most,
/// first; false if one of them hides all of it.
bool gather(const OccluderChunk& chunk, const ProjectedSphere& receiver, OccluderBatch& batch)
{
  const Floats d;
  for (const bool inFront : { true, false })
  {
    for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
    {
      const OccluderLanes occluders(d, chunk, lane, receiver);
      const auto near = occluders.meet(d, RightInFront);
      if (inFront && !hn::AllFalse(d, hn::And(near, occluders.cover(d))))
      {
        return false;
      }
      const auto chosen = inFront ? near : hn::AndNot(near, occluders.meet(d, AllThatMeet));
      if (!hn::AllFalse(d, chosen))
      {
        occluders.addTo(batch, d, chosen);
      }
    }
  }
  return true;
}

bool behind(const FacingTexels& facing, OccluderList occluders, const ProjectedSphere& receiver,
  GroupMask* mask)
{
  for (int index = occluders.first; index != OccluderList::Empty;)
  {
    const OccluderChunk& chunk = occluders.chunks[index];
    OccluderBatch batch;
    if (!gather(chunk, receiver, batch) || (batch.count > 0 && !hide(facing, batch, mask)))
    {
      return false;
    }
    index = chunk.next;
  }
  return true;
}

bool behindWithin(const FacingTexels& facing, OccluderList occluders,
  const ProjectedSphere& receiver, float distance, GroupMask* mask)
{
  const Floats d;
  const float scaled = distance / receiver.radius;
  for (int index = occluders.first; index != OccluderList::Empty;)
  {
    const OccluderChunk& chunk = occluders.chunks[index];
    OccluderBatch batch;
    for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
    {
      const OccluderLanes lanes(d, chunk, lane, receiver);
      const auto chosen = hn::And(lanes.meet(d, AllThatMeet), lanes.reach(d, scaled));
      if (!hn::AllFalse(d, chosen))
      {
        lanes.addTo(batch, d, chosen);
      }
    }
    if (batch.count > 0 && !hideWithin(facing, batch, scaled, mask))
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
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(hide);
HWY_EXPORT(hideWithin);
HWY_EXPORT(behind);
HWY_EXPORT(behindWithin);
HWY_EXPORT(discs);

bool hideTexels(const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(hide)(facing, occluders, mask);
}

bool hideTexelsWithin(
  const FacingTexels& facing, const OccluderBatch& occluders, float distance, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(hideWithin)(facing, occluders, distance, mask);
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

void clearDiscs(
  const FacingTexels& facing, float a, float step, int count, float b, GroupMask* masks)
{
  HWY_DYNAMIC_DISPATCH(discs)(facing, a, step, count, b, masks);
}
}
#endif
