# SPDX-License-Identifier: BSD-3-Clause
"""The view with silhouettes and the image filter in pvpython.

The plugin's path is the argument or the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import sys
import tempfile
import unittest

import numpy
from paraview import servermanager
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = (300, 240)
COLOR = (255, 0, 255)  # nothing else in the pictures has it


def picture(view, size=SIZE, **options):
    """RGB(A) of the view as bytes, shape (height, width, channels), first row at the bottom."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "view.png")
        simple.SaveScreenshot(name, view, ImageResolution=size, **options)
        reader = vtkPNGReader()
        reader.SetFileName(name)
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).copy()


def lines(image):
    return (image[:, :, :3] == COLOR).all(axis=2)


def widened(mask):
    """The mask and its eight neighbours."""
    padded = numpy.pad(mask, 1)
    height, width = mask.shape
    shifts = [padded[j:j + height, i:i + width] for j in range(3) for i in range(3)]
    return numpy.logical_or.reduce(shifts)


def plain_view(view):
    view.ViewSize = SIZE
    view.UseFXAA = 0
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = (0.0, 1.0, 0.0)
    return view


def aim_camera(view):
    simple.ResetCamera(view)
    view.GetActiveCamera().Azimuth(30)
    view.GetActiveCamera().Elevation(20)


class SilhouetteView(unittest.TestCase):
    def setUp(self):
        self.view = simple.CreateView("RenderViewWithSilhouettes")
        self.view.ViewSize = SIZE
        self.view.UseFXAA = 0
        self.view.OrientationAxesVisibility = 0
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = (0.0, 1.0, 0.0)
        self.view.SilhouetteSamples = 1  # lines of whole pixels
        self.view.SilhouetteColor = [channel / 255 for channel in COLOR]
        self.sphere = simple.Sphere(ThetaResolution=128, PhiResolution=128)
        simple.Show(self.sphere, self.view)
        simple.ResetCamera(self.view)

    def tearDown(self):
        simple.Delete(self.view)
        simple.Delete(self.sphere)

    def geometry(self, **options):
        """Pixels that are not background, seen without lines."""
        self.view.SilhouetteVisibility = 0
        image = picture(self.view, **options)
        self.view.SilhouetteVisibility = 1
        self.assertFalse(lines(image).any())
        return (image[:, :, :3] != (0, 255, 0)).any(axis=2)

    def test_outline_surrounds_the_sphere(self):
        for parallel in (0, 1):
            self.view.CameraParallelProjection = parallel
            inside = self.geometry()
            self.assertGreater(inside.sum(), 1000)
            outline = lines(picture(self.view))
            numpy.testing.assert_array_equal(outline, widened(inside) & ~inside)

    def test_line_before_another_object(self):
        plane = simple.Plane(Origin=(-2, -2, -3), Point1=(2, -2, -3), Point2=(-2, 2, -3))
        simple.Show(plane, self.view)
        found = lines(picture(self.view))
        simple.Delete(plane)
        inside = self.geometry()
        ring = widened(inside) & ~inside
        # Where the outline touches the sphere by a corner only, the jump counts once, not 3 times.
        self.assertFalse((found & inside).any())
        self.assertGreater((found & ring).sum(), 0.9 * ring.sum())

    def test_threshold_and_background(self):
        self.view.SilhouetteBackgroundDepth = 10.0
        self.view.SilhouetteThreshold = 1.0
        self.assertTrue(lines(picture(self.view)).any())
        self.view.SilhouetteThreshold = 1000.0
        self.assertFalse(lines(picture(self.view)).any())

    def test_large_and_transparent_screenshots(self):
        image = picture(self.view, size=(620, 480), TransparentBackground=1)
        self.assertEqual(image.shape, (480, 620, 4))
        opaque = image[:, :, 3] == 255
        self.assertTrue(opaque[lines(image)].all())
        self.assertTrue((image[~opaque][:, 3] == 0).all())
        inside = opaque & ~lines(image)
        numpy.testing.assert_array_equal(lines(image), widened(inside) & ~inside)

    def test_lines_of_chosen_representations(self):
        other = simple.Sphere(Center=(1.5, 0, 0), ThetaResolution=64, PhiResolution=64)
        shown = simple.Show(other, self.view)
        simple.ResetCamera(self.view)
        both = lines(picture(self.view))
        middle = SIZE[0] // 2
        self.assertGreater(both[:, :middle].sum(), 200)
        self.assertGreater(both[:, middle:].sum(), 200)
        for opacity in (1, 0.5):  # translucent ones have lines when they are chosen
            shown.Opacity = opacity
            self.view.SilhouetteRepresentations = [shown]
            chosen = lines(picture(self.view))
            self.assertFalse(chosen[:, :middle - 5].any())
            numpy.testing.assert_array_equal(chosen[:, middle + 5:], both[:, middle + 5:])
        shown.Visibility = 0
        self.assertFalse(lines(picture(self.view)).any())
        self.view.SilhouetteRepresentations = []
        self.assertTrue(lines(picture(self.view)).any())
        simple.Delete(other)

    def test_selection_sees_the_props(self):
        simple.Render(self.view)
        simple.SelectSurfaceCells(Rectangle=[140, 110, 160, 130], View=self.view)
        self.assertIsNotNone(self.sphere.SMProxy.GetSelectionInput(0))
        simple.ClearSelection()


