// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimShares_h
#define po_RimShares_h

#include "Camera.h"
#include "DepthSource.h"
#include "SilhouetteRule.h"
#include "Sphere.h"

#include <array>
#include <cstdint>

/// How much of a pixel lies within a line along the rim of a sphere.
namespace po
{
/// c + x X + y Y + xx X^2 + xy X Y + yy Y^2.
struct Quadratic
{
  float c, x, y, xx, xy, yy;
};

/// The rays of a tile, as functions of the offset in pixels from the middle of the tile.
struct RayPatch
{
  RayPencil rays;
  double scale;            ///< 1 / length of the direction in the middle
  Quadratic squaredLength; ///< of a direction, 1 in the middle
};

[[nodiscard]] RayPatch makeRayPatch(const RayPencil& rays);

/// |m|^2 over the squared radius of a sphere. The ray at (x, y) from the middle of a patch has the
/// distance h = |m| / |d| from the sphere's centre, with m = (centre - origin) x d linear in (x,
/// y): in perspective all rays have one origin, in parallel projection one direction.
[[nodiscard]] Quadratic squaredMoment(const RayPatch& patch, const Sphere& sphere);

/// The pixels of a tile, the edges in and around it, and the lines that are painted. Rows are
/// longer than the tile, for whole vectors.
struct RimTile
{
  static constexpr int Side = DepthTileSize;
  static constexpr int Slack = 8;
  static constexpr int Pitch = Side + Slack;
  static constexpr int Border = static_cast<int>(WidestLine);
  static constexpr int EdgePitch = Side + 2 * Border + Slack;

  template <typename T>
  using Pixels = std::array<T, Side * Pitch>;
  template <typename T>
  using Edges = std::array<T, (Side + 2 * Border) * EdgePitch>;

  [[nodiscard]] static constexpr int indexOf(int i, int j) { return j * Pitch + i; }

  /// Of an edge that may lie up to Border pixels beside the tile.
  [[nodiscard]] static constexpr int edgeIndexOf(int i, int j)
  {
    return (j + Border) * EdgePitch + i + Border;
  }

  // The first pixel in a block that has more around.
  const float* depth;
  const std::uint32_t* shown; ///< number of the sphere that a pixel shows
  int pitch;                  ///< from row to row

  Edges<std::int32_t> rims; ///< number of the rim that an edge lies behind; -1: there is no edge
  Edges<float> fronts;      ///< depth in front of the edge
  Edges<float> jumps;       ///< from there to what is behind
  Edges<std::int32_t> frontPixels; ///< of the picture

  Pixels<float> strength, inside; ///< as in SilhouetteImage
  Pixels<std::int32_t> front;
};

/// The rim of one sphere in a tile.
struct Rim
{
  Quadratic squaredMoment;
  std::int32_t number;
  std::uint32_t shown; ///< number of the sphere
  /// Bits of the pixels in each row of the tile that have an edge of the rim no farther than the
  /// reach of a line.
  std::array<std::uint32_t, RimTile::Side> pixels;
};

/// Paints the line along a rim where it is stronger than what is there; false if it is nowhere.
bool paintRim(const RayPatch& patch, const Rim& rim, const SilhouetteRule& rule, RimTile& tile);

/// Pixels beyond an edge that its line can cover.
[[nodiscard]] int reachOfLines(const SilhouetteRule& rule);
}

#endif
