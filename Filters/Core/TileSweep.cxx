// SPDX-License-Identifier: BSD-3-Clause
#include "TileSweep.h"

#include "OffsetLookup.h"

#include <algorithm>
#include <cmath>

namespace po
{
void TileSweep::run(const DepthTile& tile, DepthOrder& order, const SweepScene::Band& band,
  const SweptDirection& direction, SeenMarks& seen)
{
  band_ = band;
  cells_.begin(tile, band);
  const std::size_t slabs = order.slabs();
  const auto slabAt = [&](std::size_t i)
  { return order.slab(direction.upward ? slabs - 1 - i : i); };
  const auto forEach = [&direction](const DepthOrder::Slab& slab, const auto& action)
  {
    const auto count = static_cast<std::size_t>(slab.last - slab.first);
    for (std::size_t k = 0; k < count; ++k)
    {
      const TileSphere& sphere =
        direction.upward ? slab.last[-1 - static_cast<std::ptrdiff_t>(k)] : slab.first[k];
      if ((sphere.hidden & direction.bit()) == 0)
      {
        action(sphere);
      }
    }
  };
  DepthOrder::Slab next = slabAt(0);
  for (std::size_t i = 0; i < slabs; ++i)
  {
    const DepthOrder::Slab slab = next;
    next = slabAt(std::min(i + 1, slabs - 1));
    forEach(next, [this](const TileSphere& s) { records_.prefetch(s.sphere.index); });
    forEach(slab, [this](const TileSphere& s) { records_.prefetchRims(s.sphere.index); });
    forEach(slab,
      [&](const TileSphere& s)
      {
        ++visits_[direction.full ? 1 : 0];
        visit(s, direction, seen);
      });
  }
}

void TileSweep::visit(const TileSphere& s, const SweptDirection& direction, SeenMarks& seen)
{
  const bool bounded = std::isfinite(direction.distance);
  ProjectedSphere sphere = s.sphere;
  sphere.z = direction.upward ? sphere.z : -sphere.z;
  if (s.receives)
  {
    const Sight sight = look(sphere, direction);
    if (sight == Sight::Nothing && !bounded)
    {
      return;
    }
    if (sight == Sight::Surface)
    {
      seen[sphere.index] = static_cast<std::uint8_t>(seen[sphere.index] | direction.bit());
    }
  }
  else if (sphere.index < band_.first && (seen[sphere.index] & direction.bit()) == 0 && !bounded)
  {
    return;
  }
  cells_.insert(sphere);
}

TileSweep::Sight TileSweep::look(const ProjectedSphere& sphere, const SweptDirection& direction)
{
  std::copy(direction.facing.facing.begin(), direction.facing.facing.end(), mask_.begin());
  if (!records_.clearCovered(sphere.index, mask_.data()) ||
    !passes(cells_.cellOf(sphere), sphere, direction) || !passes(cells_.wide(), sphere, direction))
  {
    return Sight::Nothing;
  }
  records_.prefetchMasks(sphere.index, direction.axis);
  if (!records_.clearInside(sphere.index, direction.pattern, mask_.data()))
  {
    return Sight::Occluder;
  }
  keep(sphere.index, direction);
  return Sight::Surface;
}

/// The mask of the sphere at hand, for those who have listed it.
void TileSweep::keep(unsigned sphere, const SweptDirection& direction)
{
  const GroupMask* facing = direction.facing.facing.data();
  records_.keep(sphere, direction.axis, direction.upward, facing, mask_.data());
  if (division_ != nullptr)
  {
    division_->keep(sphere, direction.axis, direction.upward, facing, mask_.data());
  }
}

bool TileSweep::passes(
  OccluderList occluders, const ProjectedSphere& receiver, const SweptDirection& direction)
{
  const FacingTexels& facing = direction.facing;
  if (occluders.first == OccluderList::Empty)
  {
    return true;
  }
  if (std::isfinite(direction.distance))
  {
    return hideBehindWithin(facing, occluders, receiver, direction.distance, mask_.data());
  }
  return direction.offsetMasks != nullptr
    ? hideBehindEqual(*direction.offsetMasks, occluders, receiver, mask_.data())
    : hideBehind(facing, occluders, receiver, mask_.data());
}
}
