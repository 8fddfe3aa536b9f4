# SPDX-License-Identifier: BSD-3-Clause
"""Lines of ray-traced spheres that processes share, in Render View (Silhouettes) and in the plain render view:
those of one process, whoever has which particles.

Usage: pvpython test_rank_lines.py PVBATCH MPIEXEC
"""
import sys
import tempfile

import images
import numpy
import pieces
import rank_pictures

SESSION = """
def approach():
    # Shows the particles of some processes only.
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [-15, 5, 0]
    view.CameraPosition = [-15, 5, 60]
    view.CameraParallelScale = 6
    view.SMProxy.InteractiveRender()

def select():
    # The number of particles within a rectangle.
    SelectSurfacePoints(Rectangle=[100, 50, 200, 150], View=view)
    selected = ExtractSelection(Input=particles)
    selected.UpdatePipeline()
    count = selected.GetDataInformation().GetNumberOfPoints()
    ClearSelection(particles)
    Delete(selected)
    return count

view = new_view("RenderViewWithSilhouettes")
Render(view)  # nothing in sight
display = show(particles)
ResetCamera(view)
picture("default")
picture("tiles", (600, 400))

view.SilhouetteGreyByJump = view.SilhouetteWidthByJump = 1
view.SilhouetteMaximumLineWidth = 5
view.SilhouetteColor = [1, 1, 1]
picture("jump")
view.SilhouetteDarken = 1
picture("darkened")
view.SilhouetteGreyByJump = view.SilhouetteWidthByJump = view.SilhouetteDarken = 0

view.SilhouetteSamples = 1
picture("whole-pixels")
view.SilhouetteSamples = 4

moved = Transform(Input=particles)
moved.Transform.Translate = [15, 3, 20]
chosen = show(moved)
chosen.SMProxy.UpdateVTKObjects()
ResetCamera(view)
picture("two")
view.SilhouetteRepresentations = [chosen]
picture("chosen")
display.Visibility = 0
chosen.Visibility = 0
Render(view)  # nothing that has lines
display.Visibility = 1
view.SilhouetteRepresentations = []

approach()
picture("close")
counts = [select()]
picture("after-selection")

Show(Plane(Origin=[-60, -60, -15], Point1=[60, -60, -15], Point2=[-60, 60, -15]), view)
view.CameraParallelScale = 30
picture("mesh")

view = new_view("RenderView")
display = show(particles)
display.SilhouetteVisibility = 1
ResetCamera(view)
picture("plain")
picture("plain-tiles", (600, 400))
display.SilhouetteGreyByJump = display.SilhouetteWidthByJump = display.SilhouetteDarken = 1
display.SilhouetteMaximumLineWidth = 5
picture("plain-jump")
display.SilhouetteGreyByJump = display.SilhouetteWidthByJump = display.SilhouetteDarken = 0
approach()
picture("plain-close")
counts.append(select())
view.CameraParallelScale = 30
other = show(moved)  # without lines
Show(Plane(Origin=[-60, -60, 0], Point1=[60, -40, 15], Point2=[-60, 60, 0]), view)
picture("plain-others")
finish(counts)
"""
PICTURES = ("default", "tiles", "jump", "darkened", "whole-pixels", "two", "chosen", "close",
            "after-selection", "mesh", "plain", "plain-tiles", "plain-jump", "plain-close", "plain-others")


def check_lines(path):
    """Fails unless the default picture has smooth lines: pixels between black and the background."""
    picture = images.read(f"{path}-default.png")
    background = picture[0, 0]
    share = picture @ background / (background @ background)
    on_background = numpy.abs(picture - share[..., None] * background).max(axis=2) < 2
    smooth = (on_background & (share > 0.2) & (share < 0.8)).sum()
    assert smooth > 50, smooth


def main():
    pvbatch, mpiexec = sys.argv[1:3]
    whole = pieces.molecule()
    number = numpy.arange(whole.GetNumberOfPoints())
    with tempfile.TemporaryDirectory() as folder:
        slabs = pieces.write(folder, "slabs", whole, [number * 2 // len(number) == k for k in range(2)])
        mixed = pieces.write(folder, "mixed", whole, [number % 4 == k for k in range(4)])
        lonely = pieces.write(folder, "lonely", whole, [number >= 0, number < 0])
        alone, selected = rank_pictures.check(pvbatch, mpiexec, SESSION, PICTURES,
                                              [(slabs, 2), (mixed, 4), (lonely, 2)])
        check_lines(alone)
        assert selected not in ("", "[0, 0]"), selected


main()
