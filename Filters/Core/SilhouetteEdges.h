// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteEdges_h
#define po_SilhouetteEdges_h

#include "DepthSource.h"
#include "SilhouetteRule.h"

#include <array>
#include <cstdint>
#include <vector>

/// Which samples of a depth image are edges: the rule of SilhouetteFinder.h.
namespace po
{
/// A sample behind a jump, and the sample in front that it jumps from.
struct SilhouetteEdge
{
  int behind;
  int front;
  float jump; ///< less the slopes where they are tested; infinite before the background
};

/// Finds the edges of one block of samples after the other; keeps its memory in between.
class EdgeFinder
{
public:
  /// @param samples along each side of a pixel
  /// @param around pixels around a tile that are searched too
  EdgeFinder(const SilhouetteRule& rule, int samples, int around);

  /// Searches a tile of `columns` x `rows` pixels from pixel (x, y) on and what is around it. False
  /// if there is no edge.
  /// @param range of the depths of the tile and all around it that is read
  bool find(
    const DepthSource& source, int x, int y, int columns, int rows, const DepthRange& range);

  [[nodiscard]] const std::vector<SilhouetteEdge>& edges() const { return edges_; }
  [[nodiscard]] const SampleBlock& block() const { return block_; }

  /// Pixels of the block around the tile.
  [[nodiscard]] int margin() const { return margin_; }

private:
  void placeBackground();
  void searchRow(int j, int begin, int end);

  const SilhouetteRule& rule_;
  int samples_;
  int around_;
  int margin_;
  SampleBlock block_;
  std::array<int, 8> neighbours_{}; ///< offsets of samples; opposite ones are i and 7 - i
  std::vector<float> jumps_;
  std::vector<std::int32_t> fronts_;
  std::vector<SilhouetteEdge> edges_;
};

/// The smallest step to a neighbour that can make an edge.
[[nodiscard]] inline double smallestStep(const SilhouetteRule& rule)
{
  return rule.slopeTest ? rule.jump : rule.threshold / 8;
}
}

#endif
