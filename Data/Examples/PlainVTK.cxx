// SPDX-License-Identifier: BSD-3-Clause
/// The whole path in plain VTK, without ParaView: bake, ray-trace, outline.
///
///   PlainVTK particles.vtp               opens a window
///   PlainVTK particles.vtp picture.png   writes a picture instead

#include "vtkDepthSilhouettePass.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkSphereAmbientOcclusion.h"

#include <vtkActor.h>
#include <vtkErrorCode.h>
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
#include <fstream>
#include <iostream>

namespace
{
/// False, with a message, if the file cannot be written.
bool savePicture(vtkRenderWindow* window, const char* fileName)
{
  if (!std::ofstream(fileName, std::ios::app)) // vtkPNGWriter does not report all that can go wrong
  {
    std::cerr << "The picture " << fileName << " cannot be written: check its folder and rights.\n";
    return false;
  }
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
  return writer->GetErrorCode() == vtkErrorCode::NoError;
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
  if (argc < 2 || argc > 3)
  {
    std::cerr << "Usage: " << argv[0] << " particles.vtp [picture.png]\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError)
  {
    return EXIT_FAILURE; // the reader has said why
  }

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
    return savePicture(window, argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  showWindow(window);
  return EXIT_SUCCESS;
}
