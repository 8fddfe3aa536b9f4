# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of pictures with a stated metric."""
import os
import shutil

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

BASELINES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data", "Baseline")


def read(path):
    """The RGB values of a PNG file as float64[height, width, 3], 0 to 255, rows from the bottom."""
    reader = vtkPNGReader()
    if not reader.CanReadFile(path):
        raise SystemExit(f"{path} is not a PNG file")
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    values = vtk_to_numpy(image.GetPointData().GetScalars())
    return values.reshape(height, width, -1)[:, :, :3].astype(float)


def compare_files(path, reference, rms=3.0, outliers=0.01):
    """Fails unless two pictures are equal.

    The metric: the RMS difference over all pixels and channels is at most `rms` of 255 levels, and at
    most the share `outliers` of pixels differs by more than 32 levels in any channel. A renderer of
    another processor may decide a pixel on the rim of a sphere differently; a missing object, light,
    texture or line changes far more.
    """
    ours, theirs = read(path), read(reference)
    name = os.path.basename(path)
    if ours.shape != theirs.shape:
        raise SystemExit(f"{name} has the shape {ours.shape}, {reference} has {theirs.shape}")
    if numpy.ptp(theirs) < 64:
        raise SystemExit(f"{reference} shows nothing")
    difference = numpy.abs(ours - theirs)
    found_rms = float(numpy.sqrt(numpy.mean(difference**2)))
    found_outliers = float(numpy.mean(difference.max(axis=2) > 32))
    print(f"{name}: RMS {found_rms:.3f} levels, outliers {100 * found_outliers:.3f} %")
    if found_rms > rms or found_outliers > outliers:
        raise SystemExit(
            f"{path} differs from {reference}: RMS {found_rms:.2f} (at most {rms}), "
            f"outliers {100 * found_outliers:.2f} % (at most {100 * outliers} %)")


def compare(path, baseline):
    """Fails unless the picture equals the baseline picture (see compare_files).

    With PARTICLEOCCLUSION_WRITE_BASELINES in the environment the picture becomes the baseline.
    """
    reference = os.path.join(BASELINES, baseline)
    if os.environ.get("PARTICLEOCCLUSION_WRITE_BASELINES"):
        shutil.copyfile(path, reference)
    compare_files(path, reference)
