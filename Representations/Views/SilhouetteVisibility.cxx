// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteVisibility.h"

#include "vtkActor.h"
#include "vtkMultiProcessController.h"
#include "vtkSphereSilhouettes.h"

namespace po
{
std::string updateVisibility(vtkSphereSilhouettes& silhouettes, vtkActor& actor)
{
  std::string warning;
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  const bool alone = !processes || processes->GetNumberOfProcesses() == 1;
  if (!alone && silhouettes.GetLineVisibility() && silhouettes.GetVisibility() &&
    processes->GetLocalProcessId() == 0)
  {
    warning = "Several processes draw these spheres, and none knows all depths before the "
              "picture is composited: use Render View (Silhouettes) for lines.";
  }
  silhouettes.SetVisibility(alone && actor.GetVisibility());
  return warning;
}
}
