// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteVisibility_h
#define po_SilhouetteVisibility_h

#include <string>

class vtkActor;
class vtkSphereSilhouettes;

namespace po
{
/// Shows the lines of an actor as long as it is visible, but not where several processes draw it:
/// none of them knows all depths.
/// @return a warning, on the first process, if lines are asked for that cannot be shown
[[nodiscard]] std::string updateVisibility(vtkSphereSilhouettes& silhouettes, vtkActor& actor);
}

#endif
