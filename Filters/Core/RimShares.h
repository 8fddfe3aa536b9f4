// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimShares_h
#define po_RimShares_h

#include "RimGeometry.h"
#include "SilhouetteTiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// How much of a pixel lies within a line along the rim of a sphere.
namespace po
{
/// The pixels of a tile and what is around it, row by row of the picture.
struct RimTile
{
  int x, y;          ///< first pixel of the tile in the picture
  int columns, rows; ///< as far as it lies in the picture
  int width, height; ///< of the picture

  // Blocks of pixels.
  const float* depth;
  const std::uint32_t* shown;  ///< number of the sphere that a pixel shows
  const std::uint32_t* fronts; ///< number of the sphere that an edge lies behind, or None
  const std::int32_t* toFront; ///< where the pixel in front of an edge is, as in EdgeGroup
  int first;                   ///< index of the first pixel of the tile
  int pitch;                   ///< from row to row
};

/// The rim of one sphere in a tile.
struct Rim
{
  /// Pixels around a tile that edges are looked for in, at most.
  static constexpr int Border = static_cast<int>(WidestLine);
  static constexpr int Side = DepthTileSize + 2 * Border;

  /// Without edges, and not placed.
  /// @param place where it is in a table
  Rim(std::uint32_t sphere, std::size_t place)
    : shown(sphere)
    , slot(place)
  {
    edges.fill(0);
  }

  std::uint32_t shown;     ///< number of the sphere
  std::size_t slot;        ///< see above
  std::uint32_t rows = 0;  ///< that have edges, one bit each
  const RayPatch* patch;   ///< rays of the tile
  Quadratic squaredMoment; ///< of these rays
  float depth;             ///< of the rim, as in RimTile::depth
  /// Edges that lie behind the rim, from Border rows below the tile and Border columns left of it
  /// on: one bit each.
  std::array<std::uint32_t, Side> edges;
};

/// The strongest line in each pixel of a tile, and where its front is.
struct RimLines
{
  TileLines lines;
  TileLines::Pixels<std::uint32_t> shown; ///< number of the sphere in front
  TileLines::Pixels<std::int32_t> steps;  ///< to a pixel that may show it

  // Steps are (j + Most) * Row + i + Most.
  static constexpr int RowBits = 8, Row = 1 << RowBits, Most = 16, NoStep = Most * Row + Most;
};

/// Pixels that the lines of a tile may cover, and what they cover; room that is used again.
struct RimWork
{
  // In groups of one rim each, as many as a vector holds.
  std::vector<std::int32_t> pixels; ///< i + 32 j, with bits above
  std::vector<const Rim*> rims;     ///< of each group

  // What is covered of pixels.
  std::vector<std::int32_t> at; ///< in TileLines
  std::vector<std::int32_t> steps;
  std::vector<float> strength, inside;
  std::vector<std::uint32_t> shown;

  // Room for so many, and vectors that are stored beyond.
  void reserveListed(std::size_t count);
  void reserveCovered(std::size_t count);
};

/// Paints the lines along rims one after the other. Keeps its memory in between.
class RimBrush
{
public:
  explicit RimBrush(const SilhouetteRule& rule);

  /// Paints the lines along the rims of a tile, the strongest in each pixel. TileLines::front is
  /// left to setFronts().
  void paint(const RimTile& tile, const std::vector<Rim>& rims, RimLines& painted);

  /// Pixels beyond an edge that its line can cover.
  [[nodiscard]] int reach() const { return reach_; }

private:
  const SilhouetteRule& rule_;
  int reach_;
  RimWork work_;
};
}

#endif
