// SPDX-License-Identifier: BSD-3-Clause
#include "TileSweep.h"

#include "OffsetLookup.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace po
{
namespace
{
/// So many visits before the one that needs it something is fetched from memory.
constexpr std::size_t VisitsAhead = 4;
}

void TileSweep::run(const DepthTile& tile, DepthOrder& order, const SweepScene::Band& band,
  const SweptDirection& direction, SeenMarks& seen)
{
  band_ = band;
  cells_.begin(tile, band);
  listVisited(order, direction);
  const auto indexAt = [this](std::size_t i)
  { return visited_[std::min(i, visited_.size() - 1)]->sphere.index; };
  for (std::size_t i = 0; i < visited_.size(); ++i)
  {
    records_.prefetch(indexAt(i + 2 * VisitsAhead));
    records_.prefetchRims(indexAt(i + VisitsAhead));
    visit(*visited_[i], direction, seen);
  }
  visits_[direction.full ? 1 : 0] += visited_.size();
}

/// Those that are not known to be hidden, from the light downward.
void TileSweep::listVisited(DepthOrder& order, const SweptDirection& direction)
{
  visited_.clear();
  const auto add = [&](const TileSphere& sphere)
  {
    if ((sphere.hidden & direction.bit()) == 0)
    {
      visited_.push_back(&sphere);
    }
  };
  for (std::size_t i = 0; i < order.slabs(); ++i)
  {
    const DepthOrder::Slab slab = order.slab(direction.upward ? order.slabs() - 1 - i : i);
    if (direction.upward)
    {
      std::for_each(
        std::make_reverse_iterator(slab.last), std::make_reverse_iterator(slab.first), add);
    }
    else
    {
      std::for_each(slab.first, slab.last, add);
    }
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
