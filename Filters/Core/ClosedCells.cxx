// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ClosedCells.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

#ifndef po_ClosedCells_cxx
#define po_ClosedCells_cxx
namespace po
{
namespace
{
constexpr float Open = -HUGE_VALF;

/// Cells to each side that a receiver may reach from the cell of its centre.
constexpr int Reach = ClosedCells::CellsPerReach;

/// In cells: smaller discs cover none.
constexpr float LeastRadius = 0.7f;

/// How much lower than its highest point a receiver is in cells so far away, at least, along one of
/// the two axes: see ClosedCells::finish().
using Drops = std::array<float, Reach + 1>;

[[maybe_unused]] BlockBits firstBits(std::size_t count)
{
  return count == ProjectedBlock::Capacity ? ~BlockBits(0) : (BlockBits(1) << count) - 1;
}
}
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// As many columns as most discs reach.
using Cells = hn::CappedTag<float, 2 * Reach>;

/// In cells.
struct CellDisc
{
  float x, y, radius, z;
};

/// Columns [left, right) of rows [bottom, top).
struct CellRange
{
  int left, right, bottom, top;
};

/// What a disc covers wholly lies within. One range serves all that are as large as receivers and
/// lie inside: it takes less time to look at a few cells more than to guess how many there are.
inline CellRange rangeOf(const CellDisc& disc, const CellGrid& grid)
{
  const auto isInside = [](float place, int cells)
  { return place >= Reach && place < static_cast<float>(cells - Reach); };
  if (disc.radius <= Reach && isInside(disc.x, grid.columns) && isInside(disc.y, grid.rows))
  {
    const int column = static_cast<int>(disc.x);
    const int row = static_cast<int>(disc.y);
    return { column - Reach + 1, column + Reach, row - Reach + 1, row + Reach };
  }
  // A large disc may reach beyond all integers.
  const auto limit = [](float place, int end)
  { return static_cast<int>(std::clamp(place, 0.0f, static_cast<float>(end))); };
  return { limit(disc.x - disc.radius, grid.columns), limit(disc.x + disc.radius, grid.columns),
    limit(disc.y - disc.radius, grid.rows), limit(disc.y + disc.radius, grid.rows) };
}

/// Distances, squared, of a place from the farther edges of columns or rows.
inline hn::Vec<Cells> squaresToEdges(float place, int first)
{
  const Cells d;
  const auto middle = hn::Iota(d, static_cast<float>(first) + 0.5f);
  const auto distance = hn::Add(hn::Abs(hn::Sub(middle, hn::Set(d, place))), hn::Set(d, 0.5f));
  return hn::Mul(distance, distance);
}

inline void raise(float* cells, hn::Vec<Cells> height, hn::Mask<Cells> covered)
{
  const Cells d;
  const auto known = hn::LoadU(d, cells);
  hn::StoreU(hn::IfThenElse(covered, hn::Max(known, height), known), d, cells);
}

/// A cell is covered if its farthest corner is.
inline void closeDisc(const CellDisc& disc, const CellGrid& grid, float* up, float* down)
{
  const Cells d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const CellRange range = rangeOf(disc, grid);
  const auto z = hn::Set(d, disc.z);
  const auto square = hn::Set(d, disc.radius * disc.radius);
  HWY_ALIGN float mostAcross[hn::MaxLanes(d)]; // of each row
  for (int first = range.bottom; first < range.top; first += lanes)
  {
    hn::Store(hn::Sub(square, squaresToEdges(disc.y, first)), d, mostAcross);
    const int count = std::min(range.top - first, lanes);
    for (int column = range.left; column < range.right; column += lanes)
    {
      const auto present = hn::FirstN(d, static_cast<std::size_t>(grid.columns - column));
      const auto across =
        hn::IfThenElse(present, squaresToEdges(disc.x, column), hn::Set(d, HUGE_VALF));
      for (int i = 0; i < count; ++i)
      {
        const auto covered = hn::Le(across, hn::Set(d, mostAcross[i]));
        const std::ptrdiff_t cell = (first + i) * grid.columns + column;
        raise(up + cell, z, covered);
        raise(down + cell, hn::Neg(z), covered);
      }
    }
  }
}

void closeAll(const ProjectedBlock& spheres, const CellGrid& grid, float* up, float* down)
{
  for (std::size_t i = 0; i < spheres.count; ++i)
  {
    // A little less than the disc: rounding may then cost time, but never a wrong answer.
    const CellDisc disc{ (spheres.x[i] - grid.lowX) * grid.perCell,
      (spheres.y[i] - grid.lowY) * grid.perCell, spheres.radius[i] * grid.perCell * (1 - 1e-5f),
      spheres.z[i] };
    if (disc.radius >= LeastRadius)
    {
      closeDisc(disc, grid, up, down);
    }
  }
}

/// For `count` cells the least height of those around them, `step` apart, where those farther away
/// count for more.
inline void lowestAround(
  const float* heights, int step, std::size_t count, const Drops& drops, float* result)
{
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
  {
    const float* middle = heights + i;
    auto lowest = hn::LoadU(d, middle);
    for (int k = 1; k <= Reach; ++k)
    {
      const auto before = hn::LoadU(d, middle - k * step);
      const auto behind = hn::LoadU(d, middle + k * step);
      const auto drop = hn::Set(d, drops[static_cast<std::size_t>(k)]);
      lowest = hn::Min(lowest, hn::Add(hn::Min(before, behind), drop));
    }
    hn::StoreU(lowest, d, result + i);
  }
}

void lookAround(
  const CellGrid& grid, const Drops& drops, CellHeights& heights, std::vector<float>& alongRows)
{
  const auto inner = static_cast<std::size_t>(grid.columns - 2 * Reach);
  for (int row = 0; row < grid.rows; ++row)
  {
    const int first = row * grid.columns + Reach;
    lowestAround(heights.closed.data() + first, 1, inner, drops, alongRows.data() + first);
  }
  for (int row = Reach; row < grid.rows - Reach; ++row)
  {
    const int first = row * grid.columns + Reach;
    lowestAround(
      alongRows.data() + first, grid.columns, inner, drops, heights.around.data() + first);
  }
}

/// Receivers whose highest points are below the height of the cell of their centre.
HiddenSpheres findBelow(
  const ProjectedBlock& spheres, const CellGrid& grid, const float* up, const float* down)
{
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const auto cellOf = [&](const float* places, float low)
  {
    const auto offset =
      hn::Mul(hn::Sub(hn::LoadU(d, places), hn::Set(d, low)), hn::Set(d, grid.perCell));
    // Clamped before it is an integer, with a cell to spare on either side.
    return hn::ConvertTo(di,
      hn::Min(hn::Max(offset, hn::Zero(d)), hn::Set(d, float(std::max(grid.columns, grid.rows)))));
  };
  const auto within = [&](auto cell, int cells) {
    return hn::And(hn::Gt(cell, hn::Set(di, Reach - 1)), hn::Lt(cell, hn::Set(di, cells - Reach)));
  };
  HiddenSpheres hidden;
  for (std::size_t i = 0; i < spheres.count; i += hn::Lanes(d))
  {
    const auto column = cellOf(spheres.x.data() + i, grid.lowX);
    const auto row = cellOf(spheres.y.data() + i, grid.lowY);
    const auto known = hn::And(within(column, grid.columns), within(row, grid.rows));
    const auto cell = hn::Add(hn::Mul(row, hn::Set(di, grid.columns)), column);
    const auto place = hn::IfThenElseZero(known, cell);
    const auto z = hn::LoadU(d, spheres.z.data() + i);
    const auto radius = hn::LoadU(d, spheres.radius.data() + i);
    const auto bits = [&](hn::Vec<Floats> top, const float* heights)
    {
      const auto isBelow = hn::Le(top, hn::GatherIndex(d, heights, place));
      return BlockBits(bitsOf(d, hn::And(isBelow, hn::RebindMask(d, known)))) << i;
    };
    hidden.upward |= bits(hn::Add(radius, z), up);
    hidden.downward |= bits(hn::Sub(radius, z), down);
  }
  const BlockBits present = firstBits(spheres.count);
  return { hidden.upward & present, hidden.downward & present };
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(closeAll);
HWY_EXPORT(lookAround);
HWY_EXPORT(findBelow);

namespace
{
constexpr float MostCells = 512;       ///< along a side
constexpr float Margin = 4;            ///< in reaches: halo spheres, two away, reach one farther
constexpr std::size_t BeyondLast = 32; ///< what vectors reach
}

void ClosedCells::begin(const PatchArea& area, float reach)
{
  const float width = area.highX - area.lowX + 2 * Margin * reach;
  const float height = area.highY - area.lowY + 2 * Margin * reach;
  reach_ = reach;
  // A little more than a share of the reach: rounding must not let a receiver reach one cell more.
  const float cell =
    std::max(reach / CellsPerReach * (1 + 1e-4f), std::max(width, height) / MostCells);
  const auto along = [cell](float length)
  { return std::max(static_cast<int>(std::ceil(length / cell)), 2 * Reach + 1); };
  grid_ = { area.lowX - Margin * reach, area.lowY - Margin * reach, cell, 1 / cell, along(width),
    along(height) };
  const std::size_t cells =
    static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows) + BeyondLast;
  for (CellHeights* heights : { &up_, &down_ })
  {
    heights->closed.assign(cells, Open);
    heights->around.resize(cells);
  }
  alongRows_.resize(cells);
}

void ClosedCells::close(const ProjectedBlock& spheres)
{
  HWY_DYNAMIC_DISPATCH(closeAll)(spheres, grid_, up_.closed.data(), down_.closed.data());
}

/// Finds for every cell how high the highest point of a receiver may be, whose centre lies there,
/// for it to be hidden. At a distance a from its centre a sphere of radius r is lower than its
/// highest point by r - sqrt(r^2 - a^2), at least a^2 / 2 r = x^2 / 2 r + y^2 / 2 r. These terms
/// are added to the heights of closed cells, along rows and then along columns, and the least sum
/// counts.
void ClosedCells::finish()
{
  Drops drops;
  for (int k = 0; k <= Reach; ++k)
  {
    const float gap = std::min(static_cast<float>(std::max(k - 1, 0)) * grid_.cell, reach_);
    drops[static_cast<std::size_t>(k)] = gap * gap / (2 * reach_);
  }
  for (CellHeights* heights : { &up_, &down_ })
  {
    HWY_DYNAMIC_DISPATCH(lookAround)(grid_, drops, *heights, alongRows_);
  }
}

HiddenSpheres ClosedCells::hidden(const ProjectedBlock& spheres) const
{
  return HWY_DYNAMIC_DISPATCH(findBelow)(spheres, grid_, up_.around.data(), down_.around.data());
}
}
#endif
