# SPDX-License-Identifier: BSD-3-Clause
"""Lines of ray-traced spheres that processes share, in Render View (Silhouettes) and in the plain render view:
those of one process, whoever has which particles.

Usage: pvpython test_rank_lines.py PVBATCH MPIEXEC
"""
import os
import subprocess
import sys
import tempfile

import images
import numpy
import pieces
import servers

# As in test_ranks.py: a processor may round a ray on the rim of a sphere differently when the spheres of a
# process have another middle, and lines are rounded to 1/16383 on their way.
RMS, OUTLIERS = 0.05, 0.0005

SESSION = """
import os
from paraview.simple import *
LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())

def picture(name, size=(300, 200)):
    SaveScreenshot(r"{name}-" + name + ".png", view, ImageResolution=size)

def new_view(kind):
    view = CreateView(kind)
    view.ViewSize = [300, 200]
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0
    return view

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

def show(source):
    display = Show(source, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    ColorBy(display, ("POINTS", "charge"))
    return display

particles = XMLPartitionedPolydataReader(FileName=[r"{data}"])
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

view.SilhouetteSamples = {mesh_samples}
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
if int(os.environ.get("OMPI_COMM_WORLD_RANK", 0)) == 0:
    with open(r"{name}.txt", "w") as file:
        file.write(str(counts))
"""
PICTURES = ("default", "tiles", "jump", "darkened", "whole-pixels", "two", "chosen", "close",
            "after-selection", "mesh", "plain", "plain-tiles", "plain-jump", "plain-close", "plain-others")


def run_session(command, folder, data, ranks, mesh_samples):
    """Runs the session; returns the path that its pictures and the numbers of selected particles begin with."""
    path = f"{os.path.splitext(data)[0]}-on-{ranks}"
    with open(path + ".py", "w", encoding="utf-8") as file:
        file.write(SESSION.format(name=path, data=data, mesh_samples=mesh_samples))
    done = subprocess.run([*command, path + ".py"], capture_output=True, text=True, timeout=600, cwd=folder,
                          env=servers.mpi_environment(), check=False)
    if done.returncode != 0 or not os.path.exists(path + ".txt") or "|" in done.stderr:
        raise SystemExit(f"{path} failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    return path


def selected(path):
    with open(path + ".txt", encoding="utf-8") as file:
        return file.read()


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
        # With a mesh in sight several processes have lines of whole pixels.
        alone = run_session([pvbatch], folder, slabs, 1, mesh_samples=1)
        check_lines(alone)
        assert selected(alone) not in ("", "[0, 0]"), selected(alone)
        for data, ranks in ((slabs, 2), (mixed, 4), (lonely, 2)):
            shared = run_session([mpiexec, "-n", str(ranks), pvbatch], folder, data, ranks, mesh_samples=4)
            assert selected(shared) == selected(alone), (shared, selected(shared), selected(alone))
            for name in PICTURES:
                images.compare_files(f"{shared}-{name}.png", f"{alone}-{name}.png", rms=RMS, outliers=OUTLIERS)


main()
