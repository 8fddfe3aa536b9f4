// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedLines_h
#define po_SharedLines_h

// Lines on their way between processes: 8 bytes a pixel that has one, 12 with its depth.

#include "DividedDepth.h"
#include "ProcessGroup.h"

#include <cstdint>
#include <vector>

namespace po
{
/// Lines, and what is in front of each.
struct PlacedLines
{
  SilhouetteImage image; ///< with `front` and `inside`, which are 0 where they were not found
  /// Of the front or of the pixel itself, whichever is nearer, a trifle in front of it. Only of
  /// lines that were placed.
  std::vector<float> windowDepth;
  std::vector<std::uint16_t> process; ///< that has what is in front
};

/// Appends the pixels of the tiles of some rows that have lines. Strength and `inside` are rounded
/// to 1/16383.
/// @param firstRow, endRow of tiles
/// @param depth that they were found in
/// @param placed with window depths
void appendLines(const SilhouetteImage& image, int firstRow, int endRow, const DividedDepth& depth,
  bool placed, ProcessGroup::Words& words);

/// Replaces all lines by those of the words, which are placed or not.
void readLines(
  const ProcessGroup::Words& words, int width, int height, bool placed, PlacedLines& lines);
}

#endif
