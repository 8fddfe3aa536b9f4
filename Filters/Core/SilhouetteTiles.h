// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteTiles_h
#define po_SilhouetteTiles_h

#include "SilhouetteFinder.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <functional>

/// The loop over tiles that all ways to draw silhouettes share.
namespace po
{
/// The range of a tile and of the tiles around it, in an image of columns x rows tiles.
[[nodiscard]] inline DepthRange rangeAround(
  const std::vector<DepthRange>& ranges, int columns, int rows, int tileX, int tileY)
{
  DepthRange range;
  for (int y = std::max(0, tileY - 1); y < std::min(rows, tileY + 2); ++y)
  {
    for (int x = std::max(0, tileX - 1); x < std::min(columns, tileX + 2); ++x)
    {
      range.add(ranges[static_cast<std::size_t>(y) * columns + x]);
    }
  }
  return range;
}

/// Can there be an edge between depths of this range? May err towards yes.
[[nodiscard]] bool mayHaveEdge(const SilhouetteRule& rule, DepthRange range);

/// Gives the image the size of the source. What is there stays if it has that size.
void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts);

void clearTile(SilhouetteImage& image, int tileX, int tileY);

/// Paints all tiles in parallel, but those that cannot have lines.
///
/// @param makePainter makes what one thread paints with: bool paint(tileX, tileY, range, image)
///   writes the strength of all pixels of a tile, or returns false where it has no lines
template <typename MakePainter>
SilhouetteCounters paintTiles(const DepthSource& source, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options, const MakePainter& makePainter)
{
  resizeFor(image, source, options.findFronts);
  const int columns = depthTiles(image.width), rows = depthTiles(image.height);
  const std::vector<DepthRange>& ranges = source.ranges();
  using Painter = decltype(makePainter());
  tbb::enumerable_thread_specific<Painter> painters(makePainter);
  tbb::enumerable_thread_specific<std::size_t> skipped(0);
  const auto paintTile = [&](int tile)
  {
    const int x = tile % columns, y = tile / columns;
    const DepthRange range = rangeAround(ranges, columns, rows, x, y);
    const bool searched = range.hasGeometry() && !rule.drawsNothing() &&
      (!options.skipTiles || mayHaveEdge(rule, range));
    skipped.local() += !searched;
    const bool lines = searched && painters.local().paint(x, y, range, image);
    std::uint8_t& had = image.tileHasLines[static_cast<std::size_t>(tile)];
    if (!lines && had != 0)
    {
      clearTile(image, x, y);
    }
    had = lines;
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows, 128),
    [&](const tbb::blocked_range<int>& tiles)
    {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        paintTile(tile);
      }
    });
  SilhouetteCounters counters;
  counters.tiles = static_cast<std::size_t>(columns) * rows;
  counters.tilesSkipped = skipped.combine(std::plus<>());
  return counters;
}
}

#endif
