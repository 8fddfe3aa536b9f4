// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRenderViewWithSilhouettes.h"

#include "vtkCompositeRepresentation.h"
#include "vtkDepthSilhouettePass.h"
#include "vtkGeometryRepresentation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkRayTracedSphereRepresentation.h"

#include <algorithm>

vtkStandardNewMacro(vtkPVRenderViewWithSilhouettes);

namespace
{
bool isOfSpheres(vtkDataRepresentation* representation)
{
  if (auto* composite = vtkCompositeRepresentation::SafeDownCast(representation))
  {
    representation = composite->GetActiveRepresentation();
  }
  return vtkRayTracedSphereRepresentation::SafeDownCast(representation);
}

/// What a representation draws; null for one that draws no surface.
vtkActor* actorOf(vtkDataRepresentation* representation)
{
  if (auto* composite = vtkCompositeRepresentation::SafeDownCast(representation))
  {
    return actorOf(composite->GetActiveRepresentation());
  }
  if (auto* spheres = vtkRayTracedSphereRepresentation::SafeDownCast(representation))
  {
    return spheres->GetActor();
  }
  auto* geometry = vtkGeometryRepresentation::SafeDownCast(representation);
  return geometry ? geometry->GetActor() : nullptr;
}
}

vtkPVRenderViewWithSilhouettes::vtkPVRenderViewWithSilhouettes()
{
  this->SynchronizedRenderers->SetImageProcessingPass(this->Silhouettes);
  // Compositing must deliver depth as well as colour.
  this->SynchronizedRenderers->SetUseDepthBuffer(true);
  // Composited images have the renderer's size, whatever the frame they are put into.
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  const bool alone = !processes || processes->GetNumberOfProcesses() == 1;
  this->Silhouettes->SetTileMargins(alone);
  this->Silhouettes->SetController(alone ? nullptr : processes);
}

vtkPVRenderViewWithSilhouettes::~vtkPVRenderViewWithSilhouettes() = default;

void vtkPVRenderViewWithSilhouettes::AddSilhouetteRepresentation(
  vtkDataRepresentation* representation)
{
  this->Chosen.emplace_back(representation);
  this->Modified();
}

void vtkPVRenderViewWithSilhouettes::RemoveAllSilhouetteRepresentations()
{
  this->Chosen.clear();
  this->Modified();
}

/// False if some are chosen, and none of them can be seen.
bool vtkPVRenderViewWithSilhouettes::ChooseActors()
{
  this->Silhouettes->RemoveAllActors();
  bool found = this->Chosen.empty();
  for (const auto& representation : this->Chosen)
  {
    vtkActor* actor = actorOf(representation);
    if (actor && actor->GetVisibility())
    {
      this->Silhouettes->AddActor(actor);
      found = true;
    }
  }
  return found;
}

/// Where several processes draw, only ray-traced spheres can be chosen, and a wall of displays
/// shows what each process has composited.
void vtkPVRenderViewWithSilhouettes::CheckSharing()
{
  if (!this->Silhouettes->GetController())
  {
    return;
  }
  if (this->InTileDisplayMode() || this->InCaveDisplayMode())
  {
    this->Silhouettes->SetController(nullptr);
  }
  const bool spheres = this->Silhouettes->GetController();
  const auto cannot = std::remove_if(this->Chosen.begin(), this->Chosen.end(),
    [spheres](vtkDataRepresentation* one) { return one && !(spheres && isOfSpheres(one)); });
  if (cannot != this->Chosen.end())
  {
    this->Chosen.erase(cannot, this->Chosen.end());
    vtkWarningMacro(
      "SilhouetteRepresentations: where several processes draw, lines can be limited to "
      "ray-traced spheres only, and not on a wall of displays. The others were left out.");
  }
}

void vtkPVRenderViewWithSilhouettes::Render(bool interactive, bool skipRendering)
{
  this->CheckSharing();
  const bool visible = this->Silhouettes->GetLineVisibility();
  this->Silhouettes->SetLineVisibility(this->ChooseActors() && visible);
  this->Superclass::Render(interactive, skipRendering);
  this->Silhouettes->SetLineVisibility(visible);
}

void vtkPVRenderViewWithSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Silhouettes:\n";
  this->Silhouettes->PrintSelf(os, indent.GetNextIndent());
}
