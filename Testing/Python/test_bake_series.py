# SPDX-License-Identifier: BSD-3-Clause
"""Data/Examples/bake_series.py: texture files beside the steps, what is there is skipped, failures are told.

Usage: pvpython test_bake_series.py PVBATCH
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.normpath(os.path.join(HERE, "..", "..", "Data"))
PVBATCH = sys.argv.pop()
SETTINGS = dict(TextureResolution=4, SamplesPerTexel=4, Encoding="Float32Linear")
LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())


class Series(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.steps = [self.file("heap.vtp"), self.file("molecule.vtp")]
        for step in self.steps:
            shutil.copy(os.path.join(DATA, os.path.basename(step)), step)

    def file(self, name):
        return os.path.join(self.folder, name)

    def bake_series(self, *arguments):
        settings = [f"{name}={value}" for name, value in SETTINGS.items()]
        return subprocess.run(
            [PVBATCH, os.path.join(DATA, "Examples", "bake_series.py"), *arguments, "--set", *settings],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600)

    def table(self, source):
        data = servermanager.Fetch(source)
        return vtk_to_numpy(data.GetFieldData().GetArray("AmbientOcclusionTextures"))

    def test_each_step_gets_its_textures(self):
        result = self.bake_series(*self.steps, "--precision", "Float", "--cache", self.file("cache"))
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("[2/2]", result.stdout)
        self.assertEqual(len(os.listdir(self.file("cache"))), 2)
        for step in self.steps:
            particles = OpenDataFile(step)
            loaded = LoadOcclusionTexturesEXR(
                Input=particles, FileName=os.path.splitext(step)[0] + ".occlusion.exr")
            baked = SphereAmbientOcclusion(
                Input=particles, UseCache=1, CacheDirectory=self.file("cache"), **SETTINGS)
            self.assertEqual(self.table(loaded).tolist(), self.table(baked).tolist())
            baked.UpdatePropertyInformation()
            self.assertEqual(baked.GetPropertyValue("LoadedFromCache"), 1)
        # What is there is not baked again; a step that cannot be read does not stop the others.
        os.remove(self.file("molecule.occlusion.exr"))
        again = self.bake_series(self.steps[0], self.file("none.vtp"), self.steps[1])
        self.assertEqual(again.returncode, 1, again.stdout)
        self.assertIn("heap.occlusion.exr: is there", again.stdout)
        self.assertIn("none.vtp: failed: there is no such file", again.stdout)
        self.assertTrue(os.path.exists(self.file("molecule.occlusion.exr")))


if __name__ == "__main__":
    unittest.main()
