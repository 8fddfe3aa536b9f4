// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MapperCropping_h
#define po_MapperCropping_h

#include "CropSettings.h"

class vtkRayTracedSphereMapper;

namespace po
{
/// Replaces all ranges and planes of the mapper.
void crop(vtkRayTracedSphereMapper& mapper, const CropSettings& settings);
}

#endif
