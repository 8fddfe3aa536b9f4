// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedSilhouettes_h
#define po_SharedSilhouettes_h

#include "DividedDepth.h"
#include "SharedDepth.h"
#include "SharedLines.h"
#include "SilhouetteRule.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace po
{
/// Bytes that one process has handed to others for one picture.
struct SharedBytes
{
  std::size_t ranges = 0; ///< of tiles
  std::size_t depths = 0;
  std::size_t lines = 0;

  [[nodiscard]] std::size_t all() const { return ranges + depths + lines; }
};

/// The silhouettes of what is divided over processes in any way: those that one process with all of
/// it would find, strengths rounded to 1/16383.
///
/// Each process has the depths of its own part, in the same view. All tell the depth range of each
/// tile; a tile that can have no edge, or what another process hides for certain, needs nothing
/// more. The rows of the other tiles are divided over the processes, each of which gets
/// what all see there, finds the lines in what is nearest, and hands them on. So what travels is
/// sparse, each process has its share of the work, and none needs all depths.
///
/// Keeps its memory from picture to picture.
class SharedSilhouettes
{
public:
  /// All processes must call it, with the same view and rule.
  /// @param own frames that this process has traced, maybe none; all of the camera's size
  /// @param destination that gets the lines; negative: all
  /// @param placed with window depths
  void find(const std::vector<TracedLayer>& own, const Camera& camera, const SilhouetteRule& rule,
    const ProcessGroup& group, int destination, bool placed);

  /// The same of any depths.
  void find(DividedDepth& depth, const SilhouetteRule& rule, const ProcessGroup& group,
    int destination, bool placed);

  /// How far the visible depths of all processes spread: see depthSpread(). All must call it.
  [[nodiscard]] double depthSpread(DividedDepth& depth, const ProcessGroup& group);

  /// Gives each line the colour in front of it, which one process has. All must call it, and all
  /// must have the lines.
  /// @param own RGBA bytes of what this process has traced, null if it has nothing
  /// @param all colours; otherwise only those of lines that cover a rim
  void shareColors(const std::uint8_t* own, bool all, const ProcessGroup& group);

  /// RGBA bytes, of pixels with a line what is in front of it: `front` is the pixel itself then.
  [[nodiscard]] const std::vector<std::uint8_t>& colors() const { return colors_; }

  /// Removes lines around what other processes have.
  void keepOwn(int process);

  /// Of the last picture; empty elsewhere than at the destination.
  [[nodiscard]] const PlacedLines& lines() const { return lines_; }

  [[nodiscard]] const SharedBytes& bytes() const { return bytes_; }

private:
  /// Tiles along the sides of the picture.
  [[nodiscard]] int columns() const;
  [[nodiscard]] int rows() const;
  [[nodiscard]] std::pair<int, int> rowsOf(int process) const;
  ProcessGroup::Words shareRanges(const std::vector<DepthRange>& ranges, const ProcessGroup& group);
  [[nodiscard]] std::size_t tiles() const;
  [[nodiscard]] std::vector<int> searchedTiles(
    const std::vector<DepthRange>& ranges, const SilhouetteRule& rule) const;
  void exchangeTiles(DividedDepth& depth, std::vector<DepthRange> ranges,
    const std::vector<int>& wanted, const std::vector<std::uint8_t>& needed,
    const ProcessGroup& group);

  int width_ = 0, height_ = 0;
  std::vector<int> rows_; ///< first row of tiles of each process, and the end
  SharedDepth depth_;
  SilhouetteImage found_;
  PlacedLines lines_;
  std::vector<std::uint8_t> colors_;
  SharedBytes bytes_;
};
}

#endif
