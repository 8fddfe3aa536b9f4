// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleFilter_h
#define po_ParticleFilter_h

// Which points a mapper shows: from VTK's planes to the hidden spheres of the core.

#include "Cropping.h"

#include <vector>

class vtkActor;
class vtkMapper;

namespace po
{
/// The mapper's clipping planes in the coordinates of the points.
[[nodiscard]] std::vector<HalfSpace> clippingPlanesOf(vtkMapper& mapper, vtkActor& actor);
}

#endif
