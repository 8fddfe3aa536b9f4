# SPDX-License-Identifier: BSD-3-Clause
"""Data/Examples/bake_series.py: texture files beside the steps, what is there is skipped, failures are told,
and several processes may share a cache.

Usage: pvpython test_bake_series.py PVBATCH
"""
import os
import re
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

    def start_series(self, *arguments, **more):
        settings = [f"{name}={value}" for name, value in {**SETTINGS, **more}.items()]
        process = subprocess.Popen(
            [PVBATCH, os.path.join(DATA, "Examples", "bake_series.py"), *arguments, "--set", *settings],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.kill)
        return process

    def finish_series(self, process):
        output, _ = process.communicate(timeout=600)
        return subprocess.CompletedProcess(process.args, process.returncode, output)

    def bake_series(self, *arguments, **more):
        return self.finish_series(self.start_series(*arguments, **more))

    def table(self, source):
        data = servermanager.Fetch(source)
        return vtk_to_numpy(data.GetFieldData().GetArray("AmbientOcclusionTextures"))

    def test_each_step_gets_its_textures(self):
        result = self.bake_series(*self.steps, "--precision", "Float", "--cache", self.file("cache"))
        self.assertEqual(result.returncode, 0, result.stdout)
        for line, name in (("[1/2]", "heap"), ("[2/2]", "molecule")):
            self.assertRegex(result.stdout, re.escape(line) + f" .*{name}.occlusion.exr: [0-9]+ particles, .* s left")
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

    def test_what_rests_keeps_its_textures(self):
        heap = OpenDataFile(self.steps[0])
        moved = Calculator(Input=heap, CoordinateResults=1, Function="coords + 0.1 * iHat * (coordsZ > 20)")
        SaveData(self.file("later.vtp"), moved, DataMode="Binary")
        result = self.bake_series(
            self.steps[0], self.file("later.vtp"), "--precision", "Float", ReuseUnchanged=1, MaximumDistance=2.0)
        self.assertEqual(result.returncode, 0, result.stdout)
        particles, reused = map(int, re.search(r"later.*: (\d+) particles, (\d+) as before", result.stdout).groups())
        self.assertGreater(reused, 0.2 * particles)
        self.assertLess(reused, particles)
        # The texture file is that of a bake of the step alone.
        baked = SphereAmbientOcclusion(Input=OpenDataFile(self.file("later.vtp")), ReuseUnchanged=1,
                                       MaximumDistance=2.0, **SETTINGS)
        loaded = LoadOcclusionTexturesEXR(
            Input=OpenDataFile(self.file("later.vtp")), FileName=self.file("later.occlusion.exr"))
        self.assertEqual(self.table(loaded).tolist(), self.table(baked).tolist())

    def test_processes_share_a_cache(self):
        folders = [self.file("first"), self.file("second")]
        for folder in folders:
            os.mkdir(folder)
        processes = [self.start_series(*self.steps, "--output", folder, "--cache", self.file("cache"))
                     for folder in folders]
        for result in [self.finish_series(process) for process in processes]:
            self.assertEqual(result.returncode, 0, result.stdout)
        # Whoever was first, a step has one entry, and nothing half-written is left.
        entries = os.listdir(self.file("cache"))
        self.assertEqual([os.path.splitext(entry)[1] for entry in entries], 2 * [".pobake"])
        for step in self.steps:
            name = os.path.splitext(os.path.basename(step))[0] + ".occlusion.exr"
            first, second = (self.table(LoadOcclusionTexturesEXR(
                Input=OpenDataFile(step), FileName=os.path.join(folder, name))) for folder in folders)
            self.assertEqual(first.tolist(), second.tolist())
            kept = SphereAmbientOcclusion(
                Input=OpenDataFile(step), UseCache=1, CacheDirectory=self.file("cache"), **SETTINGS)
            kept.UpdatePipeline()
            kept.UpdatePropertyInformation()
            self.assertEqual(kept.GetPropertyValue("LoadedFromCache"), 1)


if __name__ == "__main__":
    unittest.main()
