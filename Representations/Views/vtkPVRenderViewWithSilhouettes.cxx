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

vtkStandardNewMacro(vtkPVRenderViewWithSilhouettes);

namespace
{
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

/// A wall of displays shows what each process has composited of everything.
void vtkPVRenderViewWithSilhouettes::CheckSharing()
{
  const bool alone = this->Silhouettes->GetTileMargins();
  if (alone || !(this->InTileDisplayMode() || this->InCaveDisplayMode()))
  {
    return;
  }
  this->Silhouettes->SetController(nullptr);
  if (!this->Chosen.empty())
  {
    this->Chosen.clear();
    vtkWarningMacro("SilhouetteRepresentations: on a wall of displays lines cannot be limited to "
                    "some representations. All have lines.");
  }
}

/// Compositing delivers depth as well as colour, but where something is translucent and pictures
/// are laid one over the other.
void vtkPVRenderViewWithSilhouettes::PrepareCompositing()
{
  const bool ordered = this->GetUseOrderedCompositing();
  if (ordered != this->Silhouettes->GetOrderedCompositing())
  {
    this->Silhouettes->SetOrderedCompositing(ordered);
    this->SynchronizedRenderers->SetUseDepthBuffer(!ordered);
  }
}

void vtkPVRenderViewWithSilhouettes::Render(bool interactive, bool skipRendering)
{
  this->CheckSharing();
  this->PrepareCompositing();
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
