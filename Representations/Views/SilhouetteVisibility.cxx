// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteVisibility.h"

#include "vtkActor.h"
#include "vtkMultiProcessController.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkSphereSilhouettes.h"

namespace po
{
std::string updateVisibility(
  vtkSphereSilhouettes& silhouettes, vtkActor& actor, vtkPVRenderView* view)
{
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  const bool alone = !processes || processes->GetNumberOfProcesses() == 1;
  const bool wall = view && (view->InTileDisplayMode() || view->InCaveDisplayMode());
  silhouettes.SetController(alone ? nullptr : processes);
  silhouettes.SetRenderer(alone || !view ? nullptr : view->GetRenderer());
  silhouettes.SetOrderedCompositing(!alone && view && view->GetUseOrderedCompositing());
  silhouettes.SetVisibility((alone || !wall) && actor.GetVisibility());
  const bool isMissing = !alone && wall && silhouettes.GetLineVisibility() && actor.GetVisibility();
  return isMissing && processes->GetLocalProcessId() == 0
    ? "On a wall of displays that several processes draw these spheres have no lines: none of them "
      "knows all depths."
    : "";
}
}
