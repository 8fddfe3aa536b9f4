// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRenderViewWithSilhouettes.h"

#include "vtkCompositeRepresentation.h"
#include "vtkDepthSilhouettePass.h"
#include "vtkGeometryRepresentation.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkProcessModule.h"
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
  // Compositing must deliver depth as well as colour.
  this->SynchronizedRenderers->SetUseDepthBuffer(true);
  // Composited images have the renderer's size, whatever the frame they are put into.
  vtkProcessModule* process = vtkProcessModule::GetProcessModule();
  this->Silhouettes->SetTileMargins(!process || process->GetNumberOfLocalPartitions() == 1);
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

void vtkPVRenderViewWithSilhouettes::Render(bool interactive, bool skipRendering)
{
  if (!this->Chosen.empty() && !this->Silhouettes->GetTileMargins())
  {
    vtkWarningMacro("SilhouetteRepresentations: where several processes draw, all that is opaque "
                    "has lines. Choose none, or render with one process.");
    this->Chosen.clear();
  }
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
