// SPDX-License-Identifier: BSD-3-Clause
#include "LayersFile.h"

#include "vtkActor.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkProcessModule.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkRenderedLayersWriter.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

namespace po
{
namespace
{
/// The client or the server, whichever the view has chosen; ParaView calls both.
bool drawsHere(vtkPVRenderView* view)
{
  const bool onServer = view && view->GetUseDistributedRenderingForRender();
  switch (vtkProcessModule::GetProcessType())
  {
    case vtkProcessModule::PROCESS_CLIENT:
      return !onServer;
    case vtkProcessModule::PROCESS_SERVER:
    case vtkProcessModule::PROCESS_RENDER_SERVER:
      return onServer;
    case vtkProcessModule::PROCESS_DATA_SERVER:
      return false;
    default:
      return true;
  }
}

vtkSmartPointer<vtkImageData> layersFor(
  const LayersFile& file, vtkPVRenderView* view, vtkRayTracedSphereMapper& mapper, vtkActor* actor)
{
  if (!view || (file.width == 0 && file.height == 0))
  {
    return mapper.GetLayers();
  }
  return mapper.RenderLayers(view->GetRenderer(), actor, file.width, file.height);
}
}

std::string LayersFile::write(
  vtkPVRenderView* view, vtkRayTracedSphereMapper& mapper, vtkActor* actor) const
{
  if (!drawsHere(view))
  {
    return "";
  }
  if (name.empty())
  {
    return "LayersFile is empty: name the OpenEXR file to write the layers to.";
  }
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    return "Layers can only be written where one process draws all spheres.";
  }
  const vtkSmartPointer<vtkImageData> layers = layersFor(*this, view, mapper, actor);
  if (layers->GetNumberOfPoints() == 0)
  {
    return "There are no layers to write: show the spheres and render the view first.";
  }
  vtkNew<vtkRenderedLayersWriter> writer; // reports its own errors
  writer->SetInputData(layers);
  writer->SetFileName(name.c_str());
  writer->Write();
  return "";
}
}
