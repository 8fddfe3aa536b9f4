// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_LayersFile_h
#define po_LayersFile_h

#include <string>

class vtkActor;
class vtkPVRenderView;
class vtkRayTracedSphereMapper;

namespace po
{
/// The OpenEXR file that layers of a view are written to.
struct LayersFile
{
  std::string name;
  int width = 0, height = 0; ///< both 0: as large as the last frame

  /// Writes the layers on the process that draws the view; others do nothing.
  /// @param view what shows the actor, or null
  /// @return why there is nothing to write, empty on success; the writer reports its own errors
  [[nodiscard]] std::string write(
    vtkPVRenderView* view, vtkRayTracedSphereMapper& mapper, vtkActor* actor) const;
};
}

#endif
