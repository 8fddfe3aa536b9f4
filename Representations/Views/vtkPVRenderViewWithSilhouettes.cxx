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

void vtkPVRenderViewWithSilhouettes::SetSilhouetteVisibility(bool visible)
{
  this->Silhouettes->SetLineVisibility(visible);
}

bool vtkPVRenderViewWithSilhouettes::GetSilhouetteVisibility()
{
  return this->Silhouettes->GetLineVisibility();
}

void vtkPVRenderViewWithSilhouettes::SetSilhouetteThreshold(double threshold)
{
  this->Silhouettes->SetThreshold(threshold);
}

double vtkPVRenderViewWithSilhouettes::GetSilhouetteThreshold()
{
  return this->Silhouettes->GetThreshold();
}

void vtkPVRenderViewWithSilhouettes::SetSilhouetteBackgroundDepth(double depth)
{
  this->Silhouettes->SetBackgroundDepth(depth);
}

double vtkPVRenderViewWithSilhouettes::GetSilhouetteBackgroundDepth()
{
  return this->Silhouettes->GetBackgroundDepth();
}

void vtkPVRenderViewWithSilhouettes::SetSilhouetteColor(double red, double green, double blue)
{
  this->Silhouettes->SetColor(red, green, blue);
}

double* vtkPVRenderViewWithSilhouettes::GetSilhouetteColor()
{
  return this->Silhouettes->GetColor();
}

void vtkPVRenderViewWithSilhouettes::SetSilhouetteOpacity(double opacity)
{
  this->Silhouettes->SetOpacity(opacity);
}

double vtkPVRenderViewWithSilhouettes::GetSilhouetteOpacity()
{
  return this->Silhouettes->GetOpacity();
}

void vtkPVRenderViewWithSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Silhouettes:\n";
  this->Silhouettes->PrintSelf(os, indent.GetNextIndent());
}
