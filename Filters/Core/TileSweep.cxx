// SPDX-License-Identifier: BSD-3-Clause
#include "TileSweep.h"

#include <algorithm>
#include <cmath>

namespace po
{
void TileSweep::run(const DepthTile& tile, float reach, const SweptDirection& direction,
  std::vector<std::uint8_t>& hidden)
{
  if (tile.first == tile.last)
  {
    return;
  }
  const bool bounded = std::isfinite(direction.distance);
  sortByDepth(tile, keys_, order_);
  cells_.begin(tile, reach);
  for (const std::uint32_t index : order_)
  {
    const TileSphere& s = tile.first[index];
    const bool visible = s.role == TileRole::Other || sees(s, direction);
    if (visible || bounded)
    {
      cells_.insert(s.sphere);
    }
    else if (s.role == TileRole::Receiver)
    {
      hidden[s.sphere.id] = 1;
    }
  }
}

bool TileSweep::sees(const TileSphere& s, const SweptDirection& direction)
{
  const FacingTexels& facing = direction.facing;
  const unsigned id = s.sphere.id;
  mask_ = facing.facing;
  if (!passes(cells_.cellOf(s.sphere), s.sphere, direction) ||
    !passes(cells_.wide(), s.sphere, direction) ||
    !records_.clearInside(id, direction.pattern, facing, mask_.data()))
  {
    return false;
  }
  if (s.role == TileRole::Receiver)
  {
    records_.keep(id, direction.index, facing, mask_.data());
  }
  return true;
}

bool TileSweep::passes(const std::vector<OccluderCells::Entry>& occluders,
  const ProjectedSphere& receiver, const SweptDirection& direction)
{
  // A sphere right in front hides most: those first, so that hidden spheres are done with soon.
  constexpr float near = 0.25f;
  return passes(occluders, receiver, direction, 0, near) &&
    passes(occluders, receiver, direction, near, 1);
}

bool TileSweep::passes(const std::vector<OccluderCells::Entry>& occluders,
  const ProjectedSphere& receiver, const SweptDirection& direction, float nearest, float farthest)
{
  const float scale = 1 / receiver.radius;
  const float distance = direction.distance * scale;
  const bool bounded = std::isfinite(direction.distance);
  // The latest is the nearest in depth.
  for (auto o = occluders.rbegin(); o != occluders.rend(); ++o)
  {
    const float dx = o->x - receiver.x;
    const float dy = o->y - receiver.y;
    const float touch = o->radius + receiver.radius;
    const float square = touch * touch;
    const float gap = dx * dx + dy * dy;
    if (gap < nearest * square || gap >= farthest * square)
    {
      continue;
    }
    const float radius = o->radius * scale;
    const Occluder occluder{ dx * scale, dy * scale, (o->z - receiver.z) * scale, radius * radius };
    if (bounded)
    {
      if (occluder.height - radius - 1 < distance &&
        !hideTexelsWithin(direction.facing, occluder, distance, mask_.data()))
      {
        return false;
      }
      continue;
    }
    const float margin = o->radius - receiver.radius;
    const bool covers = margin > 0 && gap < margin * margin && occluder.height >= 1;
    if (covers || !hideTexels(direction.facing, occluder, mask_.data()))
    {
      return false;
    }
  }
  return true;
}
}
