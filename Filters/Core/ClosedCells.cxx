// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedCells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

/// How much lower than its highest point a receiver is in cells so far away, at least, along one of
/// the two axes: see ClosedCells::finish().
using Drops = std::array<float, 2 * Reach + 1>;

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

using Cells = hn::CappedTag<float, 8>;
using Columns = hn::RebindToSigned<Cells>;
constexpr int MostRows = 8;

/// In cells.
struct CellDisc
{
  float x, y, radius, z;
};

/// Columns [left, right) of some rows.
struct RowSpans
{
  HWY_ALIGN std::int32_t left[MostRows];
  HWY_ALIGN std::int32_t right[MostRows];
};

/// The cells that a disc covers wholly, of as many rows as a vector has lanes.
inline void findSpans(const CellDisc& disc, int row, int columns, RowSpans& spans)
{
  const Cells d;
  const Columns di;
  const auto zero = hn::Zero(d);
  const auto end = hn::Set(d, static_cast<float>(columns));
  // A large disc may reach beyond all integers.
  const auto within = [&](hn::Vec<Cells> place)
  { return hn::ConvertTo(di, hn::Min(hn::Max(place, zero), end)); };
  const auto x = hn::Set(d, disc.x);
  const auto y = hn::Set(d, disc.y);
  const auto edge = hn::Iota(d, static_cast<float>(row));
  const auto toTop = hn::Sub(hn::Add(edge, hn::Set(d, 1.0f)), y);
  const auto dy = hn::Max(hn::Sub(y, edge), toTop); // to the farther edge of the row
  const auto square = hn::Sub(hn::Set(d, disc.radius * disc.radius), hn::Mul(dy, dy));
  const auto halfWidth = hn::Sqrt(hn::Max(square, zero));
  const auto first = hn::Sub(x, halfWidth);
  const auto begins = hn::RebindMask(di, hn::Gt(first, zero));
  const auto next = hn::Add(within(first), hn::Set(di, 1));
  hn::Store(hn::IfThenElseZero(begins, next), di, spans.left);
  hn::Store(within(hn::Add(x, halfWidth)), di, spans.right);
}

/// Raises heights of cells that are lower, of the lanes that are set.
inline void raise(float* cells, float height, hn::Mask<Cells> lanes)
{
  const Cells d;
  const auto known = hn::LoadU(d, cells);
  const auto raised = hn::And(lanes, hn::Lt(known, hn::Set(d, height)));
  if (!hn::AllFalse(d, raised))
  {
    hn::StoreU(hn::IfThenElse(raised, hn::Set(d, height), known), d, cells);
  }
}

inline void closeDisc(const CellDisc& disc, const CellGrid& grid, float* up, float* down)
{
  const Cells d;
  const auto limit = [](float place, int end) { return std::clamp(place, 0.0f, float(end)); };
  const float lowest = disc.y - disc.radius;
  const int bottom = lowest > 0 ? static_cast<int>(limit(lowest, grid.rows)) + 1 : 0;
  const int top = static_cast<int>(limit(disc.y + disc.radius, grid.rows));
  RowSpans spans;
  for (int first = bottom; first < top; first += static_cast<int>(hn::Lanes(d)))
  {
    findSpans(disc, first, grid.columns, spans);
    const int count = std::min(top - first, static_cast<int>(hn::Lanes(d)));
    for (int i = 0; i < count; ++i)
    {
      const int row = (first + i) * grid.columns;
      for (int column = spans.left[i]; column < spans.right[i];
           column += static_cast<int>(hn::Lanes(d)))
      {
        const int lanes = std::min(spans.right[i] - column, static_cast<int>(hn::Lanes(d)));
        const auto covered = hn::FirstN(d, static_cast<std::size_t>(lanes));
        raise(up + row + column, disc.z, covered);
        raise(down + row + column, -disc.z, covered);
      }
    }
  }
}

