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

/// A position (in cells) within the grid as an integer: a large sphere may reach beyond all
/// integers.
int within(float position, int side)
{
  return static_cast<int>(std::clamp(position, 0.0f, static_cast<float>(side)));
}

/// The first cell that begins at or after a position; `side` or more if there is none.
int firstWhole(float position, int side)
{
  return position > 0 ? within(position, side) + 1 : 0;
}
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
  const float x = (s.x - lowX_) * perCell_;
  const float y = (s.y - lowY_) * perCell_;
  // A little less than the disc: rounding may then cost time, but never a wrong answer.
  const float radius = s.radius * perCell_ * (1 - 1e-5f);
  const int bottom = firstWhole(y - radius, side_);
  const int top = within(y + radius, side_);
  for (int row = bottom; row < top; ++row)
  {
    const float edge = static_cast<float>(row);
    const float dy = std::max(y - edge, edge + 1 - y); // to the farther edge of the row
    const float halfWidth = std::sqrt(std::max(0.0f, radius * radius - dy * dy));
    const int right = within(x + halfWidth, side_);
    closeRow(row, firstWhole(x - halfWidth, side_), right, s.z);
  }
}

void ClosedCells::closeRow(int row, int left, int right, float z)
{
  float* cells = height_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
  const auto across = static_cast<unsigned>(side_ - 2 * inner_);
  const unsigned reached = static_cast<unsigned>(row - inner_) < across ? across : 0;
  unsigned closed = 0;
  for (int column = left; column < right; ++column)
  {
    const bool open = cells[column] == Open;
    cells[column] = open ? z : cells[column]; // a closed one is higher: z falls
    closed += unsigned(open) & unsigned(static_cast<unsigned>(column - inner_) < reached);
  }
  open_ -= static_cast<int>(closed);
  lowest_ = closed > 0 ? z : lowest_;
}

int ClosedCells::cellAt(float offset) const
{
  return within(offset * perCell_, side_);
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
