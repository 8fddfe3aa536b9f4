// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RenderState_h
#define po_RenderState_h

// From VTK's renderer, lights, actor and property to the plain structs of the core.

#include "Shading.h"

#include <vector>

class vtkActor;
class vtkProperty;
class vtkRenderer;

namespace po
{
/// The active camera of the renderer for a viewport of width x height pixels; the matrices are
/// those that all other actors are drawn with.
[[nodiscard]] Camera cameraOf(vtkRenderer* renderer, int width, int height);

/// The same for a picture of its own, with square pixels, whatever the shape of the window.
[[nodiscard]] Camera cameraOfPicture(vtkRenderer* renderer, int width, int height);

/// The actor's placement, also where it is in the coordinates of a device.
[[nodiscard]] Matrix4 placementOf(vtkActor* actor);

/// All lights that are on.
[[nodiscard]] std::vector<Light> lightsOf(vtkRenderer* renderer);

/// Coefficients and colours of the property; without lights in the renderer lighting is off, as VTK
/// has it.
[[nodiscard]] Material materialOf(vtkProperty* property, bool anyLight);
}

#endif
