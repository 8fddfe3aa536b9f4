# SPDX-License-Identifier: BSD-3-Clause
"""Textures of a file that the representation loads while they are seen, in pvpython.

The plugin's path is the argument or the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import sys
import tempfile
import unittest

from paraview import simple

import test_representation
from test_representation import differing, picture, programmable

# A ball of 2,000 particles, of which many are hidden.
BALL = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
grid = numpy.stack(numpy.meshgrid(*[numpy.arange(16)] * 3), axis=-1).reshape(-1, 3) - 7.5
grid = grid[(grid**2).sum(axis=1) < 60]
points = vtk.vtkPoints()
points.SetData(numpy_to_vtk(grid, deep=True))
radii = numpy_to_vtk(numpy.full(len(grid), 0.5), deep=True)
radii.SetName("radius")
output = self.GetPolyDataOutput()
output.SetPoints(points)
output.GetPointData().AddArray(radii)
"""
TEXTURE_BYTES = 8 * 8 + 16
MIB = 1024 * 1024


class Paging(unittest.TestCase):
    def setUp(self):
        test_representation.Representation.setUp(self)
        self.particles = programmable(BALL)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "textures.exr")
        self.expected = self.bake(self.file)
        self.display = simple.Show(self.particles, self.view)

    tearDown = test_representation.Representation.tearDown

    def bake(self, file, **light):
        """Writes the textures; returns their picture, drawn from the arrays of the filter."""
        baked = simple.SphereAmbientOcclusion(Input=self.particles, TextureResolution=8, SamplesPerTexel=16, **light)
        simple.SaveData(file, baked)
        expected = self.look(baked, simple.Show(baked, self.view))
        simple.Hide(baked, self.view)
        return expected

    def look(self, source, display):
        display.SetRepresentationType("Ray-Traced Spheres")
        display.ShadingMode = "Ambient Occlusion"
        simple.ResetCamera(self.view)
        self.view.GetActiveCamera().Dolly(2)
        return picture(self.view)

    def counters(self):
        self.display.SMProxy.UpdatePropertyInformation()
        return [self.display.SMProxy.GetProperty(name).GetElement(0)
                for name in ("NumberOfResidentTextures", "ResidentTextureBytes", "NumberOfMissingTextures")]

    def test_screenshots_are_those_of_the_bake(self):
        self.display.TextureFile = self.file
        self.assertEqual(differing(self.look(self.particles, self.display), self.expected), 0)
        resident, size, missing = self.counters()
        particles = self.particles.GetDataInformation().GetNumberOfPoints()
        self.assertEqual(missing, 0)
        self.assertEqual(size, resident * TEXTURE_BYTES)
        self.assertGreater(resident, 100)
        self.assertLess(resident, 0.7 * particles)

    def test_light_that_is_baked_is_drawn_from_the_file_as_from_the_arrays(self):
        """To two steps of 255 in each pixel, in bytes and in floats; the light and its shadows are in the textures."""
        for encoding in ("UInt8Gamma2", "Float32Linear"):
            with self.subTest(encoding):
                file = self.file.replace(".exr", f"-{encoding}.exr")
                expected = self.bake(file, BakeLight=1, LightDirection=[-1, -2, -1], LightIntensity=0.5,
                                     Encoding=encoding)
                self.assertGreater(differing(expected, self.expected), 0.3, "the light makes no difference")
                self.display.TextureFile = file
                self.assertEqual(differing(self.look(self.particles, self.display), expected), 0)
                self.assertEqual(self.counters()[2], 0)
                self.assertGreater(self.counters()[0], 100)

    def test_a_budget_limits_what_is_in_memory_and_the_rest_shows_means(self):
        self.display.TextureFile = self.file
        self.display.TextureBudget = 50 * TEXTURE_BYTES / MIB
        few = self.look(self.particles, self.display)
        resident, size, missing = self.counters()
        self.assertEqual((resident, size), (50, 50 * TEXTURE_BYTES))
        self.assertGreater(missing, 50)
        self.assertGreater(differing(few, self.expected), 0.05)
        self.display.TextureBudget = 1
        self.assertEqual(differing(picture(self.view), self.expected), 0)

    def test_nothing_stays_when_the_file_or_the_particles_are_no_longer_shown(self):
        self.display.TextureFile = self.file
        self.look(self.particles, self.display)
        simple.Hide(self.particles, self.view)
        simple.Render(self.view)
        self.assertEqual(self.counters()[:2], [0, 0])
        simple.Show(self.particles, self.view)
        self.assertEqual(differing(picture(self.view), self.expected), 0)
        self.display.TextureFile = ""
        simple.Render(self.view)
        self.assertEqual(self.counters(), [0, 0, 0])

    def test_a_cropped_display_keeps_its_textures(self):
        """Where the same particle is seen, so is the same texture."""
        self.display.TextureFile = self.file
        whole = self.look(self.particles, self.display)
        self.display.CropPlane, self.display.CropPlaneOrigin, self.display.CropPlaneNormal = 1, [0, 0, 0], [1, 0, 0]
        half = picture(self.view)
        shown = half.max(axis=2) > 0
        self.assertGreater((shown & (abs(half - whole).max(axis=2) <= 2)).mean(), 0.15)


if __name__ == "__main__":
    plugin = sys.argv.pop(1) if len(sys.argv) > 1 else os.environ["PARTICLEOCCLUSION_PLUGIN"]
    simple.LoadPlugin(plugin, ns=vars(simple))
    unittest.main()
