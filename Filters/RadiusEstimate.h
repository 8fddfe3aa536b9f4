// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RadiusEstimate_h
#define po_RadiusEstimate_h

#include "ParticleOcclusionFiltersModule.h"
#include "ProcessGroup.h"

class vtkPointSet;

namespace po
{
/// Half the median distance of a particle to its nearest neighbour, taken over up to 1000 of them:
/// the radius at which most particles of an even packing just touch. 0 where no two distinct finite
/// points exist.
///
/// With a group it is that of the points of all processes, with the same bits on each, however the
/// points are distributed and ordered; all must call it.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT double estimateRadius(
  vtkPointSet& points, const ProcessGroup& group = ProcessGroup::alone());
}

#endif
