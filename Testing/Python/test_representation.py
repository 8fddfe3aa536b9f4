# SPDX-License-Identifier: BSD-3-Clause
"""The representation Ray-Traced Spheres in pvpython.

The plugin's path is the argument or the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import sys
import tempfile
import unittest

import numpy
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = (240, 180)
TYPE = "Ray-Traced Spheres"
CUBE = """
import itertools
points = vtk.vtkPoints()
radii = vtk.vtkFloatArray()
radii.SetName("radius")
values = vtk.vtkFloatArray()
values.SetName("value")
for i, p in enumerate(itertools.product(range(4), repeat=3)):
    points.InsertNextPoint(p)
    radii.InsertNextValue(0.45)
    values.InsertNextValue(i)
data = vtk.vtkPolyData()
data.SetPoints(points)
data.GetPointData().AddArray(radii)
data.GetPointData().AddArray(values)
"""
POLY_DATA = CUBE + "self.GetPolyDataOutput().ShallowCopy(data)"
GRID = CUBE + """
grid = self.GetUnstructuredGridOutput()
grid.SetPoints(points)
grid.GetPointData().ShallowCopy(data.GetPointData())
"""


def read(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)


def picture(view, size=SIZE):
    """RGB of the view, shape (height, width, 3), first row at the bottom."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "view.png")
        simple.SaveScreenshot(name, view, ImageResolution=size)
        return read(name)


def programmable(script, output="vtkPolyData"):
    return simple.ProgrammableSource(OutputDataSetType=output, Script=script)


def differing(a, b):
    return (abs(a - b).max(axis=2) > 2).mean()


