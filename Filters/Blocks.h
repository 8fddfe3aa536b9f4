// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Blocks_h
#define po_Blocks_h

// The blocks of a data set, simple or composite.

#include "ParticleOcclusionFiltersModule.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkCompositeDataSet;
class vtkDataObject;
class vtkDataSet;
class vtkPointSet;
class vtkPolyData;

namespace po
{
/// The data set itself, or the leaves of a composite one, as far as they have points. The pointers
/// are borrowed from `data`.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::vector<vtkDataSet*> blocksWithPoints(
  vtkDataObject* data);

/// Flat index of each of blocksWithPoints(data), as vtkCompositeDataIterator counts.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::vector<unsigned> flatIndicesOfBlocks(
  vtkCompositeDataSet* data);

/// Points and point data without cells, which would only cost memory when blocks are appended.
[[nodiscard]] vtkSmartPointer<vtkPolyData> withoutCells(vtkPointSet& block);
}

#endif
