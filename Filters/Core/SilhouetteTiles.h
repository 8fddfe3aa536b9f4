// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteTiles_h
#define po_SilhouetteTiles_h

#include "Camera.h"
#include "SilhouetteFinder.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <vector>

/// The loop over tiles that all ways to draw silhouettes share.
namespace po
{
/// The lines of one tile. Rows are longer than the tile, for whole vectors.
struct TileLines
{
  static constexpr int Pitch = DepthTileSize + 8;

  template <typename T>
  using Pixels = std::array<T, DepthTileSize * Pitch>;

  [[nodiscard]] static constexpr int indexOf(int i, int j) { return j * Pitch + i; }

  // As in SilhouetteImage; the last two where there is a line.
  Pixels<float> strength, inside;
  Pixels<std::int32_t> front;
};

/// Gives the image the size of the source. What is there stays if it has that size.
void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts);

/// Writes those rows of a tile that have lines, one bit each, and clears those that had some.
void writeRows(
  const TileLines& lines, std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image);

void clearTile(int tileX, int tileY, SilhouetteImage& image);

/// The tiles that may have lines. Those of the others that had lines before are cleared.
/// @param reach pixels from an edge that its line can cover
[[nodiscard]] std::vector<int> tilesToSearch(const std::vector<DepthRange>& ranges,
  const SilhouetteRule& rule, int reach, SilhouetteImage& image, bool skipTiles);

/// A tile that may have lines.
struct SearchedTile
{
  int x, y;         ///< column and row of the tile
  DepthRange range; ///< of it and the tiles around
  PixelRange edges; ///< where edges may lie whose lines reach into it
};

/// @param tile its number
/// @param reach pixels from an edge that its line can cover
[[nodiscard]] SearchedTile searchedTile(const DepthSource& source, int tile, int reach);

/// Paints all tiles in parallel, but those that cannot have lines.
///
/// @param reach pixels from an edge that its line can cover
/// @param makePainter makes what one thread paints with: std::uint32_t paint(searched tile) gives
///   the rows that have lines, one bit each, and lines() all of their pixels
template <typename MakePainter>
SilhouetteCounters paintTiles(const DepthSource& source, const SilhouetteRule& rule, int reach,
  SilhouetteImage& image, const SilhouetteOptions& options, const MakePainter& makePainter)
{
  resizeFor(image, source, options.findFronts);
  const std::vector<int> searched =
    tilesToSearch(source.ranges(), rule, reach, image, options.skipTiles);
  const auto paintTile = [&](auto& painter, int number)
  {
    const SearchedTile tile = searchedTile(source, number, reach);
    writeRows(painter.lines(), painter.paint(tile), tile.x, tile.y, image);
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
  const std::size_t tiles = source.ranges().size();
  return { tiles, tiles - searched.size() };
}
}

#endif
