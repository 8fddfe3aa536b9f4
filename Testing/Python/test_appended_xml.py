# SPDX-License-Identifier: BSD-3-Clause
"""The way round the appended-XML trap that the README describes: binary data can be read back, and where
this ParaView fails on appended data, the README says so."""
import os
import tempfile

from paraview.simple import *

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def points_read_back(source, path, mode):
    SaveData(path, source, DataMode=mode)
    reader = XMLPolyDataReader(FileName=[path])
    reader.UpdatePipeline()
    return reader.GetDataInformation().GetNumberOfPoints()


LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())
particles = OpenDataFile(os.path.join(ROOT, "Data", "molecule.vtp"))
baked = SphereAmbientOcclusion(Input=particles, TextureResolution=4, SamplesPerTexel=4)
with tempfile.TemporaryDirectory() as folder:
    expected = baked.GetDataInformation().GetNumberOfPoints() or 3341
    assert points_read_back(baked, os.path.join(folder, "binary.vtp"), "Binary") == expected
    if points_read_back(baked, os.path.join(folder, "appended.vtp"), "Appended") != expected:
        with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
            text = file.read()
        assert "appended" in text and 'DataMode="Binary"' in text, "the README lacks the hint"
