// SPDX-License-Identifier: BSD-3-Clause
/// The whole path in plain VTK, without ParaView: bake, ray-trace, outline.
///
///   PlainVTK particles.vtp               opens a window
///   PlainVTK particles.vtp picture.png   writes a picture instead

#include "vtkDepthSilhouettePass.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkSphereAmbientOcclusion.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdlib>
#include <iostream>

namespace
{
void savePicture(vtkRenderWindow* window, const char* fileName)
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
}

void showWindow(vtkRenderWindow* window)
{
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  interactor->SetRenderWindow(window);
  interactor->Initialize();
  interactor->Start();
}
}

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::cerr << "Usage: " << argv[0] << " particles.vtp [picture.png]\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);

  // Bake. Radii come from the array `radius`, if there is one.
  vtkNew<vtkSphereAmbientOcclusion> bake;
  bake->SetInputConnection(reader->GetOutputPort());
  bake->Update();
  if (bake->GetNumberOfParticles() == 0)
  {
    return EXIT_FAILURE; // the filter has said why
  }

  // Ray-trace: occlusion darkens the ambient light, the headlight gives the rest.
  vtkNew<vtkRayTracedSphereMapper> mapper;
  mapper->SetInputConnection(bake->GetOutputPort());
  mapper->OcclusionOnDiffuseOff();
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.85, 0.8, 0.7);
  actor->GetProperty()->SetAmbient(0.7);
  actor->GetProperty()->SetDiffuse(0.4);

  // Outline.
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkDepthSilhouettePass> silhouettes;
  silhouettes->SetDelegatePass(steps);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetBackground(1, 1, 1);
  renderer->SetPass(silhouettes);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(800, 600);
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(argc > 2);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  window->Render();
  if (argc > 2)
  {
    savePicture(window, argv[2]);
  }
  else
  {
    showWindow(window);
  }
  return EXIT_SUCCESS;
}
