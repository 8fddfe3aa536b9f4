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
import servers
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")
PIECES = 4
COUNTERS = ("NumberOfParticles", "NumberOfTexels", "NumberOfParticlesDark", "NumberOfDirections")

# A processor may round a ray on the rim of a sphere differently when the spheres of a process have another
# middle: measured 1 level in 4 of 60,000 pixels.
RMS, OUTLIERS = 0.05, 0.0005

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
view.SilhouetteSamples = 1  # lines of several processes are not smooth
if port:
    view.RemoteRenderThreshold = {threshold}
display = Show(baked, view)
display.SetRepresentationType("Ray-Traced Spheres")
display.ShadingMode = "Ambient Occlusion"
ColorBy(display, ("POINTS", "charge"))
ResetCamera(view)
SaveScreenshot(r"{name}.png", view, ImageResolution=[300, 200])
baked.UpdatePropertyInformation()
with open(r"{name}.json", "w") as file:
    json.dump({{key: baked.GetPropertyValue(key) for key in {counters}}}, file)
if port:
    Disconnect()
"""


def part_of(whole, mask):
    """The points of `whole` where the mask is true, with their arrays."""
    def chosen(array):
        copy = numpy_to_vtk(vtk_to_numpy(array)[mask], deep=True)
        copy.SetName(array.GetName())
        return copy

    points = vtkPoints()
    points.SetData(chosen(whole.GetPoints().GetData()))
    part = vtkPolyData()
    part.SetPoints(points)
    data = whole.GetPointData()
    for i in range(data.GetNumberOfArrays()):
        part.GetPointData().AddArray(chosen(data.GetArray(i)))
    return part


def write_pieces(folder):
    """The molecule as a file of pieces, which processes share among them; the path."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(DATA, "molecule.vtp"))
    reader.Update()
    whole = reader.GetOutput()
    count = whole.GetNumberOfPoints()
    for k in range(PIECES):
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(part_of(whole, numpy.arange(count) * PIECES // count == k))
        writer.SetDataModeToBinary()
        writer.SetFileName(os.path.join(folder, f"piece{k}.vtp"))
        writer.Write()
    arrays = "".join(f'<PDataArray type="Float32" Name="{name}"/>' for name in ("radius", "charge"))
    pieces = "".join(f'<Piece Source="piece{k}.vtp"/>' for k in range(PIECES))
    path = os.path.join(folder, "molecule.pvtp")
    with open(path, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="PPolyData" version="1.0"><PPolyData GhostLevel="0">'
                   f"<PPointData>{arrays}</PPointData>"
                   '<PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>'
                   f"{pieces}</PPolyData></VTKFile>")
    return path


def run_session(command, folder, name, port=0, threshold=0):
    """Runs the session; returns the paths of its picture and its counters."""
    path = os.path.join(folder, name)
    with open(path + ".py", "w", encoding="utf-8") as file:
        file.write(SESSION.format(port=port, threshold=threshold, name=path, counters=COUNTERS,
                                  data=os.path.join(folder, "molecule.pvtp")))
    done = subprocess.run([*command, path + ".py"], capture_output=True, text=True, timeout=200,
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
        write_pieces(folder)
        reference = run_session([pvpython], folder, "alone")
        others = [run_session([*two, pvbatch], folder, "pvbatch-2"),
                  run_session([mpiexec, "-n", "4", pvbatch], folder, "pvbatch-4")]
        for name, threshold in (("pvserver-2-remote-rendering", 0), ("pvserver-2-local-rendering", 1000)):
            with servers.running([*two, pvserver]) as port:
                others.append(run_session([pvpython], folder, name, port, threshold))
        for other in others:
            images.compare_files(other + ".png", reference + ".png", rms=RMS, outliers=OUTLIERS)
            assert numbers(other) == numbers(reference), (other, numbers(other), numbers(reference))


main()
