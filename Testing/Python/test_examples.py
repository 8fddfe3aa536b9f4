# SPDX-License-Identifier: BSD-3-Clause
"""The example scripts on shipped data, at small sizes: what they write and what they say is wrong; and what help() says.

Usage: pvpython test_examples.py PVPYTHON PYTHON MPIEXEC PYTHON_PACKAGES
"""
import csv
import os
import subprocess
import sys
import tempfile

import images
import servers
from paraview import servermanager, simple

PVPYTHON, PYTHON, MPIEXEC, PACKAGES = sys.argv[1:5]
DATA = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data"))
BULLET, HEAP, MOLECULE = (os.path.join(DATA, name + ".vtp") for name in ("bullet_1000", "heap", "molecule"))


def script(name):
    return os.path.join(DATA, "Examples", name)


def run(*command, code=0):
    """Runs a command; returns what it printed and what it complained of."""
    environment = dict(servers.mpi_environment(), PYTHONPATH=PACKAGES)
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment, check=False)
    if done.returncode != code or (code == 0 and ("Traceback" in done.stderr or "ERR|" in done.stderr)):
        raise SystemExit(f"{command} ended with {done.returncode}:\n{done.stdout}\n{done.stderr}")
    return done.stdout, done.stderr


def check_movie(folder):
    frames = os.path.join(folder, "frames.png")
    run(PVPYTHON, script("movie.py"), "--output", frames, "--size", "160", "90", "--samples", "4", "--steps", "2")
    first, last = (images.read(os.path.join(folder, f"frames.000{i}.png")) for i in range(2))
    assert first.shape == (90, 160, 3) and abs(first - last).mean() > 1, "nothing moves"
    movie = os.path.join(folder, "movie.avi")
    run(PVPYTHON, script("movie.py"), "--output", movie, "--size", "160", "90", "--samples", "4", HEAP, HEAP)
    assert os.path.getsize(movie) > 1000


def check_figure(folder):
    name = os.path.join(folder, "figure")
    run(PVPYTHON, script("figure.py"), HEAP, name, "--color", "speed", "--size", "320", "180", "--error", "0.05")
    assert images.read(name + ".png").shape == (180, 320, 3)
    with open(name + ".exr", "rb") as file:
        head = file.read(1000)
    for layer in (b"AO\0", b"Z\0", b"N.X\0"):
        assert layer in head, f"{layer} is not in figure.exr"


def check_batch(folder):
    """Two processes share files of several kinds, and two that cannot be read."""
    files = {name: os.path.join(folder, name) for name in ("broken.vtp", "water.xyz", "heap.vtu", "notes.text")}
    for name, text in (("broken.vtp", "no particles"), ("notes.text", "none"),
                       ("water.xyz", "3\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n")):
        with open(files[name], "w", encoding="utf-8") as file:
            file.write(text)
    simple.SaveData(files["heap.vtu"], simple.AppendDatasets(Input=simple.OpenDataFile(HEAP)), DataMode="Binary")
    out = os.path.join(folder, "baked")
    printed, _ = run(MPIEXEC, "-n", "2", PVPYTHON, "--no-mpi", script("batch.py"), "--output", out, "--samples", "4",
                     BULLET, MOLECULE, *files.values(), code=1)
    for name, result, count in (("bullet_1000.vtp", "bullet_1000.vtp", 25710), ("molecule.vtp", "molecule.vtp", 3341),
                                ("heap.vtu", "heap.vtu", 6075), ("water.xyz", "water.vtp", 3)):
        assert f"{name}\t{count:,}\t" in printed, printed
        data = servermanager.Fetch(simple.OpenDataFile(os.path.join(out, result)))
        assert data.GetNumberOfPoints() == count
        assert data.GetFieldData().GetAbstractArray("AmbientOcclusionTextures")
    _, complaint = run(PVPYTHON, script("batch.py"), "--output", out, "a/step.xyz", "b/step.vtp", code=1)
    assert "Several files would become step" in complaint, complaint
    for name in ("broken.vtp", "notes.text"):
        assert f"{name}\tfailed" in printed, printed
    assert len(os.listdir(out)) == 4, os.listdir(out)


def check_statistics(folder):
    table = os.path.join(folder, "table.csv")
    run(PVPYTHON, script("material_statistics.py"), BULLET, "--by", "damage", "--bins", "4", "--samples", "4",
        "--csv", table)
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 and sum(int(row["particles"]) for row in rows) == 25710, rows
    assert all(0 <= float(row["5 %"]) <= float(row["median"]) <= float(row["95 %"]) <= 1 for row in rows), rows
    _, complaint = run(PVPYTHON, script("material_statistics.py"), BULLET, "--by", "colour", code=1)
    assert "There is no point array colour" in complaint and "damage" in complaint, complaint


def check_plain_vtk(folder):
    """The picture of the same program in C++."""
    picture = os.path.join(folder, "plain-vtk.png")
    run(PYTHON, script("plain_vtk.py"), MOLECULE, picture)
    images.compare(picture, "plain-vtk.png")


#: Beginnings of the names of what the plugin adds to a display and a view of ParaView's.
ADDED = ("Silhouette", "Crop", "Radius", "ConstantRadius", "Density", "Shading", "OcclusionOn", "Shadows", "SamplesPer",
         "InteractiveRate", "Layers", "DisplayPresets")


def require_help(proxy, least, beginnings=""):
    """help() describes the proxy and at least so many properties whose names begin so, none of them with nothing."""
    help_of = {key: value.__doc__ for key, value in vars(type(proxy)).items()
               if isinstance(value, property) and key.startswith(beginnings)}
    assert len(help_of) >= least and len(type(proxy).__doc__) > 50, (list(help_of), type(proxy).__doc__)
    silent = [key for key, text in help_of.items() if not (text or "").strip()]
    assert not silent, f"{type(proxy).__name__} says nothing of {silent}"


def check_help(_):
    """help() of filters, the reader, a display and the view describes each, and every property that is the plugin's."""
    simple.LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=vars(simple))
    baked = simple.SphereAmbientOcclusion(Input=simple.OpenDataFile(HEAP))
    view = simple.CreateView("RenderViewWithSilhouettes")
    require_help(baked, 20)
    require_help(simple.DepthSilhouettes(Input=simple.Wavelet()), 10)
    require_help(simple.LoadOcclusionTexturesEXR(Input=baked), 2)
    require_help(simple.LAMMPSDumpandXYZReader(), 2)
    require_help(simple.Show(baked, view), 35, ADDED)
    require_help(view, 18, "Silhouette")


with tempfile.TemporaryDirectory() as work:
    for check in (check_help, check_movie, check_figure, check_batch, check_statistics, check_plain_vtk):
        check(work)
