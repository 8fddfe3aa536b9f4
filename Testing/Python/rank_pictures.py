# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that several processes draw together against those of one."""
import os
import subprocess

import images
import servers

# As in test_ranks.py: a processor may round a ray on the rim of a sphere differently when the spheres of a
# process have another middle, and lines are rounded to 1/16383 on their way.
RMS, OUTLIERS = 0.05, 0.0005

# What sessions begin with; they tell by finish() what is to be compared besides pictures.
COMMON = """
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

def show(source):
    display = Show(source, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    ColorBy(display, ("POINTS", "charge"))
    return display

def finish(result):
    if int(os.environ.get("OMPI_COMM_WORLD_RANK", 0)) == 0:
        with open(r"{name}.txt", "w") as file:
            file.write(str(result))

particles = XMLPartitionedPolydataReader(FileName=[r"{data}"])
"""


def run(command, session, data, ranks):
    """Runs a session about a file of pieces; returns the path that its pictures begin with, and its result."""
    path = f"{os.path.splitext(data)[0]}-on-{ranks}"
    with open(path + ".py", "w", encoding="utf-8") as file:
        file.write(COMMON.format(name=path, data=data) + session)
    done = subprocess.run([*command, path + ".py"], capture_output=True, text=True, timeout=600,
                          cwd=os.path.dirname(data), env=servers.mpi_environment(), check=False)
    if done.returncode != 0 or not os.path.exists(path + ".txt") or "|" in done.stderr:
        raise SystemExit(f"{path} failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    with open(path + ".txt", encoding="utf-8") as file:
        return path, file.read()


def check(pvbatch, mpiexec, session, names, files, loose=None):
    """Runs a session with one process about the first file, and with several about all; fails unless pictures and
    results are equal. Returns those of one process.

    `files` are pairs of a file and the number of processes, `loose` the RMS that pictures may have in place of RMS.
    """
    alone, result = run([pvbatch], session, files[0][0], 1)
    for data, ranks in files:
        shared, other = run([mpiexec, "-n", str(ranks), pvbatch], session, data, ranks)
        assert other == result, (shared, other, result)
        for name in names:
            rms = (loose or {}).get(name, RMS)
            images.compare_files(f"{shared}-{name}.png", f"{alone}-{name}.png", rms=rms, outliers=OUTLIERS)
    return alone, result