class LinesOfARepresentation(unittest.TestCase):
    """Lines in ParaView's plain render view."""

    def setUp(self):
        self.view = plain_view(simple.CreateRenderView())
        self.source = simple.ConvertToPointCloud(Input=simple.Wavelet(WholeExtent=[0, 6, 0, 6, 0, 6]))
        self.display = simple.Show(self.source, self.view)
        self.display.SetRepresentationType("Ray-Traced Spheres")
        self.display.RadiusArray = "(none)"
        self.display.ConstantRadius = 0.4
        self.display.SilhouetteColor = [channel / 255 for channel in COLOR]
        self.display.SilhouetteSamples = 1
        aim_camera(self.view)

    def tearDown(self):
        simple.Delete(self.view)
        simple.Delete(self.source)

    def test_switch(self):
        self.assertFalse(lines(picture(self.view)).any())
        self.display.SilhouetteVisibility = 1
        found = lines(picture(self.view)).sum()
        self.assertGreater(found, 500)
        self.display.SilhouetteLineDensity = 1
        self.assertGreater(lines(picture(self.view)).sum(), found)
        self.display.SilhouetteLineDensity = 0
        self.assertFalse(lines(picture(self.view)).any())
        self.display.SilhouetteLineDensity = 0.5
        self.display.Visibility = 0
        self.assertFalse(lines(picture(self.view)).any())

    def test_agrees_with_the_special_view(self):
        special = plain_view(simple.CreateView("RenderViewWithSilhouettes"))
        special.SilhouetteColor = [channel / 255 for channel in COLOR]
        display = simple.Show(self.source, special)
        display.SetRepresentationType("Ray-Traced Spheres")
        display.RadiusArray = "(none)"
        display.ConstantRadius = 0.4
        aim_camera(special)
        self.display.SilhouetteVisibility = 1
        special.SilhouetteSamples = 1
        here, there = lines(picture(self.view)), lines(picture(special))
        self.assertGreater(here.sum(), 500)
        self.assertLess((here != there).sum(), 0.01 * here.sum())
        simple.Delete(special)

    def test_chained_with_tone_mapping_and_selection(self):
        self.display.SilhouetteVisibility = 1
        plain = lines(picture(self.view))
        self.view.UseToneMapping = 1
        toned = picture(self.view)
        self.display.SilhouetteVisibility = 0
        without = picture(self.view)
        changed = (toned != without).any(axis=2)
        self.assertGreater((changed & plain).sum(), 0.9 * plain.sum())
        self.assertLess((changed & ~plain).sum(), 0.02 * plain.sum())
        self.view.UseToneMapping = 0
        self.display.SilhouetteVisibility = 1
        simple.SelectSurfacePoints(Rectangle=[100, 80, 200, 160], View=self.view)
        self.assertIsNotNone(self.display.SMProxy.GetRepresentedDataInformation())
        simple.ClearSelection()

    def test_beside_translucent_things(self):
        self.display.SilhouetteVisibility = 1
        alone = lines(picture(self.view))
        self.assertGreater(alone.sum(), 500)
        plane = simple.Plane(Origin=(-40, -40, -20), Point1=(40, -40, -20), Point2=(-40, 40, -20))
        shown = simple.Show(plane, self.view)
        shown.Opacity = 0.5
        numpy.testing.assert_array_equal(lines(picture(self.view)), alone)
        simple.Delete(plane)

    def test_large_screenshot(self):
        self.display.SilhouetteVisibility = 1
        large = lines(picture(self.view, size=(600, 480)))
        self.view.ViewSize = (600, 480)
        whole = lines(picture(self.view, size=(600, 480)))
        self.assertGreater(whole.sum(), 1000)
        self.assertLess((large != whole).sum(), 0.01 * whole.sum())


class SpecialViewChains(unittest.TestCase):
    def test_tone_mapping_keeps_the_lines(self):
        view = simple.CreateView("RenderViewWithSilhouettes")
        view.ViewSize = SIZE
        view.UseFXAA = 0
        view.OrientationAxesVisibility = 0
        view.SilhouetteSamples = 1
        view.SilhouetteColor = [channel / 255 for channel in COLOR]
        sphere = simple.Sphere(ThetaResolution=64, PhiResolution=64)
        simple.Show(sphere, view)
        simple.ResetCamera(view)
        plain = lines(picture(view))
        self.assertGreater(plain.sum(), 300)
        view.UseToneMapping = 1
        toned = picture(view)
        view.SilhouetteVisibility = 0
        changed = (toned != picture(view)).any(axis=2)
        self.assertGreater((changed & plain).sum(), 0.9 * plain.sum())
        simple.Delete(view)
        simple.Delete(sphere)


class DepthSilhouettes(unittest.TestCase):
    def test_step_of_an_image(self):
        source = simple.ProgrammableSource(OutputDataSetType="vtkImageData")
        source.ScriptRequestInformation = """
self.GetOutputInformation(0).Set(self.GetExecutive().WHOLE_EXTENT(), 0, 9, 0, 7, 0, 0)
"""
        source.Script = """
import numpy
output.SetDimensions(10, 8, 1)
depth = numpy.ones((8, 10))
depth[:, 6:] = 2.0
output.PointData.append(depth.ravel(), "distance")
"""
        marked = simple.DepthSilhouettes(Input=source, DepthArray=["POINTS", "distance"])
        image = servermanager.Fetch(marked)
        strength = vtk_to_numpy(image.GetPointData().GetArray("Silhouette")).reshape(8, 10)
        expected = numpy.zeros((8, 10))
        expected[:, 6] = 1.0
        numpy.testing.assert_array_equal(strength, expected)


if __name__ == "__main__":
    plugin = sys.argv.pop(1) if len(sys.argv) > 1 else os.environ["PARTICLEOCCLUSION_PLUGIN"]
    simple.LoadPlugin(plugin, ns=vars(simple))
    unittest.main()