class Representation(unittest.TestCase):
    def setUp(self):
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = SIZE
        self.view.UseFXAA = 0
        self.view.OrientationAxesVisibility = 0
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = (0, 0, 0)

    def tearDown(self):
        simple.Delete(self.view)

    def show(self, particles):
        display = simple.Show(particles, self.view)
        display.SetRepresentationType(TYPE)
        self.view.CameraPosition = (8, 7, 11)
        self.view.CameraFocalPoint = (1.5, 1.5, 1.5)
        self.view.CameraViewUp = (0, 1, 0)
        return display

    def covered(self):
        return (picture(self.view).max(axis=2) > 0).mean()

    def test_defaults_and_counters(self):
        display = self.show(programmable(POLY_DATA))
        self.assertEqual(display.RadiusArray, "(automatic)")
        self.assertEqual(display.ShadingMode, "Direct Light and Ambient Occlusion")
        self.assertEqual(display.OcclusionOnDiffuse, 1)
        self.assertEqual(display.Shadows, 0)
        self.assertGreater(self.covered(), 0.1)
        display.SMProxy.UpdatePropertyInformation()
        counter = lambda name: display.SMProxy.GetProperty(name).GetElement(0)
        self.assertEqual(counter("NumberOfSpheres"), 64)
        self.assertGreater(counter("NumberOfRays"), 1000)

    def test_bounds_include_radii(self):
        particles = programmable("""
points = vtk.vtkPoints()
points.InsertNextPoint(0, 0, 0)
radii = vtk.vtkFloatArray()
radii.SetName("radius")
radii.InsertNextValue(5)
self.GetPolyDataOutput().SetPoints(points)
self.GetPolyDataOutput().GetPointData().AddArray(radii)
""")
        self.show(particles)
        simple.ResetCamera(self.view)
        image = picture(self.view)
        self.assertEqual(image[0].max(), 0, "the sphere does not touch the window's edge")
        self.assertGreater((image.max(axis=2) > 0).mean(), 0.15)

    def test_radius_parameters(self):
        display = self.show(programmable(POLY_DATA))
        whole = self.covered()
        display.RadiusScale = 0.5
        half = self.covered()
        self.assertLess(half, 0.8 * whole)
        display.RadiusScale = 1
        display.RadiusArray = "(none)"
        display.ConstantRadius = 0.225
        self.assertAlmostEqual(self.covered(), half, delta=0.001)
        display.ConstantRadius = 0  # half the spacing of 1
        self.assertGreater(self.covered(), whole)

    def test_grids_and_blocks_look_the_same(self):
        self.show(programmable(POLY_DATA))
        expected = picture(self.view)
        self.assertGreater(expected.max(), 100)
        others = {"grid": lambda: programmable(GRID, "vtkUnstructuredGrid"),
                  "blocks": lambda: simple.GroupDatasets(Input=[programmable(POLY_DATA)])}
        for name, make in others.items():
            with self.subTest(name):
                simple.HideAll(self.view)
                self.show(make())
                self.assertLess(differing(picture(self.view), expected), 0.001)

    def test_colours_come_from_the_lookup_table(self):
        display = self.show(programmable(POLY_DATA))
        display.Ambient, display.Diffuse = 1, 0
        simple.ColorBy(display, ("POINTS", "value"))
        table = simple.GetColorTransferFunction("value")
        table.RGBPoints = [0, 1, 0, 0, 31.4, 1, 0, 0, 31.6, 0, 0, 1, 63, 0, 0, 1]
        seen = {tuple(c) for c in picture(self.view).reshape(-1, 3)}
        self.assertEqual(seen, {(0, 0, 0), (255, 0, 0), (0, 0, 255)})

    def test_large_screenshot_is_the_same_view(self):
        display = self.show(programmable(POLY_DATA))
        display.Shadows = 1
        small = picture(self.view)
        large = picture(self.view, (4 * SIZE[0] * 3, 4 * SIZE[1] * 3))  # larger than the screen: tiles
        # Every 12 x 12 block's middle is half a pixel away from the small pixel's centre.
        middle = large[6::12, 6::12]
        self.assertEqual(middle.shape, small.shape)
        self.assertLess((abs(middle - small).max(axis=2) > 12).mean(), 0.03)

    def test_baked_occlusion_darkens(self):
        particles = programmable(POLY_DATA)
        display = self.show(particles)
        plain = picture(self.view)
        simple.Hide(particles, self.view)
        baked = simple.SphereAmbientOcclusion(Input=particles, TextureResolution=8, SamplesPerTexel=16)
        display = self.show(baked)
        both = picture(self.view)
        self.assertLess(both.mean(), 0.9 * plain.mean())
        display.ShadingMode = "Direct Light"
        self.assertLess(differing(picture(self.view), plain), 0.001)
        display.ShadingMode = "Ambient Occlusion"
        self.assertGreater(differing(picture(self.view), both), 0.1)

        with self.subTest("blocks keep their textures"):
            display.ShadingMode = "Direct Light and Ambient Occlusion"
            simple.Hide(baked, self.view)
            group = simple.GroupDatasets(Input=[baked, simple.Transform(Input=baked, Transform="Transform")])
            self.show(group)
            self.assertLess(differing(picture(self.view), both), 0.001)

    def test_occluders_darken_and_are_not_shown(self):
        particles = programmable(POLY_DATA)
        baked = simple.SphereAmbientOcclusion(Input=particles, TextureResolution=4, SamplesPerTexel=16)
        self.assertEqual(baked.SMProxy.GetProperty("Occluders").GetXMLLabel(), "Occluders")

        def mean():
            """Mean visibility; the result has the particles alone."""
            baked.UpdatePipeline()
            self.assertEqual(baked.GetDataInformation().GetNumberOfPoints(), 64)
            return vtk_to_numpy(
                simple.servermanager.Fetch(baked).GetPointData().GetArray("AmbientOcclusion")).mean()

        def method():
            baked.UpdatePropertyInformation()
            return baked.GetPropertyValue("MethodUsed")

        alone = mean()
        self.assertEqual(method(), "Sweep")
        ground = simple.Plane(Origin=[-9, -9, -0.6], Point1=[12, -9, -0.6], Point2=[-9, 12, -0.6])
        baked.Occluders = ground
        self.assertLess(mean(), 0.8 * alone)
        self.assertEqual(method(), "Embree")
        baked.Occluders = simple.GroupDatasets(Input=[ground, simple.Sphere(Center=[1.5, 1.5, 9], Radius=5)])
        self.assertLess(mean(), 0.7 * alone)

        baked.Occluders = None
        self.assertEqual(mean(), alone)

    def test_occluders_are_kept_in_a_state(self):
        simple.SphereAmbientOcclusion(Input=programmable(POLY_DATA), Occluders=simple.Plane())
        known = set(simple.GetSources())
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "state.pvsm")
            simple.SaveState(name)
            simple.LoadState(name)
        restored = [source for key, source in simple.GetSources().items() if key not in known]
        views = [view for view in simple.GetRenderViews() if view != self.view]
        occluders = [source.Occluders.GetXMLName() for source in restored
                     if source.GetXMLName() == "SphereAmbientOcclusion" and source.Occluders]
        self.assertIn("PlaneSource", occluders)
        for view in views:
            simple.Delete(view)

    def test_selection_finds_the_particle(self):
        self.show(programmable(POLY_DATA))
        simple.Render(self.view)
        simple.SelectSurfacePoints(Rectangle=[118, 88, 122, 92], View=self.view)
        selection = simple.GetActiveSource().GetSelectionInput(0)
        ids = list(selection.Input[0].IDs)[1::2]
        self.assertTrue(ids)
        self.assertGreaterEqual(min(ids), 0)
        self.assertLess(max(ids), 64)

    def test_state_is_restored(self):
        display = self.show(programmable(POLY_DATA))
        display.RadiusScale = 0.8
        display.Shadows = 1
        expected = picture(self.view)
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "state.pvsm")
            simple.SaveState(name)
            simple.LoadState(name)
            view = next(v for v in simple.GetRenderViews() if v != self.view)
            view.UseFXAA = 0  # ParaView 5.11 does not restore it
            self.assertLess(differing(picture(view), expected), 0.001)
            display = next(r for r in view.Representations if hasattr(r, "RadiusScale"))
            self.assertEqual(display.Representation, TYPE)
            self.assertEqual(display.RadiusScale, 0.8)
            simple.Delete(view)


if __name__ == "__main__":
    plugin = sys.argv.pop(1) if len(sys.argv) > 1 else os.environ["PARTICLEOCCLUSION_PLUGIN"]
    simple.LoadPlugin(plugin, ns=vars(simple))
    unittest.main()