/// The same for a disc of the size of the stamps. Those that may reach beyond the grid close
/// nothing: all receivers are farther inside.
inline void stampDisc(
  const CellDisc& disc, const DiscStamps& stamps, const CellGrid& grid, float* up, float* down)
{
  constexpr int half = DiscStamps::Side / 2;
  const auto isWithin = [](float place, int cells)
  { return place >= half && place < static_cast<float>(cells - half); };
  if (!isWithin(disc.x, grid.columns) || !isWithin(disc.y, grid.rows))
  {
    return;
  }
  const Cells d;
  const auto column = static_cast<int>(disc.x);
  const auto row = static_cast<int>(disc.y);
  const auto phase = [](float place, int cell)
  { return static_cast<int>((place - static_cast<float>(cell)) * DiscStamps::Phases); };
  const float* stamp = stamps.at(phase(disc.x, column), phase(disc.y, row));
  const std::ptrdiff_t corner = (row - half) * grid.columns + column - half;
  const auto z = hn::Set(d, disc.z);
  const auto raise = [d](float* cells, hn::Vec<Cells> heights)
  { hn::StoreU(hn::Max(hn::LoadU(d, cells), heights), d, cells); };
  for (int i = 0; i < DiscStamps::Side; ++i)
  {
    for (std::size_t lane = 0; lane < DiscStamps::Stride; lane += hn::Lanes(d))
    {
      const auto covered = hn::LoadU(d, stamp + i * DiscStamps::Stride + lane);
      const auto cell = corner + i * grid.columns + static_cast<std::ptrdiff_t>(lane);
      raise(up + cell, hn::Add(covered, z));
      raise(down + cell, hn::Sub(covered, z));
    }
  }
}

void closeAll(const ProjectedBlock& spheres, const CellGrid& grid, const DiscStamps& stamps,
  float* up, float* down)
{
  for (std::size_t i = 0; i < spheres.count; ++i)
  {
    // A little less than the disc: rounding may then cost time, but never a wrong answer.
    const CellDisc disc{ (spheres.x[i] - grid.lowX) * grid.perCell,
      (spheres.y[i] - grid.lowY) * grid.perCell, spheres.radius[i] * grid.perCell * (1 - 1e-5f),
      spheres.z[i] };
    if (stamps.fit(disc.radius))
    {
      stampDisc(disc, stamps, grid, up, down);
    }
    else
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
    auto lowest = hn::Set(d, HUGE_VALF);
    for (int k = -Reach; k <= Reach; ++k)
    {
      const auto drop = hn::Set(d, drops[static_cast<std::size_t>(k + Reach)]);
      const float* neighbours = heights + static_cast<std::ptrdiff_t>(i) + k * step;
      lowest = hn::Min(lowest, hn::Add(hn::LoadU(d, neighbours), drop));
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

/// Does a disc about (x, y) hold a square cell?
bool holds(float x, float y, float radius, int column, int row)
{
  const auto farther = [](float place, int cell)
  {
    const auto low = static_cast<float>(cell);
    return std::max(std::abs(place - low), std::abs(place - low - 1));
  };
  const float dx = farther(x, column);
  const float dy = farther(y, row);
  return dx * dx + dy * dy <= radius * radius;
}
}

void DiscStamps::build(float radius)
{
  if (radius == radius_)
  {
    return;
  }
  radius_ = radius;
  // The centre may be off the middle of its phase.
  const float least = radius - std::sqrt(0.5f) / Phases;
  const auto middle = [](int phase)
  { return static_cast<float>(Side / 2) + (static_cast<float>(phase) + 0.5f) / Phases; };
  float* cell = cells_.data();
  for (int phase = 0; phase < Phases * Phases; ++phase)
  {
    for (int i = 0; i < Side * Stride; ++i, ++cell)
    {
      const float x = middle(phase % Phases);
      const float y = middle(phase / Phases);
      *cell = holds(x, y, least, i % Stride, i / Stride) ? 0 : Open;
    }
  }
}

void ClosedCells::begin(const PatchArea& area, float smallest, float reach)
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
  stamps_.build(smallest * grid_.perCell * (1 - 1e-5f));
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
  HWY_DYNAMIC_DISPATCH(closeAll)(spheres, grid_, stamps_, up_.closed.data(), down_.closed.data());
}

/// Finds for every cell how high the highest point of a receiver may be, whose centre lies there,
/// for it to be hidden. At a distance a from its centre a sphere of radius r is lower than its
/// highest point by r - sqrt(r^2 - a^2), at least a^2 / 2 r = x^2 / 2 r + y^2 / 2 r. These terms
/// are added to the heights of closed cells, along rows and then along columns, and the least sum
/// counts.
void ClosedCells::finish()
{
  Drops drops;
  for (int k = -Reach; k <= Reach; ++k)
  {
    const float gap =
      std::min(static_cast<float>(std::max(std::abs(k) - 1, 0)) * grid_.cell, reach_);
    drops[static_cast<std::size_t>(k + Reach)] = gap * gap / (2 * reach_);
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
