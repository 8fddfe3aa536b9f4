# SPDX-License-Identifier: BSD-3-Clause
"""Lines beside meshes in pictures that processes share, in Render View (Silhouettes) and in the plain render view:
those of one process, smooth ones too, whoever has which particles and which part of the meshes.

Usage: pvpython test_rank_meshes.py PVBATCH MPIEXEC
"""
import sys
import tempfile

import images
import numpy
import pieces
import rank_pictures

SESSION = """
def show_mesh(source, color):
    display = Show(source, view)
    display.SetRepresentationType("Surface")
    display.DiffuseColor = color
    return display

# ParaView gives each process a part of a sphere, and boxes and planes to the first alone.
inside = Sphere(Center=[6, 4, 6], Radius=14, ThetaResolution=40, PhiResolution=30)
before = Box(XLength=9, YLength=14, ZLength=4, Center=[-14, -6, 34])
behind = Plane(Origin=[-40, -30, -30], Point1=[40, -30, -40], Point2=[-40, 30, -30])

view = new_view("RenderViewWithSilhouettes")
ball = show_mesh(inside, [0.9, 0.8, 0.6])
ResetCamera(view)
picture("ball")
display = show(particles)
box = show_mesh(before, [0.6, 0.8, 0.9])
wall = show_mesh(behind, [0.8, 0.9, 0.7])
ResetCamera(view)
GetActiveCamera().Azimuth(15)
GetActiveCamera().Dolly(1.4)
picture("meshes")
picture("tiles", (600, 400))
view.SMProxy.InteractiveRender()

view.SilhouetteGreyByJump = view.SilhouetteWidthByJump = 1
view.SilhouetteMaximumLineWidth = 5
view.SilhouetteColor = [1, 1, 1]
picture("jump")
view.SilhouetteDarken = 1
picture("darkened")
view.SilhouetteGreyByJump = view.SilhouetteWidthByJump = view.SilhouetteDarken = 0
view.SilhouetteSamples = 1
picture("whole-pixels")
view.SilhouetteSamples = 2
picture("two-samples")
view.SilhouetteSamples = 4

view.SilhouetteRepresentations = [ball, box]
picture("chosen")
picture("chosen-tiles", (600, 400))
view.SilhouetteRepresentations = [display, ball]
picture("chosen-both")
view.SilhouetteRepresentations = []
ball.Opacity = 0.5
picture("translucent")
ball.Opacity = 1

display.Visibility = 0
picture("meshes-alone")
view.SilhouetteThreshold = 5
picture("threshold")
ball.Visibility = box.Visibility = wall.Visibility = 0
Render(view)  # nothing at all
display.Visibility = box.Visibility = 1
view.SilhouetteThreshold = 0
picture("box")
view.CameraParallelProjection = 1
view.CameraFocalPoint = [-14, -6, 0]
view.CameraPosition = [-14, -6, 80]
view.CameraParallelScale = 9
picture("close")

view = new_view("RenderView")
display = show(particles)
display.SilhouetteVisibility = 1
for mesh in inside, before, behind:
    show_mesh(mesh, [0.9, 0.8, 0.6])
ResetCamera(view)
GetActiveCamera().Azimuth(15)
GetActiveCamera().Dolly(1.4)
picture("plain")
picture("plain-tiles", (600, 400))
finish("")
"""
PICTURES = ("ball", "meshes", "tiles", "jump", "darkened", "whole-pixels", "two-samples", "chosen", "chosen-tiles",
            "chosen-both", "meshes-alone", "threshold", "box", "close", "plain", "plain-tiles")

# Darkened lines take the colour of a pixel in front. Around what is so thin that no pixel shows it that is the
# background, which ParaView puts behind a composited picture last: it is black until then.
LOOSE = {"darkened": 1.0}


def check_lines(path):
    """Fails unless lines of four samples beside meshes are smooth where those of one are not."""
    smooth, jagged = (images.read(f"{path}-{name}.png") for name in ("meshes", "whole-pixels"))
    changed = numpy.abs(smooth - jagged).max(axis=2) > 32
    assert changed.mean() > 0.02, changed.mean()


def main():
    pvbatch, mpiexec = sys.argv[1:3]
    whole = pieces.molecule()
    number = numpy.arange(whole.GetNumberOfPoints())
    with tempfile.TemporaryDirectory() as folder:
        slabs = pieces.write(folder, "slabs", whole, [number * 2 // len(number) == k for k in range(2)])
        mixed = pieces.write(folder, "mixed", whole, [number % 4 == k for k in range(4)])
        lonely = pieces.write(folder, "lonely", whole, [number < 0, number >= 0])
        alone, _ = rank_pictures.check(pvbatch, mpiexec, SESSION, PICTURES,
                                       [(slabs, 2), (mixed, 4), (lonely, 2)], LOOSE)
        check_lines(alone)


main()
