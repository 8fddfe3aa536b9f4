# SPDX-License-Identifier: BSD-3-Clause
"""The plugin loaded twice, and a bake that fails: the session goes on, and so do the particles."""

import os
import shutil
import tempfile
import unittest

from paraview import servermanager, simple

PLUGIN = os.environ["PARTICLEOCCLUSION_PLUGIN"]
SPHERES = """
points = vtk.vtkPoints()
radii = vtk.vtkFloatArray()
radii.SetName("radius")
for i in range(27):
    points.InsertNextPoint(i % 3, i // 3 % 3, i // 9)
    radii.InsertNextValue(0.5)
self.GetPolyDataOutput().SetPoints(points)
self.GetPolyDataOutput().GetPointData().AddArray(radii)
"""


def particles():
    return simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SPHERES)


def baked(source, **properties):
    bake = simple.SphereAmbientOcclusion(Input=source, TextureResolution=4, **properties)
    bake.UpdatePipeline()
    return servermanager.Fetch(bake)


def render():
    view = simple.CreateRenderView(ViewSize=(60, 50))
    source = particles()
    display = simple.Show(source, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    simple.Render(view)
    simple.Delete(view)
    simple.Delete(source)


class PluginTwice(unittest.TestCase):
    def test_works_after_every_loading(self):
        simple.LoadPlugin(PLUGIN, ns=vars(simple))
        first = baked(particles()).GetPointData().GetArray("AmbientOcclusion")
        render()
        for remote in (False, True):
            simple.LoadPlugin(PLUGIN, remote=remote, ns=vars(simple))
            again = baked(particles()).GetPointData().GetArray("AmbientOcclusion")
            self.assertEqual([first.GetValue(i) for i in range(27)], [again.GetValue(i) for i in range(27)])
            render()

    def test_a_copy_at_another_place(self):
        simple.LoadPlugin(PLUGIN, ns=vars(simple))
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, os.path.basename(PLUGIN))
            shutil.copy(PLUGIN, copy)
            try:
                simple.LoadPlugin(copy, ns=vars(simple))
            except RuntimeError:
                pass  # ParaView may refuse it, but must go on
            self.assertTrue(baked(particles()).GetPointData().HasArray("AmbientOcclusion"))
            render()

    def test_a_failed_bake_passes_the_particles_on(self):
        simple.LoadPlugin(PLUGIN, ns=vars(simple))
        output = baked(particles(), RadiusArray="nothing")
        self.assertEqual(output.GetNumberOfPoints(), 27)
        self.assertTrue(output.GetPointData().HasArray("radius"))
        self.assertFalse(output.GetPointData().HasArray("AmbientOcclusion"))
        self.assertFalse(output.GetFieldData().HasArray("AmbientOcclusionTextures"))


if __name__ == "__main__":
    unittest.main()
