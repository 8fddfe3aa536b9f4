// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SelectionColors_h
#define po_SelectionColors_h

#include "FrameTracer.h"

#include <cstdint>
#include <vector>

class vtkHardwareSelector;
class vtkPolyData;

namespace po
{
/// Colours of each pixel as the hardware selector reads them in its current pass: ids of points,
/// also where cells are asked for, since each point is drawn as one.
///
/// Where the points were gathered from the blocks of a composite data set (see mergeParticles) ids
/// are those within the block, and the composite index is the block's.
/// @param particles point of each sphere of the frame's scene
void colorForSelection(vtkHardwareSelector& selector, const TracedFrame& frame,
  const std::vector<std::int64_t>& particles, vtkPolyData& points, std::vector<std::uint8_t>& rgba);
}

#endif
