// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteTiles.h"

#include "SilhouetteEdges.h"

#include <cmath>

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

std::vector<SearchedTiles> tilesToSearch(const std::vector<DepthRange>& ranges,
  const SilhouetteRule& rule, int reach, SilhouetteImage& image, bool skipTiles)
{
  constexpr int Most = SearchedTiles::Most;
  const int columns = depthTiles(image.width), rows = depthTiles(image.height);
  std::vector<SearchedTiles> searched;
  std::vector<DepthRange> threeRows(static_cast<std::size_t>(columns));
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      threeRows[static_cast<std::size_t>(x)] = rangeOf(ranges, columns, x, x + 1, y - 1, y + 2);
    }
    bool follows = false; // the tile to the left is searched
    for (int x = 0; x < columns; ++x)
    {
      const DepthRange around = rangeOf(threeRows, columns, x - 1, x + 2, 0, 1);
      // An edge lies behind its jump: here, unless its line may come from beside the tile.
      const DepthRange& behind =
        reach > 0 ? around : ranges[static_cast<std::size_t>(y) * columns + x];
      const bool isSearched = around.hasGeometry() && !rule.drawsNothing() &&
        (!skipTiles || mayHaveEdge(rule, behind, around));
      if (!isSearched)
      {
        clearTile(x, y, image);
      }
      else if (follows && x % Most != 0)
      {
        ++searched.back().count;
      }
      else
      {
        const int first = x / Most * Most;
        searched.push_back(
          { x, y, 1, rangeOf(threeRows, columns, first - 1, first + Most + 1, 0, 1).nearest });
      }
      follows = isSearched;
    }
  }
  return searched;
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
  clearStrength(tileX, tileY, had, image);
  had = 0;
}
}
