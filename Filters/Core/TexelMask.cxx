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
/// The texels of one vector, and which of them occluders hide.
class TexelVector
{
public:
  TexelVector(Floats d, const FacingTexels& facing, std::size_t slot)
    : u_(hn::LoadU(d, facing.u.data() + slot))
    , v_(hn::LoadU(d, facing.v.data() + slot))
    , w_(hn::LoadU(d, facing.w.data() + slot))
    , square_(hn::MulAdd(u_, u_, hn::Mul(v_, v_)))
    , hidden_(noLanes(d))
  {
  }

  /// The points that lie within the disc and below the centre of an occluder count as hidden.
  void hide(Floats d, const OccluderBatch& o, std::size_t k)
  {
    const auto within = hn::Gt(across(d, o, k), hn::Set(d, o.power[k]));
    hidden_ = hn::Or(hidden_, hn::And(within, hn::Lt(w_, hn::Set(d, o.height[k]))));
  }

  /// The same where light is blocked only within a distance.
  void hideWithin(Floats d, const OccluderBatch& o, std::size_t k, hn::Vec<Floats> distance)
  {
    const auto zero = hn::Zero(d);
    // The square of half of the light's way through the occluder.
    const auto chord = hn::Sub(across(d, o, k), hn::Set(d, o.power[k]));
    const auto climb = hn::Sub(hn::Set(d, o.height[k]), w_);
    const auto entry = hn::Sub(climb, hn::Sqrt(hn::Max(chord, zero)));
    hidden_ = hn::Or(
      hidden_, hn::And(hn::And(hn::Gt(chord, zero), hn::Gt(climb, zero)), hn::Lt(entry, distance)));
  }

  [[nodiscard]] unsigned hidden(Floats d) const { return bitsOf(d, hidden_); }

private:
  [[nodiscard]] hn::Vec<Floats> across(Floats d, const OccluderBatch& o, std::size_t k) const
  {
    return hn::MulAdd(
      u_, hn::Set(d, o.twiceA[k]), hn::MulSub(v_, hn::Set(d, o.twiceB[k]), square_));
  }

  hn::Vec<Floats> u_, v_, w_, square_;
  hn::Mask<Floats> hidden_;
};

/// Slots with which the vectors begin that hold texels of which bits are set.
class OpenVectors
{
public:
  OpenVectors(Floats d, const FacingTexels& facing, const GroupMask* mask)
  {
    const auto lanes = static_cast<unsigned>(hn::Lanes(d));
    // Nobody could guess which groups are open: no branch depends on it.
    for (const std::uint32_t g : facing.facingGroups)
    {
      for (unsigned lane = 0; lane < GroupSize; lane += lanes)
      {
        slots_[count_] = static_cast<std::uint16_t>(g * GroupSize + lane);
        count_ += (unsigned(mask[g]) >> lane & ((1u << lanes) - 1)) != 0 ? 1 : 0;
      }
    }
    // An odd one is its own partner.
    slots_[count_] = count_ > 0 ? slots_[count_ - 1] : 0;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t slot(std::size_t i) const { return slots_[i]; }

private:
  std::size_t count_ = 0;
  std::array<std::uint16_t, SweepTexels::MostSlots + 1> slots_; ///< room for one slot each
};

inline void clearBits(GroupMask* mask, std::size_t slot, unsigned hidden)
{
  GroupMask& group = mask[slot / GroupSize];
  group = static_cast<GroupMask>(group & ~(hidden << slot % GroupSize));
}

/// @param test calls hide() or hideWithin() of a TexelVector for an occluder
template <typename Test>
bool hideBy(
  const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask, const Test& test)
{
  const Floats d;
  const OpenVectors vectors(d, facing, mask);
  // Two at a time do not wait for each other.
  for (std::size_t i = 0; i < vectors.count(); i += 2)
  {
    TexelVector first(d, facing, vectors.slot(i));
    TexelVector second(d, facing, vectors.slot(i + 1));
    for (std::size_t k = 0; k < occluders.count; ++k)
    {
      test(first, k);
      test(second, k);
    }
    clearBits(mask, vectors.slot(i), first.hidden(d));
    clearBits(mask, vectors.slot(i + 1), second.hidden(d));
  }
  unsigned left = 0;
  for (const std::uint32_t g : facing.facingGroups)
  {
    left |= mask[g];
  }
  return left != 0;
}

bool hide(const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask)
{
  const Floats d;
  return hideBy(facing, occluders, mask,
    [&](TexelVector& texels, std::size_t k) { texels.hide(d, occluders, k); });
}

bool hideWithin(
  const FacingTexels& facing, const OccluderBatch& occluders, float distance, GroupMask* mask)
{
  const Floats d;
  const auto most = hn::Set(d, distance);
  return hideBy(facing, occluders, mask,
    [&](TexelVector& texels, std::size_t k) { texels.hideWithin(d, occluders, k, most); });
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
  [[nodiscard]] hn::Mask<Floats> meet(Floats d) const
  {
    const auto touch = hn::Add(radius_, hn::Set(d, receiver_.radius));
    return hn::Lt(gap_, hn::Mul(touch, touch));
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
    const auto twice = hn::Add(scale, scale);
    const auto power = hn::Mul(hn::NegMulAdd(radius_, radius_, gap_), hn::Mul(scale, scale));
    const std::size_t end = batch.count;
    hn::StoreU(hn::Compress(hn::Mul(dx_, twice), chosen), d, batch.twiceA.data() + end);
    hn::StoreU(hn::Compress(hn::Mul(dy_, twice), chosen), d, batch.twiceB.data() + end);
    hn::StoreU(hn::Compress(hn::Mul(dz_, scale), chosen), d, batch.height.data() + end);
    hn::StoreU(hn::Compress(power, chosen), d, batch.power.data() + end);
    batch.count += hn::CountTrue(d, chosen);
  }

private:
  const ProjectedSphere& receiver_;
  hn::Vec<Floats> dx_, dy_, dz_, radius_, gap_;
};

/// Gathers the occluders of a chunk that meet a receiver; false if one of them hides all of it.
bool gather(const OccluderChunk& chunk, const ProjectedSphere& receiver, OccluderBatch& batch)
{
  const Floats d;
  for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
  {
    const OccluderLanes occluders(d, chunk, lane, receiver);
    const auto chosen = occluders.meet(d);
    if (!hn::AllFalse(d, hn::And(chosen, occluders.cover(d))))
    {
      return false;
    }
    occluders.addTo(batch, d, chosen);
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
      const auto chosen = hn::And(lanes.meet(d), lanes.reach(d, scaled));
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
