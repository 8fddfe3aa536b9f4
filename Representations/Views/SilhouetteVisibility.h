// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteVisibility_h
#define po_SilhouetteVisibility_h

#include <string>

class vtkActor;
class vtkPVRenderView;
class vtkSphereSilhouettes;

namespace po
{
/// Shows the lines of an actor as long as it is visible. Where several processes draw it, they find
/// its lines together, but not on a wall of displays.
/// @param view that shows the actor, or null
/// @return a warning, on the first process, if lines are asked for that cannot be shown
[[nodiscard]] std::string updateVisibility(
  vtkSphereSilhouettes& silhouettes, vtkActor& actor, vtkPVRenderView* view);
}

#endif
