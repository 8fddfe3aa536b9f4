// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedLines_h
#define po_SharedLines_h

// Lines on their way between processes: 12 bytes a pixel that has one.

#include "ProcessGroup.h"
#include "SilhouetteFinder.h"

#include <functional>
#include <vector>

namespace po
{
/// Lines with the window depth of what is in front of each, 2 where there is no line.
struct PlacedLines
{
  SilhouetteImage image; ///< with `front` and `inside`, which are 0 where they were not found
  std::vector<float> windowDepth;
};

/// Appends the pixels of the tiles of some rows that have lines. Strength and `inside` are rounded
/// to 1/65535.
/// @param firstRow, endRow of tiles
/// @param depthOf window depth of a pixel, by its index
void appendLines(const SilhouetteImage& image, int firstRow, int endRow,
  const std::function<float(int)>& depthOf, ProcessGroup::Words& words);

/// Replaces all lines by those of the words. The window depth of a line is that of its front or of
/// the pixel itself, whichever is nearer.
void readLines(const ProcessGroup::Words& words, int width, int height, PlacedLines& lines);
}

#endif
