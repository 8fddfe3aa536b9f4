# SPDX-License-Identifier: BSD-3-Clause
"""Several processes of ParaView's own engine: pvbatch and pvserver under MPI, with remote and with local
rendering, give the picture and the numbers of one process.

Usage: pvpython test_ranks.py PVPYTHON PVBATCH PVSERVER MPIEXEC
"""
import json
import os
import subprocess
import sys
import tempfile

import images
import numpy
import pieces
import servers
from vtkmodules.util.numpy_support import vtk_to_numpy

PIECES = 4
COUNTERS = ("NumberOfParticles", "NumberOfTexels", "NumberOfParticlesDark", "NumberOfDirections")

# A processor may round a ray on the rim of a sphere differently when the spheres of a process have another
# middle: measured 1 level in 4 of 60,000 pixels.
RMS, OUTLIERS = 0.05, 0.0005
# Translucent spheres that reach into the next slab are behind or in front of it as a whole: measured 3.5 with two
# slabs, 5.0 with four. A picture without any spheres differs by 15 and more.
TRANSLUCENT_RMS = 8

SESSION = """
import json
import os
from paraview.simple import *
plugin = os.environ["PARTICLEOCCLUSION_PLUGIN"]
port = {port}
if port:
    Connect("localhost", port)
    LoadPlugin(plugin, remote=True, ns=globals())
LoadPlugin(plugin, remote=False, ns=globals())
particles = XMLPartitionedPolydataReader(FileName=[r"{data}"])
baked = SphereAmbientOcclusion(Input=particles, TextureResolution=8, SamplesPerTexel=16)
view = CreateView("RenderViewWithSilhouettes")
view.ViewSize = [300, 200]
view.OrientationAxesVisibility = 0
view.UseFXAA = 0
if port:
    view.RemoteRenderThreshold = {threshold}
display = Show(baked, view)
display.SetRepresentationType("Ray-Traced Spheres")
display.ShadingMode = "Ambient Occlusion"
ColorBy(display, ("POINTS", "charge"))
ResetCamera(view)
SaveScreenshot(r"{name}.png", view, ImageResolution=[300, 200])
plain = CreateRenderView(ViewSize=[300, 200], OrientationAxesVisibility=0, UseFXAA=0)
if port:
    plain.RemoteRenderThreshold = {threshold}
lined = Show(baked, plain)
lined.SetRepresentationType("Ray-Traced Spheres")
lined.SilhouetteVisibility = 1
ColorBy(lined, ("POINTS", "charge"))
ResetCamera(plain)
SaveScreenshot(r"{name}-plain.png", plain, ImageResolution=[300, 200])
lined.SilhouetteVisibility = 0
lined.Opacity = 0.5
SaveScreenshot(r"{name}-translucent.png", plain, ImageResolution=[300, 200])
if {writes}:
    SaveData(r"{textures}", baked)
paged = CreateRenderView(ViewSize=[300, 200], OrientationAxesVisibility=0, UseFXAA=0)
if port:
    paged.RemoteRenderThreshold = {threshold}
bare = Show(particles, paged)  # each process finds the textures of its particles in the file
bare.SetRepresentationType("Ray-Traced Spheres")
bare.ShadingMode = "Ambient Occlusion"
bare.TextureFile = r"{textures}"
ColorBy(bare, ("POINTS", "charge"))
ResetCamera(paged)
SaveScreenshot(r"{name}-paged.png", paged, ImageResolution=[300, 200])
baked.UpdatePropertyInformation()
with open(r"{name}.json", "w") as file:
    json.dump({{key: baked.GetPropertyValue(key) for key in {counters}}}, file)
if port:
    Disconnect()
"""


def run_session(command, folder, name, port=0, threshold=0):
    """Runs the session; returns the paths of its picture and its counters."""
    path = os.path.join(folder, name)
    with open(path + ".py", "w", encoding="utf-8") as file:
        file.write(SESSION.format(port=port, threshold=threshold, name=path, counters=COUNTERS,
                                  textures=os.path.join(folder, "textures.exr"), writes=name == "alone",
                                  data=os.path.join(folder, "molecule.pvtp")))
    done = subprocess.run([*command, path + ".py"], capture_output=True, text=True, timeout=600,
                          env=servers.mpi_environment(), check=False)
    if done.returncode != 0 or not os.path.exists(path + ".png") or "WARN|" in done.stderr:
        raise SystemExit(f"{name} failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    return path


def numbers(path):
    with open(path + ".json", encoding="utf-8") as file:
        return json.load(file)


def main():
    pvpython, pvbatch, pvserver, mpiexec = sys.argv[1:5]
    two = [mpiexec, "-n", "2"]
    with tempfile.TemporaryDirectory() as folder:
        whole = pieces.molecule()
        x = vtk_to_numpy(whole.GetPoints().GetData())[:, 0]
        piece = numpy.argsort(numpy.argsort(x)) * PIECES // len(x)  # slabs
        pieces.write(folder, "molecule", whole, [piece == k for k in range(PIECES)])
        reference = run_session([pvpython], folder, "alone")
        others = [run_session([*two, pvbatch], folder, "pvbatch-2"),
                  run_session([mpiexec, "-n", "4", pvbatch], folder, "pvbatch-4")]
        for name, threshold in (("pvserver-2-remote-rendering", 0), ("pvserver-2-local-rendering", 1000)):
            with servers.running([*two, pvserver]) as port:
                others.append(run_session([pvpython], folder, name, port, threshold))
        for other in others:
            for suffix in (".png", "-plain.png", "-paged.png"):
                images.compare_files(other + suffix, reference + suffix, rms=RMS, outliers=OUTLIERS)
            suffix = "-translucent.png"
            images.compare_files(other + suffix, reference + suffix, rms=TRANSLUCENT_RMS, outliers=1)
            assert numbers(other) == numbers(reference), (other, numbers(other), numbers(reference))


main()
