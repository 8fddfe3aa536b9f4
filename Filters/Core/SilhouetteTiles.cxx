// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteTiles.h"

#include "SilhouetteEdges.h"

#include <hwy/base.h>

#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

namespace po
{
namespace
{
/// The range of tiles [x0, x1) x [y0, y1) of an image of so many columns, as far as they lie in it.
DepthRange rangeOf(
  const std::vector<DepthRange>& ranges, int columns, int x0, int x1, int y0, int y1)
{
  const int rows = static_cast<int>(ranges.size()) / columns;
  DepthRange range;
  for (int y = std::max(0, y0); y < std::min(rows, y1); ++y)
  {
    for (int x = std::max(0, x0); x < std::min(columns, x1); ++x)
    {
      range.add(ranges[static_cast<std::size_t>(y) * columns + x]);
    }
  }
  return range;
}

/// Calls f(number of pixels) for the pixels of a tile's row inside of the picture: a number that
/// the compiler knows where it can.
template <typename Function>
void withColumns(int left, const Function& f)
{
  if (left >= DepthTileSize)
  {
    f(std::integral_constant<int, DepthTileSize>());
  }
  else
  {
    f(left);
  }
}

/// Copies row j of a tile to an image that may be empty.
template <typename T>
void copyRow(
  const TileLines::Pixels<T>& from, int tileX, int tileY, int j, int width, std::vector<T>& to)
{
  if (to.empty())
  {
    return;
  }
  const int x = tileX * DepthTileSize, y = tileY * DepthTileSize + j;
  T* target = to.data() + static_cast<std::ptrdiff_t>(y) * width + x;
  const T* row = from.data() + TileLines::indexOf(0, j);
  withColumns(width - x,
    [&](auto count) { std::memcpy(target, row, sizeof(T) * static_cast<std::size_t>(count)); });
}

void clearRows(std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image)
{
  const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
  for (; rows != 0; rows &= rows - 1)
  {
    const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
    float* row = image.strength.data() + static_cast<std::ptrdiff_t>(y + j) * image.width + x;
    withColumns(image.width - x, [row](auto count) { std::fill_n(row, int(count), 0.0F); });
  }
}

/// Can there be an edge somewhere in `behind`, and what it lies behind in `front`, which has
/// geometry? May err towards yes.
bool mayHaveEdge(const SilhouetteRule& rule, DepthRange behind, const DepthRange& front)
{
  if (behind.background && rule.backgroundLines)
  {
    if (!std::isfinite(rule.background))
    {
      return true;
    }
    behind.add(rule.background);
  }
  const double nearest = front.background && rule.backgroundLines
    ? std::min(front.nearest, rule.background)
    : front.nearest;
  // Depths are searched as floats relative to the nearest, which may round the difference up.
  return (behind.farthest - nearest) * (1 + 1e-6) > smallestStep(rule);
}
}

std::vector<int> tilesToSearch(const std::vector<DepthRange>& ranges, const SilhouetteRule& rule,
  int reach, SilhouetteImage& image, bool skipTiles)
{
  const int columns = depthTiles(image.width), rows = depthTiles(image.height);
  std::vector<int> searched;
  std::vector<DepthRange> threeRows(static_cast<std::size_t>(columns));
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      threeRows[static_cast<std::size_t>(x)] = rangeOf(ranges, columns, x, x + 1, y - 1, y + 2);
    }
    for (int x = 0; x < columns; ++x)
    {
      const DepthRange around = rangeOf(threeRows, columns, x - 1, x + 2, 0, 1);
      // An edge lies behind its jump: here, unless its line may come from beside the tile.
      const DepthRange& behind =
        reach > 0 ? around : ranges[static_cast<std::size_t>(y) * columns + x];
      if (around.hasGeometry() && !rule.drawsNothing() &&
        (!skipTiles || mayHaveEdge(rule, behind, around)))
      {
        searched.push_back(y * columns + x);
      }
      else
      {
        clearTile(x, y, image);
      }
    }
  }
  return searched;
}

SearchedTile searchedTile(const DepthSource& source, int tile, int reach)
{
  const int columns = depthTiles(source.width()), x = tile % columns, y = tile / columns;
  const int left = x * DepthTileSize, bottom = y * DepthTileSize;
  return { x, y, rangeOf(source.ranges(), columns, x - 1, x + 2, y - 1, y + 2),
    intersect({ 0, 0, source.width(), source.height() },
      { left - reach, bottom - reach, left + DepthTileSize + reach,
        bottom + DepthTileSize + reach }) };
}

void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts)
{
  const auto pixels = static_cast<std::size_t>(source.width()) * source.height();
  if (image.width != source.width() || image.height != source.height())
  {
    image.width = source.width();
    image.height = source.height();
    image.strength.assign(pixels, 0);
    image.tileRows.assign(
      static_cast<std::size_t>(depthTiles(image.width)) * depthTiles(image.height), 0);
  }
  image.front.resize(findFronts ? pixels : 0);
}

void clearTile(int tileX, int tileY, SilhouetteImage& image)
{
  std::uint16_t& had =
    image.tileRows[static_cast<std::size_t>(tileY) * depthTiles(image.width) + tileX];
  clearRows(had, tileX, tileY, image);
  had = 0;
}

void writeRows(
  const TileLines& lines, std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image)
{
  std::uint16_t& had =
    image.tileRows[static_cast<std::size_t>(tileY) * depthTiles(image.width) + tileX];
  clearRows(had & ~rows, tileX, tileY, image);
  had = static_cast<std::uint16_t>(rows);
  for (; rows != 0; rows &= rows - 1)
  {
    const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
    copyRow(lines.strength, tileX, tileY, j, image.width, image.strength);
    copyRow(lines.front, tileX, tileY, j, image.width, image.front);
    copyRow(lines.inside, tileX, tileY, j, image.width, image.inside);
  }
}
}
