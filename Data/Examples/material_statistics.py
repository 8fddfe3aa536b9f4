# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion by material: how open to the outside particles of each kind are.

    pvpython material_statistics.py particles.vtp --by type
    pvpython material_statistics.py bullet_1000.vtp --by damage --bins 4

A kind is a value of the point array, or a bin of equal width of its range. Prints a table, as CSV with --csv FILE too.
"""
import argparse
import csv
import os

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

plugin.load(globals())

COLUMNS = ("kind", "particles", "mean", "deviation", "5 %", "median", "95 %", "dark")


def bake(path, samples):
    """Point data of the particles with their occlusion: name -> array of N or N x components."""
    baked = SphereAmbientOcclusion(Input=OpenDataFile(path), SamplesPerTexel=samples)
    data = servermanager.Fetch(baked).GetPointData()
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array) for array in arrays if array.IsNumeric()}


def kinds(values, bins):
    """Label and mask of every kind."""
    if not bins:
        return [(f"{value:g}", values == value) for value in numpy.unique(values)]
    edges = numpy.linspace(values.min(), values.max(), bins + 1)
    bin_of = numpy.clip(numpy.searchsorted(edges, values, side="right") - 1, 0, bins - 1)
    return [(f"{edges[i]:.3g} to {edges[i + 1]:.3g}", bin_of == i) for i in range(bins)]


def row(kind, occlusion):
    """Statistics of the mean visibilities of the particles of one kind, 0 (dark) to 1 (open)."""
    if occlusion.size == 0:
        return [kind, 0] + [""] * (len(COLUMNS) - 2)
    numbers = [occlusion.mean(), occlusion.std(), *numpy.percentile(occlusion, (5, 50, 95)), (occlusion == 0).mean()]
    return [kind, occlusion.size] + [f"{number:.4f}" for number in numbers]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", help="particles in any format that ParaView reads as points")
    parser.add_argument("--by", required=True, help="point array that tells the kind")
    parser.add_argument("--bins", type=int, default=0, help="bins of equal width; without it each value is a kind")
    parser.add_argument("--samples", type=int, default=49, help="quality of the bake [%(default)s]")
    parser.add_argument("--csv", help="file for the table")
    options = parser.parse_args()
    arrays = bake(os.path.abspath(options.input), options.samples)
    if options.by not in arrays:
        raise SystemExit(f"There is no point array {options.by} in {options.input}, only {', '.join(arrays)}.")
    table = [row(kind, arrays["AmbientOcclusion"][mask]) for kind, mask in kinds(arrays[options.by], options.bins)]
    for line in [COLUMNS, *table]:
        print("".join(f"{cell:>16}" for cell in line))
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([COLUMNS, *table])


main()
