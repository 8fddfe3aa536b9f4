// SPDX-License-Identifier: BSD-3-Clause
#include "OffsetLookup.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "OffsetLookup.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// Calls action(place) for the bits that are set.
template <typename Action>
void forEachBit(unsigned bits, const Action& action)
{
  for (; bits != 0; bits &= bits - 1)
  {
    action(static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
  }
}

using Masks = hn::CappedTag<GroupMask, 16>;

/// Places in the tables of the occluders of a chunk.
struct TablePlaces
{
  HWY_ALIGN std::int32_t column[OccluderChunk::Size];
  HWY_ALIGN std::int32_t row[OccluderChunk::Size];
  HWY_ALIGN std::int32_t level[OccluderChunk::Size];
  unsigned apart = 0;       ///< a bit for each that meets the receiver and does not overlap it
  unsigned overlapping = 0; ///< for each that overlaps it
};

/// Looks up where the occluders of chunks are in the tables, for one receiver.
class TableLookup
{
public:
  TableLookup(const OffsetMasks& masks, const ProjectedSphere& receiver)
    : receiver_(receiver)
    , touch_(4 * receiver.radius * receiver.radius)
    , scale_(OffsetMasks::CellsPerRadius / receiver.radius)
    , originX_(masks.originX())
    , originY_(masks.originY())
    , originZ_(masks.originZ())
  {
  }

  void find(const OccluderChunk& chunk, TablePlaces& places) const
  {
    const Floats d;
    places.apart = places.overlapping = 0;
    for (std::size_t lane = 0; lane < OccluderChunk::Size; lane += hn::Lanes(d))
    {
      findLanes(chunk, lane, places);
    }
  }

private:
  void findLanes(const OccluderChunk& chunk, std::size_t lane, TablePlaces& places) const
  {
    const Floats d;
    const auto dx = hn::Sub(hn::LoadU(d, chunk.x.data() + lane), hn::Set(d, receiver_.x));
    const auto dy = hn::Sub(hn::LoadU(d, chunk.y.data() + lane), hn::Set(d, receiver_.y));
    const auto gap = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
    const unsigned met = bitsOf(d, hn::Lt(gap, hn::Set(d, touch_)));
    if (met == 0)
    {
      return;
    }
    const auto dz = hn::Sub(hn::LoadU(d, chunk.z.data() + lane), hn::Set(d, receiver_.z));
    const auto distance = hn::MulAdd(dz, dz, gap);
    // Touching spheres count as apart, whichever way rounding makes them.
    const auto near = hn::Set(d, touch_ * (1 - 1e-4f));
    const unsigned overlapping = met & bitsOf(d, hn::Lt(distance, near));
    places.apart |= (met & ~overlapping) << lane;
    places.overlapping |= overlapping << lane;
    store(dx, originX_, places.column + lane);
    store(dy, originY_, places.row + lane);
    if (overlapping != 0)
    {
      store(dz, originZ_, places.level + lane);
    }
  }

  void store(hn::Vec<Floats> offset, float origin, std::int32_t* places) const
  {
    const Floats d;
    const hn::RebindToSigned<Floats> di;
    const auto place = hn::MulAdd(offset, hn::Set(d, scale_), hn::Set(d, origin));
    hn::Store(hn::ConvertTo(di, place), di, places);
  }

  const ProjectedSphere& receiver_;
  float touch_, scale_, originX_, originY_, originZ_;
};

/// Takes what the occluders of a chunk hide; false if nothing is left. That is asked at the end
/// only, so that the loads need not wait for each other.
inline bool lookUp(const OffsetMasks& masks, const TablePlaces& places, GroupMask* mask)
{
  const Masks d;
  bool open = false;
  for (std::size_t g = 0; g < OffsetMasks::Groups; g += hn::Lanes(d))
  {
    const auto besides = [&](std::size_t i)
    { return hn::LoadU(d, masks.at(places.column[i], places.row[i]) + g); };
    const auto above = [&](std::size_t i)
    { return hn::LoadU(d, masks.above(places.level[i]) + g); };
    auto left = hn::LoadU(d, mask + g);
    forEachBit(places.apart, [&](std::size_t i) { left = hn::And(left, besides(i)); });
    forEachBit(places.overlapping,
      [&](std::size_t i) { left = hn::And(left, hn::Or(besides(i), above(i))); });
    hn::StoreU(left, d, mask + g);
    open = open || !hn::AllTrue(d, hn::Eq(left, hn::Zero(d)));
  }
  return open;
}

bool behindEqual(
  const OffsetMasks& masks, OccluderList occluders, const ProjectedSphere& r, GroupMask* mask)
{
  const TableLookup lookup(masks, r);
  TablePlaces places;
  for (int index = occluders.first; index != OccluderList::Empty;)
  {
    const OccluderChunk& chunk = occluders.chunks[index];
    lookup.find(chunk, places);
    if ((places.apart | places.overlapping) != 0 && !lookUp(masks, places, mask))
    {
      return false;
    }
    index = chunk.next;
  }
  return true;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(behindEqual);

bool hideBehindEqual(const OffsetMasks& masks, OccluderList occluders,
  const ProjectedSphere& receiver, GroupMask* mask)
{
  return HWY_DYNAMIC_DISPATCH(behindEqual)(masks, occluders, receiver, mask);
}
}
#endif
