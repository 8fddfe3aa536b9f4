// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimEdges_h
#define po_RimEdges_h

#include "RimGeometry.h"
#include "SilhouetteEdges.h"
#include "SphereDepth.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Where rays are expanded: a pixel of the picture, through whose centre the ray in the middle
/// goes.
struct PatchPlace
{
  int x, y;
};

/// Edges of a block with a sphere in front, and the rims of these, one after the other. Keeps its
/// memory from block to block.
class RimEdges
{
public:
  /// Lists the edges in front of which are spheres of one layer.
  /// @param shown number of the sphere that each pixel of the block shows
  void list(const EdgeFinder& finder, const std::vector<std::uint32_t>& shown,
    const SphereLayer& layer, PatchPlace middle);

  /// Finds where the rims of the spheres in front lie.
  /// @param depthOrigin subtracted from depths
  void placeRims(const SphereLayer& layer, const RayPatch& patch, double depthOrigin);

  /// Followed by copies of the last one that fill a vector.
  [[nodiscard]] std::size_t count() const { return count_; }

  // Of each edge.
  std::vector<std::int32_t> pixel;   ///< index in the block
  std::vector<std::int32_t> toFront; ///< as in EdgeGroup
  /// Bit 3 (j + 1) + i + 1: is the edge nearer to pixels in the direction (i, j) than its
  /// neighbours in the same row and column that lie behind the same rim?
  std::vector<std::int32_t> directions;
  std::vector<float> x, y;         ///< from the middle of the patch
  std::vector<std::int32_t> place; ///< of the sphere in its layer
  std::vector<Sphere> spheres;
  // Of each rim, see RayPatch: w, u and v over the radius, and the depth where rays touch the
  // sphere.
  std::vector<float> w, u, v, depth;

  /// Of the pixels of a block, while edges are listed: place of the sphere in front of an edge.
  std::vector<std::int32_t> fronts;
  static constexpr std::int32_t NoEdge = -1;

private:
  void reserve(std::size_t edges);

  std::size_t count_ = 0;
};
}

#endif
