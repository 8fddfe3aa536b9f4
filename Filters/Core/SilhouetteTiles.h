// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteTiles_h
#define po_SilhouetteTiles_h

#include "SilhouetteFinder.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <vector>

/// The loop over tiles that all ways to draw silhouettes share.
namespace po
{
/// The range of tiles [x0, x1) x [y0, y1) of an image of so many columns, as far as they lie in it.
[[nodiscard]] inline DepthRange rangeOf(
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

/// Gives the image the size of the source. What is there stays if it has that size.
void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts);

void clearTile(SilhouetteImage& image, int tileX, int tileY);

/// The tiles that may have lines. Those of the others that had lines before are cleared.
[[nodiscard]] std::vector<int> tilesToSearch(const std::vector<DepthRange>& ranges,
  const SilhouetteRule& rule, SilhouetteImage& image, bool skipTiles);

/// Paints all tiles in parallel, but those that cannot have lines.
///
/// @param makePainter makes what one thread paints with: bool paint(tileX, tileY, range, image)
///   writes the strength of all pixels of a tile, or returns false where it has no lines
template <typename MakePainter>
SilhouetteCounters paintTiles(const DepthSource& source, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options, const MakePainter& makePainter)
{
  resizeFor(image, source, options.findFronts);
  const int columns = depthTiles(image.width);
  const std::vector<DepthRange>& ranges = source.ranges();
  const std::vector<int> searched = tilesToSearch(ranges, rule, image, options.skipTiles);
  const auto paintTile = [&](auto& painter, int tile)
  {
    const int x = tile % columns, y = tile / columns;
    const DepthRange range = rangeOf(ranges, columns, x - 1, x + 2, y - 1, y + 2);
    std::uint8_t& had = image.tileHasLines[static_cast<std::size_t>(tile)];
    const bool lines = painter.paint(x, y, range, image);
    if (!lines && had != 0)
    {
      clearTile(image, x, y);
    }
    had = lines;
  };
  tbb::enumerable_thread_specific<decltype(makePainter())> painters(makePainter);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, searched.size(), 32),
    [&](const tbb::blocked_range<std::size_t>& part)
    {
      auto& painter = painters.local();
      for (std::size_t i = part.begin(); i < part.end(); ++i)
      {
        paintTile(painter, searched[i]);
      }
    });
  const std::size_t tiles = ranges.size();
  return { tiles, tiles - searched.size() };
}
}

#endif
