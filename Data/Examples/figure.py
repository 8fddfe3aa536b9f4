# SPDX-License-Identifier: BSD-3-Clause
"""A figure for a paper: a picture in 4K and the layers it is made of, for compositing.

    pvpython figure.py particles.vtp figure --color speed

writes figure.png and figure.exr: RGBA, depth Z, ambient occlusion AO, normal N and particle id of every pixel, in
floats (OpenEXR; Nuke, Blender, GIMP and the Python packages OpenEXR and imageio read it).
"""
import argparse
import os

from paraview.simple import *

import plugin
import scene

plugin.load(globals())


def show(baked, view, color):
    display = scene.show_spheres(baked, view, ambient=0.7, diffuse=0.4)
    display.SamplesPerPixel = 16
    display.SilhouetteVisibility = 1
    if color:
        bar = GetScalarBar(scene.color_by(display, color), view)
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        display.SetScalarBarVisibility(view, True)
    return display


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", help="particles in any format that ParaView reads as points")
    parser.add_argument("output", help="name of the results without .png and .exr")
    parser.add_argument("--color", help="point array of the colours")
    parser.add_argument("--size", nargs=2, type=int, default=[3840, 2160], metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--error", type=float, default=0.01, help="RMS error of the occlusion [%(default)s]")
    options = parser.parse_args()

    particles = OpenDataFile(os.path.abspath(options.input))
    baked = SphereAmbientOcclusion(Input=particles, TextureResolution=32, TargetError=options.error)
    width, height = options.size
    view = scene.make_view([1200, 1200 * height // width])  # letters are as large as in a window of this size
    display = show(baked, view, options.color)
    scene.aim_camera(view, 30, 20, 1.4)
    SaveScreenshot(options.output + ".png", view, ImageResolution=options.size)
    display.LayersFile = os.path.abspath(options.output + ".exr")
    display.LayersResolution = options.size
    display.SMProxy.InvokeCommand("WriteLayers")


main()
