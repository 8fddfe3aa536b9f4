// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteEdges_h
#define po_SilhouetteEdges_h

#include "DepthSource.h"
#include "SilhouetteRule.h"

#include <cstdint>
#include <vector>

/// Which samples of a depth image are edges: the rule of SilhouetteFinder.h.
namespace po
{
/// A sample behind a jump, and the sample in front that it jumps from.
struct SilhouetteEdge
{
  std::int16_t i, j;           ///< column and row of the block of samples
  std::int16_t frontI, frontJ; ///< of the sample in front
  float behind, front;         ///< depths, relative to the block's origin
  float jump; ///< less the slopes where they are tested; infinite before the background
};

/// Finds the edges of one block of samples after the other; keeps its memory in between.
class EdgeFinder
{
public:
  /// @param samples along each side of a pixel
  /// @param around pixels around a tile that are searched too
  EdgeFinder(const SilhouetteRule& rule, int samples, int around);

  /// Searches a tile of `columns` x `rows` pixels from pixel (x, y) on and what is around it, row
  /// by row from the bottom. False if there is no edge.
  /// @param range of the depths of the tile and all around it that is read
  bool find(
    const DepthSource& source, int x, int y, int columns, int rows, const DepthRange& range);

  [[nodiscard]] const std::vector<SilhouetteEdge>& edges() const { return edges_; }
  [[nodiscard]] const SampleBlock& block() const { return block_; }

  /// Pixels of the block around the tile.
  [[nodiscard]] int margin() const { return margin_; }

private:
  void placeBackground();

  const SilhouetteRule& rule_;
  int samples_;
  int around_;
  int margin_;
  SampleBlock block_;
  std::vector<float> nearest_; ///< of three rows, see findEdges()
  std::vector<SilhouetteEdge> edges_;
};

/// The smallest step to a neighbour that can make an edge.
[[nodiscard]] inline double smallestStep(const SilhouetteRule& rule)
{
  return rule.slopeTest ? rule.jump : rule.threshold / 8;
}
}

#endif
