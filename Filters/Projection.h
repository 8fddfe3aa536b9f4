// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Projection_h
#define po_Projection_h

#include "EyeDistance.h"
#include "ParticleOcclusionFiltersModule.h"

#include <optional>

class vtkMatrix4x4;

namespace po
{
/// From window to eye coordinates for a projection of VTK (eye to clip coordinates, depth range
/// [-1, 1]); nothing if it is null, singular or not finite.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::optional<WindowToEye> windowToEyeOf(
  vtkMatrix4x4* projection);
}

#endif
