// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BlockTable_h
#define po_BlockTable_h

// Which points of merged particles came from which block of a composite data set.

#include "ParticleOcclusionFiltersModule.h"

#include "vtkType.h"

#include <vector>

class vtkPolyData;

namespace po
{
/// The points from firstPoint to that of the next block, or to the end.
struct PointBlock
{
  unsigned flatIndex = 0; ///< of the block, as vtkCompositeDataIterator counts
  vtkIdType firstPoint = 0;
};

/// In order of their first points; empty where the points are of no composite data set.
using BlockTable = std::vector<PointBlock>;

/// Keeps the table as a field array of the points, so that it goes wherever they go.
PARTICLEOCCLUSIONFILTERS_EXPORT void setBlockTable(vtkPolyData& points, const BlockTable& table);

[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT BlockTable blockTableOf(vtkPolyData& points);

/// The block of a point; the table must not be empty.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT const PointBlock& blockOf(
  const BlockTable& table, vtkIdType point);
}

#endif
