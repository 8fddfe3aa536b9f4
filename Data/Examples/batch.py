# SPDX-License-Identifier: BSD-3-Clause
"""Bakes many files under MPI: each process takes files of its own, so that none waits for another.

    mpiexec -n 4 python3 batch.py --output baked *.vtp

Needs mpi4py, and the package particleocclusion beside VTK's: installed, or in PYTHONPATH. The files go to the folder
under their own names, with textures. At the end the first process prints a table of all; a file that cannot be baked
is named there, and the exit code is 1.
"""
import argparse
import os
import sys

from mpi4py import MPI
from particleocclusion import vtkSphereAmbientOcclusion
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def bake(path, folder, samples):
    """Row of the table: file, particles, mean occlusion, estimated error, seconds; or what went wrong."""
    name = os.path.basename(path)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    filter_ = vtkSphereAmbientOcclusion()
    filter_.SetInputConnection(reader.GetOutputPort())
    filter_.SetController(None)  # not one bake of all processes together
    filter_.SetSamplesPerTexel(samples)
    filter_.Update()
    if reader.GetErrorCode() or filter_.GetErrorCode() or filter_.GetNumberOfParticles() == 0:
        return name, "failed: see the messages above"
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(filter_.GetOutputPort())
    writer.SetDataModeToBinary()  # Debian's ParaView 5.11 cannot read appended data
    writer.SetFileName(os.path.join(folder, name))
    if not writer.Write():
        return name, f"cannot be written to {folder}"
    mean = vtk_to_numpy(filter_.GetOutput().GetPointData().GetArray("AmbientOcclusion")).mean()
    return (name, f"{filter_.GetNumberOfParticles():,}", f"{mean:.4f}", f"{filter_.GetEstimatedError():.4f}",
            f"{filter_.GetBakeSeconds():.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", help="VTK PolyData files (.vtp) with particles")
    parser.add_argument("--output", required=True, help="folder of the results")
    parser.add_argument("--samples", type=int, default=49, help="quality [%(default)s]")
    options = parser.parse_args()
    world = MPI.COMM_WORLD
    os.makedirs(options.output, exist_ok=True)
    # The largest first, dealt out in turn.
    files = sorted(options.files, key=lambda path: (-os.path.getsize(path), path))
    rows = world.gather([bake(path, options.output, options.samples) for path in files[world.rank::world.size]])
    failed = 0
    if world.rank == 0:
        table = sorted(row for part in rows for row in part)
        print("file\tparticles\tmean occlusion\tRMS error\tseconds")
        print("\n".join("\t".join(row) for row in table))
        failed = any(len(row) == 2 for row in table)
    sys.exit(int(world.bcast(failed)))


main()
