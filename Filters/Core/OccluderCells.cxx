// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderCells.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr float CellWidth = 4;    ///< in radii of a receiver halfway between the extremes
constexpr float MostCells = 128;  ///< along a side
constexpr float WideOccluder = 4; ///< radius in cells from which on an occluder is wide
constexpr float Infinity = HUGE_VALF;
}

void OccluderCells::begin(const DepthTile& tile, const SweepScene::Band& band)
{
  const float typical = 0.5f * (band.smallestRadius + band.largestRadius);
  reach_ = band.largestRadius;
  lowX_ = tile.x;
  lowY_ = tile.y;
  cell_ = std::max(CellWidth * typical, tile.width / MostCells);
  perCell_ = 1 / cell_;
  side_ = static_cast<int>(std::ceil(tile.width / cell_));
  heads_.assign(
    static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), OccluderList::Empty);
  wide_ = OccluderList::Empty;
  used_ = 0;
}

int OccluderCells::cellIndex(float offset) const
{
  // Clamped before it is an integer: a large sphere may reach beyond all of them.
  return static_cast<int>(std::clamp(offset * perCell_, 0.0f, static_cast<float>(side_ - 1)));
}

void OccluderCells::append(int& head, const ProjectedSphere& sphere)
{
  if (head == OccluderList::Empty ||
    chunks_[static_cast<std::size_t>(head)].count == OccluderChunk::Size)
  {
    if (used_ == chunks_.size())
    {
      chunks_.resize(std::max<std::size_t>(64, 2 * used_));
    }
    OccluderChunk& chunk = chunks_[used_];
    chunk.x.fill(Infinity);
    chunk.y.fill(Infinity);
    chunk.count = 0;
    chunk.next = head;
    head = static_cast<int>(used_++);
  }
  OccluderChunk& chunk = chunks_[static_cast<std::size_t>(head)];
  chunk.x[chunk.count] = sphere.x;
  chunk.y[chunk.count] = sphere.y;
  chunk.z[chunk.count] = sphere.z;
  chunk.radius[chunk.count] = sphere.radius;
  ++chunk.count;
}

void OccluderCells::insert(const ProjectedSphere& sphere)
{
  if (sphere.radius > WideOccluder * cell_)
  {
    append(wide_, sphere);
    return;
  }
  const float x = sphere.x - lowX_;
  const float y = sphere.y - lowY_;
  const float reach = (sphere.radius + reach_) * (1 + 1e-5f) + cell_ * 1e-5f;
  const int left = cellIndex(x - reach);
  const int right = cellIndex(x + reach);
  const int bottom = cellIndex(y - reach);
  const int top = cellIndex(y + reach);
  // Corners that the reach just misses are not told apart: that would cost more than it saves.
  for (int row = bottom; row <= top; ++row)
  {
    for (int column = left; column <= right; ++column)
    {
      append(heads_[cellAt(row, column)], sphere);
    }
  }
}
}
