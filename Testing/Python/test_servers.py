# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in pvbatch and in servers that a pvpython client connects to, a pvserver as well as a data server and
a render server apart, with remote and with local rendering: the same picture everywhere, with textures that were
baked and with those of a file.

Two ranks with a part of the particles each draw the lines that one rank draws.

Usage: pvpython test_servers.py PVPYTHON PVBATCH PVSERVER MPIEXEC PVDATASERVER PVRENDERSERVER
"""
import os
import subprocess
import sys
import tempfile
import time

import images
import servers

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")

SESSION = """
import os
from paraview.simple import *
plugin = os.environ["PARTICLEOCCLUSION_PLUGIN"]
ports = {ports}  # none, that of a server, or those of a data server and of a render server
if ports:
    Connect(*(argument for port in ports for argument in ("localhost", port)))
    LoadPlugin(plugin, remote=True, ns=globals())
LoadPlugin(plugin, remote=False, ns=globals())
particles = OpenDataFile(r"{data}")
baked = SphereAmbientOcclusion(Input=particles, TextureResolution=4, SamplesPerTexel=16)
view = CreateView("RenderViewWithSilhouettes")
view.ViewSize = [300, 200]
view.OrientationAxesVisibility = 0
view.UseFXAA = 0
if ports:
    view.RemoteRenderThreshold = {threshold}
display = Show(baked, view)
display.SetRepresentationType("Ray-Traced Spheres")
ColorBy(display, ("POINTS", "charge"))
ResetCamera(view)
SaveScreenshot(r"{picture}", view, ImageResolution=[300, 200])
display.LayersFile = r"{picture}.exr"  # by the process that draws: here all see the same files
display.LayersResolution = [450, 300]
display.SMProxy.InvokeCommand("WriteLayers")
SaveData(r"{picture}-textures.exr", baked)
Hide(baked, view)
paged = Show(particles, view)  # the same textures, from the file
paged.SetRepresentationType("Ray-Traced Spheres")
paged.TextureFile = r"{picture}-textures.exr"
ColorBy(paged, ("POINTS", "charge"))
SaveScreenshot(r"{picture}-paged.png", view, ImageResolution=[300, 200])
if ports:
    Disconnect()
"""


def wait_for(file):
    """Whether a file is there within a minute."""
    for _ in range(300):
        if os.path.exists(file):
            return True
        time.sleep(0.2)
    return False


RANKS = """
import os
from paraview.simple import *
LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())
particles = ConvertToPointCloud(Input=Wavelet(WholeExtent=[0, 6, 0, 6, 0, 6]))  # a part on each rank
view = CreateView("RenderViewWithSilhouettes")
view.ViewSize = [300, 240]
view.OrientationAxesVisibility = 0
view.UseFXAA = 0
view.SilhouetteThreshold = 2
display = Show(particles, view)
display.SetRepresentationType("Ray-Traced Spheres")
display.RadiusArray = "(none)"
display.ConstantRadius = 0.4
ColorBy(display, None)
ResetCamera(view)
view.GetActiveCamera().Azimuth(30)
view.GetActiveCamera().Elevation(20)
SaveScreenshot(r"{picture}", view, ImageResolution=[300, 240])
"""


def run_ranks(mpiexec, pvbatch, folder, ranks):
    """Lines that are found after compositing; returns the path of the picture."""
    picture = os.path.join(folder, f"ranks{ranks}.png")
    script = os.path.join(folder, f"ranks{ranks}.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(RANKS.format(picture=picture))
    done = subprocess.run([mpiexec, "-n", str(ranks), pvbatch, script], capture_output=True, text=True,
                          timeout=300, check=False, env=servers.mpi_environment())
    if done.returncode != 0 or not os.path.exists(picture):
        raise SystemExit(f"{ranks} ranks failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    return picture


def run_session(executable, folder, name, ports=(), threshold=0):
    """Runs the session; returns the path of its picture."""
    picture = os.path.join(folder, name + ".png")
    script = os.path.join(folder, name + ".py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(SESSION.format(ports=ports, threshold=threshold, picture=picture,
                                  data=os.path.join(DATA, "molecule.vtp")))
    done = subprocess.run([executable, script], capture_output=True, text=True, timeout=300, check=False)
    # A server goes on with what it was asked for after its client has left.
    complete = all(wait_for(picture + suffix) for suffix in ("", ".exr", "-paged.png"))
    if done.returncode != 0 or not complete or "ERR|" in done.stderr:
        raise SystemExit(f"{name} failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    images.compare_files(picture + "-paged.png", picture, rms=0, outliers=0)
    return picture


def with_server(pvserver, pvpython, folder, name, threshold):
    with servers.running([pvserver]) as port:
        return run_session(pvpython, folder, name, [port], threshold)


def with_separate_servers(data_server, render_server, pvpython, folder, name, threshold):
    """One process has the data and another one draws them."""
    with servers.running([data_server], "data-server") as data_port, \
            servers.running([render_server], "render-server") as render_port:
        return run_session(pvpython, folder, name, [data_port, render_port], threshold)


def main():
    pvpython, pvbatch, pvserver, mpiexec, data_server, render_server = sys.argv[1:7]
    with tempfile.TemporaryDirectory() as folder:
        reference = run_session(pvpython, folder, "pvpython")
        others = [
            run_session(pvbatch, folder, "pvbatch"),
            with_server(pvserver, pvpython, folder, "pvserver-remote-rendering", 0),
            with_server(pvserver, pvpython, folder, "pvserver-local-rendering", 1000),
            with_separate_servers(data_server, render_server, pvpython, folder, "separate-remote-rendering", 0),
            with_separate_servers(data_server, render_server, pvpython, folder, "separate-local-rendering", 1000),
        ]
        for picture in others:
            images.compare_files(picture, reference)
        images.compare_files(run_ranks(mpiexec, pvbatch, folder, 2), run_ranks(mpiexec, pvbatch, folder, 1),
                             rms=0.5, outliers=0.0002)


main()
