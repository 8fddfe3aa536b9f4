// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimShares_h
#define po_RimShares_h

#include "RimEdges.h"
#include "StrongestLines.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// How much of a pixel lies within a line along the rim of a sphere.
namespace po
{
/// What pixels of a block show.
struct ShownBlock
{
  const SampleBlock& depths;
  const std::uint32_t* spheres; ///< numbers
};

/// A pixel beside an edge.
struct EdgeNeighbour
{
  int column, row; ///< from the edge
  int direction;   ///< bit in RimEdges::directions
};

/// What lines cover of pixels; room that is used again.
struct CoveredPixels
{
  // Of each edge.
  std::vector<std::uint32_t> ownCode; ///< LineCode of its own pixel
  // Its line covers other pixels that lie behind `limit`, and those of the sphere of this number.
  std::vector<float> limit;
  std::vector<std::uint32_t> sphere;
  // Of pixels beside edges.
  std::vector<std::uint32_t> place; ///< index of the pixel in the block, from bit 16 of the edge
  std::vector<std::uint32_t> code;

  void reserve(std::size_t edges, std::size_t neighbours);
};

/// Paints lines along rims: what they cover of the pixels at their edges and beside them. Keeps its
/// memory in between.
class RimBrush
{
public:
  explicit RimBrush(const SilhouetteRule& rule);

  /// @param edges whose rims are placed
  /// @param firstNumber of the layer of the edges' spheres
  void paint(const RimEdges& edges, const RayPatch& patch, std::uint32_t firstNumber,
    const ShownBlock& shown, StrongestLines& lines);

  /// Pixels beyond an edge that its line can cover.
  [[nodiscard]] int reach() const { return reach_; }

private:
  const SilhouetteRule& rule_;
  int reach_;
  std::vector<EdgeNeighbour> neighbours_; ///< that a line can cover
  CoveredPixels covered_;
};
}

#endif
