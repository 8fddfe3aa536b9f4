// SPDX-License-Identifier: BSD-3-Clause
#include "EdgePixels.h"

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "EdgePixels.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using IntegerTag = hn::CappedTag<std::int32_t, EdgeGroup::Size>;
using Tag = hn::Rebind<float, IntegerTag>;

std::uint32_t setEdgePixels(
  const EdgeFinder& finder, const SearchedTile& tile, int width, int height, TileLines& lines)
{
  const Tag d;
  const IntegerTag integers;
  const auto number = [&](int value) { return hn::Set(integers, value); };
  const auto zero = hn::Zero(integers), one = number(1), lanes = hn::Iota(integers, 0);
  const SampleBlock& block = finder.block();
  std::uint32_t rows = 0;
  lines.strength.fill(0);
  for (const EdgeGroup& group : finder.groups())
  {
    const std::uint8_t bits[8] = { static_cast<std::uint8_t>(group.edges) };
    const auto isEdge = hn::LoadMaskBits(d, bits);
    const auto front = hn::LoadU(integers, group.fronts);
    const auto di = hn::Sub(hn::And(front, number(3)), one);
    const auto dj = hn::Sub(hn::ShiftRight<2>(front), one);
    // Beyond the picture its border is repeated.
    const auto column = hn::Add(di, hn::Add(lanes, number(block.x + group.i)));
    const auto row = hn::Add(dj, number(block.y + group.j));
    const auto x = hn::Min(hn::Max(column, zero), number(width - 1));
    const auto y = hn::Min(hn::Max(row, zero), number(height - 1));
    const int tileRow = block.y + group.j - tile.y * DepthTileSize;
    const auto at = static_cast<std::size_t>(
      TileLines::indexOf(block.x + group.i - tile.x * DepthTileSize, tileRow));
    hn::StoreU(hn::IfThenElseZero(isEdge, hn::Set(d, 1.0F)), d, lines.strength.data() + at);
    hn::StoreU(hn::Add(hn::Mul(y, number(width)), x), integers, lines.front.data() + at);
    rows |= 1U << static_cast<unsigned>(tileRow);
  }
  return rows;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(setEdgePixels);

std::uint32_t setEdgePixels(
  const EdgeFinder& finder, const SearchedTile& tile, int width, int height, TileLines& lines)
{
  return HWY_DYNAMIC_DISPATCH(setEdgePixels)(finder, tile, width, height, lines);
}
}
#endif
