// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRenderViewWithSilhouettes.h"

#include "vtkDepthSilhouettePass.h"
#include "vtkObjectFactory.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkProcessModule.h"

vtkStandardNewMacro(vtkPVRenderViewWithSilhouettes);

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

void vtkPVRenderViewWithSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Silhouettes:\n";
  this->Silhouettes->PrintSelf(os, indent.GetNextIndent());
}
