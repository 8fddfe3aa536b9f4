// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedCells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
constexpr float CellWidth = 0.5f; ///< in reaches
constexpr float MostCells = 256;  ///< along a side
constexpr float Margin = 3;       ///< in reaches: what halo spheres cover
constexpr float Open = -std::numeric_limits<float>::infinity();
}

void ClosedCells::begin(const DepthTile& tile, float reach)
{
  const float width = tile.width + 2 * Margin * reach;
  reach_ = reach;
  lowX_ = tile.x - Margin * reach;
  lowY_ = tile.y - Margin * reach;
  cell_ = std::max(CellWidth * reach, width / MostCells);
  perCell_ = 1 / cell_;
  side_ = static_cast<int>(std::ceil(width / cell_));
  height_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), Open);
  inner_ = static_cast<int>((Margin - 1.01f) * reach / cell_);
  const int across = side_ - 2 * inner_;
  open_ = across * across;
  lowest_ = Open;
}

void ClosedCells::close(const ProjectedSphere& s)
{
  // A little less than the disc: rounding may then cost time, but never a wrong answer.
  const float radius = s.radius * (1 - 1e-5f);
  const float x = s.x - lowX_;
  const float y = s.y - lowY_;
  const int bottom = std::max(0, cellAt(std::max(0.0f, y - radius)));
  const int top = std::min(side_ - 1, cellAt(std::max(0.0f, y + radius)));
  for (int row = bottom; row <= top; ++row)
  {
    const float dy = std::max(y - static_cast<float>(row) * cell_,
      static_cast<float>(row + 1) * cell_ - y); // to the farther edge of the row
    const float half = radius * radius - dy * dy;
    if (half <= 0)
    {
      continue;
    }
    const float halfWidth = std::sqrt(half);
    const int left = static_cast<int>(std::ceil(std::max(0.0f, (x - halfWidth) * perCell_)));
    const int right = std::min(side_, cellAt(std::max(0.0f, x + halfWidth)));
    float* cells = height_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
    const bool innerRow = row >= inner_ && row < side_ - inner_;
    for (int column = left; column < right; ++column)
    {
      if (cells[column] == Open)
      {
        cells[column] = s.z;
        lowest_ = s.z;
        open_ -= innerRow && column >= inner_ && column < side_ - inner_ ? 1 : 0;
      }
    }
  }
}

bool ClosedCells::hides(const ProjectedSphere& s) const
{
  const float lowX = s.x - s.radius - lowX_;
  const float lowY = s.y - s.radius - lowY_;
  if (lowX < 0 || lowY < 0)
  {
    return false;
  }
  const int left = cellAt(lowX);
  const int right = cellAt(s.x + s.radius - lowX_);
  const int bottom = cellAt(lowY);
  const int top = cellAt(s.y + s.radius - lowY_);
  if (right >= side_ || top >= side_)
  {
    return false;
  }
  const float highest = s.z + s.radius;
  for (int row = bottom; row <= top; ++row)
  {
    const float* cells =
      height_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
    for (int column = left; column <= right; ++column)
    {
      if (cells[column] < highest)
      {
        return false;
      }
    }
  }
  return true;
}
}
