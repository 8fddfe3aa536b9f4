# SPDX-License-Identifier: BSD-3-Clause
"""A window of plain VTK, without ParaView: bake, ray-trace, outline. As PlainVTK.cxx does in C++.

    python3 plain_vtk.py particles.vtp                opens a window
    python3 plain_vtk.py particles.vtp picture.png    writes a picture instead

Needs the package particleocclusion beside VTK's: installed, or in PYTHONPATH.
"""
import argparse

import vtkmodules.vtkInteractionStyle  # noqa: F401: what the window uses
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from particleocclusion import vtkDepthSilhouettePass, vtkRayTracedSphereMapper, vtkSphereAmbientOcclusion
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass


def bake(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    filter_ = vtkSphereAmbientOcclusion()  # radii come from the array `radius`, if there is one
    filter_.SetInputConnection(reader.GetOutputPort())
    filter_.Update()
    if filter_.GetNumberOfParticles() == 0:
        raise SystemExit(f"There are no particles in {path}.")
    return filter_


def make_actor(baked):
    mapper = vtkRayTracedSphereMapper()
    mapper.SetInputConnection(baked.GetOutputPort())
    mapper.OcclusionOnDiffuseOff()  # occlusion darkens the ambient light, the headlight gives the rest
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(0.85, 0.8, 0.7)
    look.SetAmbient(0.7)
    look.SetDiffuse(0.4)
    return actor


def make_window(actor, offscreen):
    silhouettes = vtkDepthSilhouettePass()
    silhouettes.SetDelegatePass(vtkRenderStepsPass())
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(1, 1, 1)
    renderer.SetPass(silhouettes)
    window = vtkRenderWindow()
    window.SetSize(800, 600)
    window.SetMultiSamples(0)
    window.SetOffScreenRendering(offscreen)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    window.Render()
    return window


def save(window, path):
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("particles", help="VTK PolyData file (.vtp)")
    parser.add_argument("picture", nargs="?", help="file to write (.png)")
    options = parser.parse_args()
    window = make_window(make_actor(bake(options.particles)), bool(options.picture))
    if options.picture:
        save(window, options.picture)
    else:
        interactor = vtkRenderWindowInteractor()
        interactor.SetRenderWindow(window)
        interactor.Start()


main()
