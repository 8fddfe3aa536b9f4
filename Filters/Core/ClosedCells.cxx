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

#ifndef po_ClosedCells_cxx
#define po_ClosedCells_cxx
namespace po
{
namespace
{
constexpr float Open = -HUGE_VALF;

/// Cells [left, right) and rows [bottom, top), in full.
struct CellRange
{
  int left, right, bottom, top;
};

/// In cells.
struct CellDisc
{
  float x, y, radius, z;
};
}
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Cells = hn::CappedTag<float, 8>;
using Columns = hn::RebindToSigned<Cells>;
constexpr int MostLanes = 8;

/// Columns [left, right) of some rows.
struct RowSpans
{
  HWY_ALIGN std::int32_t left[MostLanes];
  HWY_ALIGN std::int32_t right[MostLanes];
};

/// The cells that a disc covers wholly, of as many rows as a vector has lanes.
inline void findSpans(const CellDisc& disc, int row, int side, RowSpans& spans)
{
  const Cells d;
  const Columns di;
  const auto zero = hn::Zero(d);
  const auto end = hn::Set(d, static_cast<float>(side));
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

/// Those of the lanes [0, count).
inline hn::Mask<Cells> firstLanes(int count)
{
  return hn::FirstN(Cells(), static_cast<std::size_t>(std::min(count, MostLanes)));
}

/// Closes the open ones of the columns [left, right); returns how many of them receivers reach.
inline int closeRow(CellGrid& grid, int row, int left, int right, float z)
{
  const Cells d;
  const Columns di;
  float* cells = grid.height.data() + row * grid.side;
  const bool reached = row >= grid.inner && row < grid.side - grid.inner;
  const auto firstReached = hn::Set(di, grid.inner - 1);
  const auto endReached = hn::Set(di, reached ? grid.side - grid.inner : 0);
  std::size_t closed = 0;
  for (int column = left; column < right; column += static_cast<int>(hn::Lanes(d)))
  {
    const auto known = hn::LoadU(d, cells + column);
    // A closed one is higher: z falls.
    const auto open = hn::And(hn::Eq(known, hn::Set(d, Open)), firstLanes(right - column));
    if (hn::AllFalse(d, open))
    {
      continue;
    }
    hn::StoreU(hn::IfThenElse(open, hn::Set(d, z), known), d, cells + column);
    const auto place = hn::Iota(di, column);
    const auto inner = hn::And(hn::Gt(place, firstReached), hn::Lt(place, endReached));
    closed += hn::CountTrue(d, hn::And(open, hn::RebindMask(d, inner)));
  }
  return static_cast<int>(closed);
}

int closeDisc(CellGrid& grid, const CellDisc& disc, int bottom, int top)
{
  RowSpans spans;
  int closed = 0;
  for (int first = bottom; first < top; first += static_cast<int>(hn::Lanes(Cells())))
  {
    findSpans(disc, first, grid.side, spans);
    const int count = std::min(top - first, static_cast<int>(hn::Lanes(Cells())));
    for (int i = 0; i < count; ++i)
    {
      closed += closeRow(grid, first + i, spans.left[i], spans.right[i], disc.z);
    }
  }
  return closed;
}

bool areClosed(const CellGrid& grid, const CellRange& range, float highest)
{
  const Cells d;
  for (int row = range.bottom; row < range.top; ++row)
  {
    const float* cells = grid.height.data() + row * grid.side;
    for (int column = range.left; column < range.right; column += static_cast<int>(hn::Lanes(d)))
    {
      const auto isOpen = hn::Lt(hn::LoadU(d, cells + column), hn::Set(d, highest));
      if (!hn::AllFalse(d, hn::And(isOpen, firstLanes(range.right - column))))
      {
        return false;
      }
    }
  }
  return true;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(closeDisc);
HWY_EXPORT(areClosed);

namespace
{
constexpr float CellWidth = 0.5f;     ///< in reaches
constexpr float MostCells = 256;      ///< along a side
constexpr float Margin = 3;           ///< in reaches: what halo spheres cover
constexpr std::size_t BeyondLast = 8; ///< what vectors reach

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
  const float cell = std::max(CellWidth * reach, width / MostCells);
  perCell_ = 1 / cell;
  cells_.side = static_cast<int>(std::ceil(width / cell));
  const auto side = static_cast<std::size_t>(cells_.side);
  cells_.height.assign(side * side + BeyondLast, Open);
  cells_.inner = static_cast<int>((Margin - 1.01f) * reach / cell);
  const int across = cells_.side - 2 * cells_.inner;
  open_ = across * across;
  lowest_ = Open;
}

void ClosedCells::close(const ProjectedSphere& s)
{
  // A little less than the disc: rounding may then cost time, but never a wrong answer.
  const CellDisc disc{ (s.x - lowX_) * perCell_, (s.y - lowY_) * perCell_,
    s.radius * perCell_ * (1 - 1e-5f), s.z };
  const int bottom = firstWhole(disc.y - disc.radius, cells_.side);
  const int top = within(disc.y + disc.radius, cells_.side);
  const int closed = HWY_DYNAMIC_DISPATCH(closeDisc)(cells_, disc, bottom, top);
  open_ -= closed;
  lowest_ = closed > 0 ? s.z : lowest_;
}

bool ClosedCells::hides(const ProjectedSphere& s) const
{
  const float lowX = s.x - s.radius - lowX_;
  const float lowY = s.y - s.radius - lowY_;
  if (lowX < 0 || lowY < 0)
  {
    return false;
  }
  const int side = cells_.side;
  const auto cellAt = [&](float offset) { return within(offset * perCell_, side); };
  const CellRange range{ cellAt(lowX), cellAt(s.x + s.radius - lowX_) + 1, cellAt(lowY),
    cellAt(s.y + s.radius - lowY_) + 1 };
  return range.right <= side && range.top <= side &&
    HWY_DYNAMIC_DISPATCH(areClosed)(cells_, range, s.z + s.radius);
}
}
#endif
