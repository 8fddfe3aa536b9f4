// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRims.h"

#include "RimShares.h"

#include <algorithm>
#include <cstdint>

namespace po
{
namespace
{
/// Paints the lines of some tiles after the others along the rims of spheres.
class RimPainter
{
public:
  RimPainter(const SphereDepth& depth, const SilhouetteRule& rule)
    : depth_(depth)
    , brush_(rule)
    , finder_(rule, 1)
  {
  }

  void paint(const SearchedTiles& tiles, SilhouetteImage& image)
  {
    const std::uint64_t rows = findEdges(tiles) ? paintRims(tiles) : 0;
    for (int x = tiles.x; x < tiles.x + tiles.count; ++x)
    {
      writeRows(lines_, readTile(x, tiles.y, rows, image), x, tiles.y, image);
    }
    clear(rows);
  }

private:
  /// Finds the edges of which lines may reach into some tiles; false if there are none.
  bool findEdges(const SearchedTiles& tiles)
  {
    const PixelRange picture{ 0, 0, depth_.width(), depth_.height() };
    const PixelRange lookedAt = grow(tiles.pixels(depth_.width(), depth_.height()), brush_.reach());
    // From edges two pixels more are looked at, and those that their lines can cover.
    const int margin = std::max(2, brush_.reach());
    return finder_.find(
      depth_, intersect(lookedAt, picture), grow(lookedAt, margin), tiles.nearest);
  }

  /// @return rows of the block that may have lines, one bit each
  std::uint64_t paintRims(const SearchedTiles& tiles)
  {
    const SampleBlock& block = finder_.block();
    // The same for all that are searched of some tiles side by side.
    const int first = tiles.x / SearchedTiles::Most * SearchedTiles::Most;
    const PatchPlace middle{ first * DepthTileSize + SearchedTiles::Most * DepthTileSize / 2,
      tiles.y * DepthTileSize + DepthTileSize / 2 };
    depth_.fillSpheres(block, spheres_);
    strongest_.resize(block.stride(), block.rows);
    for (std::size_t i = 0; i < depth_.layerCount(); ++i)
    {
      const SphereLayer layer = depth_.layer(i);
      const RayPatch patch = makeRayPatch(layer.rays->around(middle.x + 0.5, middle.y + 0.5));
      edges_.list(finder_, spheres_, layer, middle);
      edges_.placeRims(layer, patch, block.origin);
      brush_.paint(edges_, patch, layer.firstNumber, { block, spheres_.data() }, strongest_);
    }
    return rowsOfLines();
  }

  [[nodiscard]] std::uint64_t rowsOfLines() const
  {
    const int reach = brush_.reach();
    const std::uint64_t around = (std::uint64_t(1) << (2 * reach + 1)) - 1;
    std::uint64_t rows = 0;
    for (const EdgeGroup& group : finder_.groups())
    {
      rows |= around << (group.j - reach);
    }
    return rows;
  }

  /// @return rows of the tile that have lines, one bit each
  std::uint32_t readTile(int tileX, int tileY, std::uint64_t rows, const SilhouetteImage& image)
  {
    const SampleBlock& block = finder_.block();
    const PixelRange pixels = SearchedTiles{ tileX, tileY, 1, 0 }.pixels(image.width, image.height);
    const int below = pixels.y0 - block.y;
    const auto own = (1U << static_cast<unsigned>(pixels.y1 - pixels.y0)) - 1;
    return strongest_.read(block.indexOf(pixels.x0 - block.x, below), pixels.x0, pixels.y0,
      static_cast<std::uint32_t>(rows >> below) & own, image, lines_);
  }

  void clear(std::uint64_t rows)
  {
    for (; rows != 0; rows &= rows - 1)
    {
      strongest_.clearRow(static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(rows)));
    }
  }

  const SphereDepth& depth_;
  RimBrush brush_;
  EdgeFinder finder_;
  std::vector<std::uint32_t> spheres_; ///< that the pixels of the block show
  RimEdges edges_;
  StrongestLines strongest_; ///< of the pixels of the block; none in between
  TileLines lines_{};
};
}

SilhouetteCounters findTracedSilhouettes(const SphereDepth& depth, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options)
{
  if (rule.samples == 1)
  {
    return findSilhouettes(depth, rule, image, options);
  }
  const auto pixels = static_cast<std::size_t>(depth.width()) * depth.height();
  image.inside.resize(options.findFronts ? pixels : 0);
  return paintTiles(
    depth, rule, RimBrush(rule).reach(), image, options, [&] { return RimPainter(depth, rule); });
}
}
