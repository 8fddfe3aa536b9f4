// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteTiles_h
#define po_SilhouetteTiles_h

#include "Camera.h"
#include "SilhouetteFinder.h"

#include <hwy/cache_control.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <vector>

/// The loop over tiles that all ways to draw silhouettes share.
namespace po
{
/// The lines of one tile, row by row.
struct TileLines
{
  template <typename T>
  using Pixels = std::array<T, DepthTileSize * DepthTileSize>;

  [[nodiscard]] static constexpr int indexOf(int i, int j) { return j * DepthTileSize + i; }

  // As in SilhouetteImage; the last two where there is a line.
  Pixels<float> strength, inside;
  Pixels<std::int32_t> front;
};

/// Gives the image the size of the source. What is there stays if it has that size.
void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts);

/// Writes those rows of a tile that have lines, one bit each, and clears those that had some.
void writeRows(
  const TileLines& lines, std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image);

/// Clears those rows of a tile, one bit each.
void clearStrength(int tileX, int tileY, std::uint32_t rows, SilhouetteImage& image);

void clearTile(int tileX, int tileY, SilhouetteImage& image);

/// Tiles side by side that may have lines.
struct SearchedTiles
{
  /// At most so many, of those that begin at a multiple of it.
  static constexpr int Most = 8;

  int x, y; ///< column and row of the first
  int count;
  /// Depth in the Most tiles that these are of, and the tiles around: whichever others are
  /// searched.
  double nearest;

  /// The pixels in them, of a picture.
  [[nodiscard]] PixelRange pixels(int width, int height) const
  {
    const int left = x * DepthTileSize, bottom = y * DepthTileSize;
    return intersect({ 0, 0, width, height },
      { left, bottom, left + count * DepthTileSize, bottom + DepthTileSize });
  }
};

[[nodiscard]] inline PixelRange grow(const PixelRange& range, int pixels)
{
  return { range.x0 - pixels, range.y0 - pixels, range.x1 + pixels, range.y1 + pixels };
}

/// The tiles that may have lines. Those of the others that had lines before are cleared.
/// @param reach pixels from an edge that its line can cover
[[nodiscard]] std::vector<SearchedTiles> tilesToSearch(const std::vector<DepthRange>& ranges,
  const SilhouetteRule& rule, int reach, SilhouetteImage& image, bool skipTiles);

/// Paints all tiles in parallel, but those that cannot have lines.
///
/// @param reach pixels from an edge that its line can cover
/// @param makePainter makes what one thread paints with: paint(searched tiles, image) writes the
///   rows that have lines and clears those that had some
template <typename MakePainter>
SilhouetteCounters paintTiles(const DepthSource& source, const SilhouetteRule& rule, int reach,
  SilhouetteImage& image, const SilhouetteOptions& options, const MakePainter& makePainter)
{
  resizeFor(image, source, options.findFronts);
  const std::vector<SearchedTiles> searched =
    tilesToSearch(source.ranges(), rule, reach, image, options.skipTiles);
  tbb::enumerable_thread_specific<decltype(makePainter())> painters(makePainter);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, searched.size(), 4),
    [&](const tbb::blocked_range<std::size_t>& part)
    {
      auto& painter = painters.local();
      for (std::size_t i = part.begin(); i < part.end(); ++i)
      {
        painter.paint(searched[i], image);
      }
      hwy::FlushStream(); // see LineRows-inl.h
    });
  const std::size_t tiles = source.ranges().size();
  std::size_t count = 0;
  for (const SearchedTiles& some : searched)
  {
    count += static_cast<std::size_t>(some.count);
  }
  return { tiles, tiles - count };
}
}

#endif
