# SPDX-License-Identifier: BSD-3-Clause
"""Bakes many files under MPI: each process takes files of its own, so that none waits for another.

    mpiexec -n 4 pvpython --no-mpi batch.py --output baked *.vtp dump.* *.xyz

Reads whatever ParaView reads as points, LAMMPS dumps and XYZ too; of a file with several time steps the first
(bake_series.py bakes all). The results, with textures, go to the folder as .vtp, .vtu or .vtm of the same names. Needs
mpi4py, to which --no-mpi leaves the processes. At the end the first process prints a table of all; a file that cannot be
baked is named there, and the exit code is 1.
"""
import argparse
import os
import re
import sys
import time

from mpi4py import MPI
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

EXTENSIONS = {"vtkPolyData": ".vtp", "vtkUnstructuredGrid": ".vtu"}


def mean_occlusion(baked):
    data = servermanager.Fetch(baked)
    blocks = [data]
    if data.IsA("vtkCompositeDataSet"):
        iterator = data.NewIterator()
        blocks = []
        while not iterator.IsDoneWithTraversal():
            blocks.append(iterator.GetCurrentDataObject())
            iterator.GoToNextItem()
    values = [vtk_to_numpy(block.GetPointData().GetArray("AmbientOcclusion")) for block in blocks]
    return sum(each.sum() for each in values) / sum(len(each) for each in values)


def stem(path):
    """The name without what tells the kind of the file; numbers of time steps stay."""
    return re.sub(r"(\.[A-Za-z]\w*)?(\.gz)?$", "", os.path.basename(path))


def save(baked, path):
    information = baked.GetDataInformation()
    extension = ".vtm" if information.IsCompositeDataSet() else EXTENSIONS[information.GetDataSetTypeAsString()]
    # Binary: ParaView 5.11 of Debian cannot read appended data everywhere.
    SaveData(path + extension, baked, DataMode="Binary")
    return os.path.exists(path + extension)


def bake(path, folder, samples):
    """Row of the table: file, particles, mean occlusion, estimated error, seconds; or what went wrong."""
    name = os.path.basename(path)
    start = time.time()
    try:
        reader = OpenDataFile(os.path.abspath(path))
        baked = SphereAmbientOcclusion(Input=reader, SamplesPerTexel=samples)
        baked.UpdatePipeline()
        baked.UpdatePropertyInformation()
        particles = baked.GetPropertyValue("NumberOfParticles")
        if not particles:
            return name, "failed: see the messages above"
        row = (name, f"{particles:,}", f"{mean_occlusion(baked):.4f}", f"{baked.GetPropertyValue('EstimatedError'):.4f}",
               f"{time.time() - start:.2f}")
        if not save(baked, os.path.join(folder, stem(name))):
            return name, f"failed: cannot be written to {folder}"
        Delete(baked)
        Delete(reader)
        return row
    except (RuntimeError, ValueError, TypeError, KeyError) as error:
        return name, f"failed: {error}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", help="files with particles")
    parser.add_argument("--output", required=True, help="folder of the results")
    parser.add_argument("--samples", type=int, default=49, help="quality [%(default)s]")
    options = parser.parse_args()
    stems = [stem(path) for path in options.files]
    twice = sorted({each for each in stems if stems.count(each) > 1})
    if twice:
        sys.exit(f"Several files would become {', '.join(twice)} in {options.output}: bake them into different folders.")
    plugin.load(globals())
    world = MPI.COMM_WORLD
    os.makedirs(options.output, exist_ok=True)
    # The largest first, dealt out in turn; one that is missing fails as such.
    files = sorted(options.files, key=lambda path: (-os.path.getsize(path) if os.path.exists(path) else 0, path))
    rows = world.gather([bake(path, options.output, options.samples) for path in files[world.rank::world.size]])
    failed = 0
    if world.rank == 0:
        table = sorted(row for part in rows for row in part)
        print("file\tparticles\tmean occlusion\tRMS error\tseconds")
        print("\n".join("\t".join(row) for row in table))
        failed = any(len(row) == 2 for row in table)
    sys.exit(int(world.bcast(failed)))


main()
