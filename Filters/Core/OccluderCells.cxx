// SPDX-License-Identifier: BSD-3-Clause
#include "OccluderCells.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr float CellWidth = 1;    ///< in reaches
constexpr float MostCells = 64;   ///< along a side
constexpr float WideOccluder = 8; ///< radius in cells from which on an occluder is wide
}

void OccluderCells::begin(const DepthTile& tile, float reach)
{
  // Halo spheres, with centres up to two reaches outside, look into the cells too.
  const float width = tile.width + 4 * reach;
  reach_ = reach;
  lowX_ = tile.x - 2 * reach;
  lowY_ = tile.y - 2 * reach;
  cell_ = std::max(CellWidth * reach, width / MostCells);
  side_ = static_cast<int>(std::ceil(width / cell_));
  const auto count = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  cells_.resize(std::max(cells_.size(), count));
  std::for_each(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count),
    [](std::vector<Entry>& cell) { cell.clear(); });
  wide_.clear();
}

int OccluderCells::cellIndex(float offset) const
{
  return std::clamp(static_cast<int>(offset / cell_), 0, side_ - 1);
}

void OccluderCells::insert(const ProjectedSphere& sphere)
{
  const Entry entry{ sphere.x, sphere.y, sphere.z, sphere.radius };
  if (sphere.radius > WideOccluder * cell_)
  {
    wide_.push_back(entry);
    return;
  }
  const float x = sphere.x - lowX_;
  const float y = sphere.y - lowY_;
  const float reach = (sphere.radius + reach_) * (1 + 1e-5f);
  const int left = cellIndex(x - reach);
  const int right = cellIndex(x + reach);
  const int bottom = cellIndex(y - reach);
  const int top = cellIndex(y + reach);
  // A halo sphere's centre may lie outside of all cells by rounding; it is looked up in the
  // outermost cell, which therefore counts as endless.
  const auto gap = [this](float position, int cell)
  {
    const float low = cell == 0 ? -HUGE_VALF : static_cast<float>(cell) * cell_;
    const float high = cell == side_ - 1 ? HUGE_VALF : static_cast<float>(cell + 1) * cell_;
    return std::max({ low - position, position - high, 0.0f });
  };
  for (int row = bottom; row <= top; ++row)
  {
    const float gapY = gap(y, row);
    for (int column = left; column <= right; ++column)
    {
      const float gapX = gap(x, column);
      if (gapX * gapX + gapY * gapY <= reach * reach)
      {
        cells_[static_cast<std::size_t>(row * side_ + column)].push_back(entry);
      }
    }
  }
}
}
