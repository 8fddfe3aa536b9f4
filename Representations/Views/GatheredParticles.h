// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_GatheredParticles_h
#define po_GatheredParticles_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataObject;
class vtkPolyData;

namespace po
{
/// The points of a data set, or of all blocks of a composite one, with their baked textures; those
/// of an image or a rectilinear grid are computed. Points of a composite data set know their block
/// (blockTableOf) and the hierarchy (keepHierarchy).
/// @param warning why textures were lost, empty if they were not
[[nodiscard]] vtkSmartPointer<vtkPolyData> gatherParticles(
  vtkDataObject* data, std::string& warning);
}

#endif
