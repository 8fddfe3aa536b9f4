// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MergedParticles_h
#define po_MergedParticles_h

// The particles of several blocks as one data set, with their textures.

#include "ParticleOcclusionFiltersModule.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace po
{
/// One poly data, without cells, of the points of all blocks. Point arrays that are not in all
/// blocks are dropped, as vtkAppendPolyData does.
///
/// Texture tables are put one after the other, and the points' rows follow. Those of the blocks of
/// one bake, in their order, lie so in memory, which the result then shares (see TableViews.h).
/// Others of one encoding and maximum are copied; where maxima or encodings differ, or textures
/// have different lengths and another basis, they are decoded to float32. A block without textures
/// gets row -1. Where the resolutions differ, or a block's arrays are wrong, there are no textures
/// in the result, and `warning` says why.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT vtkSmartPointer<vtkPolyData> mergeParticles(
  const std::vector<vtkPointSet*>& blocks, std::string& warning);
}

#endif
