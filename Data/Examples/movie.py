# SPDX-License-Identifier: BSD-3-Clause
"""A movie of a time series, with occlusion baked anew in every step.

    pvpython movie.py --output movie.avi step_*.vtp     one file a step, in the order that is given
    pvpython movie.py --output frames.png               the shipped disc and its fragments, flying on for 0.1 ms

A name that ends in .avi gives a movie, .png numbered pictures. Colours span the range of all steps.
"""
import argparse
import os
import tempfile

from paraview.simple import *
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import plugin
import scene

plugin.load(globals())


def make_series(folder, steps):
    """Files of the shipped disc in which every particle goes on along -z with its speed, as if nothing stopped it."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(plugin.DATA, "bullet_1000.vtp"))
    reader.Update()
    particles = dataset_adapter.WrapDataObject(reader.GetOutput())
    start, speed = particles.Points.copy(), particles.PointData["speed"]
    files = []
    for step in range(steps):
        moved = start.copy()
        moved[:, 2] -= speed * (1e-4 * step / max(1, steps - 1))
        particles.Points = moved
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(particles.VTKObject)
        writer.SetDataModeToBinary()
        writer.SetFileName(os.path.join(folder, f"step_{step:03}.vtp"))
        writer.Write()
        files.append(writer.GetFileName())
    return files


def make_movie(files, options):
    series = OpenDataFile(files)
    baked = SphereAmbientOcclusion(Input=series, SamplesPerTexel=options.samples)
    view = scene.make_view(options.size)
    display = scene.show_spheres(baked, view, ambient=0.6, diffuse=0.5)
    display.SamplesPerPixel = 8  # smooth edges
    display.SilhouetteVisibility = 1
    if options.color:
        scene.color_by(display, options.color)
        display.RescaleTransferFunctionToDataRangeOverTime()
    GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    GetAnimationScene().GoToLast()  # where the particles are spread most
    scene.aim_camera(view, -70)
    SaveAnimation(options.output, view, ImageResolution=options.size, FrameRate=12)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="one file a time step")
    parser.add_argument("--output", required=True, help="movie (.avi) or pictures (.png)")
    parser.add_argument("--color", default="speed", help="point array of the colours; '' for none [%(default)s]")
    parser.add_argument("--size", nargs=2, type=int, default=[1280, 720], metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--samples", type=int, default=49, help="quality of the bake [%(default)s]")
    parser.add_argument("--steps", type=int, default=25, help="of the shipped disc [%(default)s]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        make_movie(options.files or make_series(folder, options.steps), options)


main()
