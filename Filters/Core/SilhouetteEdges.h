// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteEdges_h
#define po_SilhouetteEdges_h

#include "Camera.h"
#include "DepthSource.h"
#include "SilhouetteRule.h"

#include <hwy/base.h>

#include <cstdint>
#include <vector>

/// Which samples of a depth image are edges: the rule of SilhouetteFinder.h.
namespace po
{
/// Edges among samples side by side in one row of a block.
struct EdgeGroup
{
  static constexpr int Size = DepthTileSize; ///< at most

  std::int16_t i, j;   ///< column and row of the first sample in the block
  std::uint32_t edges; ///< bit k: sample i + k lies behind a jump
  // Of the samples of these bits; those of others have any value.
  float jumps[Size]; ///< less the slopes where they are tested; infinite before the background
  std::int32_t fronts[Size]; ///< where the sample in front is: 4 (dj + 1) + di + 1
};

/// Room that is used again.
struct EdgeWork
{
  std::vector<std::uint8_t> flags; ///< of groups, row by row
  std::vector<EdgeGroup> groups;

  void reserve(std::size_t count);
};

/// Those of one block, in order.
struct EdgeGroups
{
  const EdgeGroup* first;
  const EdgeGroup* last;

  [[nodiscard]] const EdgeGroup* begin() const { return first; }
  [[nodiscard]] const EdgeGroup* end() const { return last; }
};

/// Columns (or rows) from a sample behind a jump to the one in front.
[[nodiscard]] constexpr int columnsToFront(std::int32_t front)
{
  return front % 4 - 1;
}
[[nodiscard]] constexpr int rowsToFront(std::int32_t front)
{
  return front / 4 - 1;
}

/// A sample behind a jump, and the sample in front that it jumps from.
struct SilhouetteEdge
{
  int i, j; ///< column and row in the block of samples
  int frontI, frontJ;
  std::int32_t front; ///< and jump: as in EdgeGroup
  float jump;
};

/// Calls f(edge) for all edges.
template <typename Function>
void forEachEdge(const EdgeGroups& groups, const Function& f)
{
  for (const EdgeGroup& group : groups)
  {
    for (std::uint32_t left = group.edges; left != 0; left &= left - 1)
    {
      const auto k = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(left));
      const int i = group.i + k;
      f(SilhouetteEdge{ i, group.j, i + columnsToFront(group.fronts[k]),
        group.j + rowsToFront(group.fronts[k]), group.fronts[k], group.jumps[k] });
    }
  }
}

/// Finds the edges of one block of samples after the other; keeps its memory in between.
class EdgeFinder
{
public:
  /// @param samples along each side of a pixel
  /// @param readsSpheres see SampleBlock
  EdgeFinder(const SilhouetteRule& rule, int samples, bool readsSpheres = false);

  /// Searches some pixels of a picture, row by row from the bottom. False if there is no edge.
  /// @param read pixels that the block will have: two samples around the searched ones, or more
  /// @param origin of depth
  bool find(
    const DepthSource& source, const PixelRange& searched, const PixelRange& read, double origin);

  [[nodiscard]] EdgeGroups groups() const
  {
    return { work_.groups.data(), work_.groups.data() + found_ };
  }
  [[nodiscard]] const SampleBlock& block() const { return block_; }

private:
  void placeBackground();

  const SilhouetteRule& rule_;
  int samples_;
  SampleBlock block_;
  EdgeWork work_;
  std::size_t found_ = 0; ///< groups in use
};

/// The smallest step to a neighbour that can make an edge.
[[nodiscard]] inline double smallestStep(const SilhouetteRule& rule)
{
  return rule.slopeTest ? rule.jump : rule.threshold / 8;
}
}

#endif
