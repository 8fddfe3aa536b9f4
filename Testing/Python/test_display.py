# SPDX-License-Identifier: BSD-3-Clause
"""What a user does with ray-traced spheres in a view: colour, light, make translucent, smooth, drag, select.

The plugin's path is the argument or the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import sys
import unittest

import numpy
from paraview import simple

import test_representation
from test_representation import SIZE, differing, picture, programmable

# With cells, which Threshold and Clip work on.
POLY_DATA = test_representation.CUBE + """
vertices = vtk.vtkCellArray()
for i in range(64):
    vertices.InsertNextCell(1, [i])
data.SetVerts(vertices)
self.GetPolyDataOutput().ShallowCopy(data)
"""
VECTORS = POLY_DATA.replace("self.", """
vectors = vtk.vtkFloatArray()
vectors.SetName("vector")
vectors.SetNumberOfComponents(3)
kinds = vtk.vtkIntArray()
kinds.SetName("kind")
for i in range(64):
    vectors.InsertNextTuple3(3.0 * (i // 32), 4.0 * (i // 32), float("nan") if i == 63 else 0)
    kinds.InsertNextValue(i // 32)
data.GetPointData().AddArray(vectors)
data.GetPointData().AddArray(kinds)
self.""")


class Display(unittest.TestCase):
    """A cube of 4 x 4 x 4 spheres; x = i // 16, "value" = i."""

    setUp = test_representation.Representation.setUp
    tearDown = test_representation.Representation.tearDown
    show = test_representation.Representation.show
    covered = test_representation.Representation.covered

    def counter(self, display, name):
        display.SMProxy.UpdatePropertyInformation()
        return display.SMProxy.GetProperty(name).GetElement(0)

    def flat(self, display):
        display.Ambient, display.Diffuse = 1, 0

    def colours(self):
        return {tuple(int(v) for v in c) for c in picture(self.view).reshape(-1, 3)} - {(0, 0, 0)}

    # Colour

    def table(self, name, **properties):
        table = simple.GetColorTransferFunction(name)
        for key, value in properties.items():
            setattr(table, key, value)
        return table

    def test_components_magnitudes_nan_and_log(self):
        display = self.show(programmable(VECTORS))
        self.flat(display)
        simple.ColorBy(display, ("POINTS", "vector", "Magnitude"))
        steps = [0, 1, 0, 0, 4.9, 1, 0, 0, 4.91, 0, 0, 1, 6, 0, 0, 1]
        table = self.table("vector", RGBPoints=steps, NanColor=[0, 1, 0])
        self.assertEqual(self.colours(), {(255, 0, 0), (0, 0, 255), (0, 255, 0)})
        simple.ColorBy(display, ("POINTS", "vector", "X"))
        simple.GetColorTransferFunction("vector").RGBPoints = steps
        self.assertEqual(self.colours(), {(255, 0, 0)}, "3 is below 4.9")
        simple.ColorBy(display, ("POINTS", "value"))
        table = self.table("value", RGBPoints=[1, 0, 0, 0, 100, 1, 1, 1], ColorSpace="RGB")
        linear = picture(self.view)
        self.addCleanup(setattr, table, "UseLogScale", 0)  # other tests use the table
        table.MapControlPointsToLogSpace()
        table.UseLogScale = 1
        logarithmic = picture(self.view)
        values = numpy.round(1 + linear[:, :, 0] / 255 * 99)  # that particles have; 1 and below are black, as is nothing
        self.assertEqual(len(numpy.unique(values)), len(self.colours()) + 1)
        expected = 255 * numpy.log10(values) / 2
        self.assertLess(numpy.abs(logarithmic[:, :, 0] - expected).max(), 2)

    def test_categories_solid_colour_and_scalar_bar(self):
        display = self.show(programmable(VECTORS))
        self.flat(display)
        simple.ColorBy(display, ("POINTS", "kind"))
        self.table("kind", InterpretValuesAsCategories=1, Annotations=["0", "a", "1", "b"],
                   IndexedColors=[1, 0, 0, 0, 1, 0])
        self.assertEqual(self.colours(), {(255, 0, 0), (0, 255, 0)})
        display.SetScalarBarVisibility(self.view, True)
        self.assertGreater(len(self.colours()), 2, "the bar has labels")
        display.SetScalarBarVisibility(self.view, False)
        simple.ColorBy(display, None)
        display.AmbientColor = display.DiffuseColor = [0, 0, 1]
        self.assertEqual(self.colours(), {(0, 0, 255)})

    def test_a_colour_map_its_range_a_light_or_silhouettes_trace_nothing(self):
        display = self.show(programmable(POLY_DATA))
        simple.ColorBy(display, ("POINTS", "value"))
        simple.Render(self.view)
        frames = lambda: self.counter(display, "NumberOfTracedFrames")
        before = frames()
        table = simple.GetColorTransferFunction("value")
        table.RescaleTransferFunction(0, 200)
        simple.Render(self.view)
        table.ApplyPreset("Viridis (matplotlib)", True)
        simple.Render(self.view)
        display.Specular = 0.4
        simple.AddLight(view=self.view)
        simple.Render(self.view)
        display.SilhouetteVisibility, display.SilhouetteThreshold = 1, 2
        simple.Render(self.view)
        display.SilhouetteColor = [1, 0, 0]
        simple.Render(self.view)
        self.assertEqual(frames(), before)
        display.CropArray, display.CropRange = ["POINTS", "value"], [0, 30]
        simple.Render(self.view)
        self.assertEqual(frames(), before + 1)

    def test_another_view_of_another_size_traces_nothing_here(self):
        source = programmable(POLY_DATA)
        display = self.show(source)
        other = simple.CreateRenderView(ViewSize=[100, 80])
        self.addCleanup(simple.Delete, other)
        simple.Show(source, other).SetRepresentationType("Ray-Traced Spheres")
        views = (self.view, other)
        for view in views:
            simple.Render(view)
        before = self.counter(display, "NumberOfTracedFrames")
        other.ViewSize = [160, 120]
        for view in views:
            simple.Render(view)
        self.assertEqual(self.counter(display, "NumberOfTracedFrames"), before)
        self.view.ViewSize = [self.view.ViewSize[0] + 10, self.view.ViewSize[1]]
        simple.Render(self.view)
        self.assertEqual(self.counter(display, "NumberOfTracedFrames"), before + 1)

    def test_blocks_of_collections_have_looks_of_their_own(self):
        parts = [programmable(POLY_DATA), simple.Transform(Input=programmable(POLY_DATA), Transform="Transform")]
        parts[1].Transform.Translate = [-5, 0, 0]
        for output in ("vtkMultiBlockDataSet", "vtkPartitionedDataSetCollection"):
            with self.subTest(output):
                group = simple.GroupDatasets(Input=parts)
                group.OutputType = output
                group.BlockNames = ["first", "second"]
                display = self.show(group)
                self.flat(display)
                display.ColorArrayName = [None, ""]
                display.AmbientColor = display.DiffuseColor = [1, 0, 0]
                self.assertEqual(self.colours(), {(255, 0, 0)})
                display.BlockColors = ["/Root/second", "0", "0", "1"]
                self.assertEqual(self.colours(), {(255, 0, 0), (0, 0, 255)})
                display.BlockSelectors = ["/Root/second"]
                self.assertEqual(self.colours(), {(0, 0, 255)})
                self.assertEqual(self.counter(display, "NumberOfShownSpheres"), 64)
                display.BlockSelectors = ["/"]
                display.BlockColors = []
                self.assertEqual(self.colours(), {(255, 0, 0)})
                simple.Hide(group, self.view)

    # Light

    def test_all_lights_of_the_view_count(self):
        display = self.show(programmable(POLY_DATA))
        self.view.UseLight = 0
        simple.Render(self.view)
        colours = self.colours()
        self.assertEqual(len(colours), 1, "without any light colours are flat, as VTK has it")
        seen = {}
        for kind in ("Scene", "Headlight", "Camera"):
            light = simple.AddLight(view=self.view)
            light.Coords, light.DiffuseColor, light.Intensity = kind, [1, 0, 0], 1
            light.Type = "Directional" if kind != "Scene" else "Positional"
            light.Position, light.FocalPoint = [9, 9, 9] if kind == "Scene" else [0, 1, 1], [0, 0, 0]
            image = picture(self.view)
            seen[kind] = image
            self.assertGreater(image[:, :, 0].mean(), 5, kind)
            self.assertEqual(image[:, :, 1:].max(), 0, kind)
            light.Enable = 0
            self.assertEqual(self.colours(), colours, kind)
            simple.RemoveLight(light)
        self.assertGreater(differing(seen["Scene"], seen["Headlight"]), 0.05)
        self.assertGreater(differing(seen["Camera"], seen["Headlight"]), 0.05)
        del display

    # Translucency

    def test_opacity_shows_what_is_behind(self):
        display = self.show(programmable(POLY_DATA))
        self.flat(display)
        simple.ColorBy(display, ("POINTS", "value"))
        table = self.table("value", RGBPoints=[0, 1, 0, 0, 63, 0, 0, 1], ColorSpace="RGB")
        opaque = self.colours()
        display.Opacity = 0.5
        self.assertGreater(len(self.colours()), 3 * len(opaque), "colours mix")
        display.Opacity = 1
        self.assertEqual(self.colours(), opaque)
        self.addCleanup(setattr, table, "EnableOpacityMapping", 0)  # other tests use the table
        table.EnableOpacityMapping = 1
        simple.GetOpacityTransferFunction("value").Points = [0, 0, 0.5, 0, 31.9, 0, 0.5, 0, 32, 1, 0.5, 0, 63, 1, 0.5, 0]
        picture(self.view)
        self.assertEqual(self.counter(display, "NumberOfShownSpheres"), 32, "those of opacity 0 are not there")

    # Smooth edges and interaction

    def test_screenshots_are_smooth_at_once_and_views_step_by_step(self):
        display = self.show(programmable(POLY_DATA))
        self.flat(display)
        self.assertEqual(self.colours(), {(255, 255, 255)})
        display.SamplesPerPixel = 8
        self.assertGreater(len(self.colours()), 4)
        self.assertEqual(self.counter(display, "NumberOfSamples"), 8)
        simple.ColorBy(display, ("POINTS", "value"))
        simple.Render(self.view)
        self.view.CameraPosition = (8, 7, 11.5)
        for count in (1, 2, 3):
            simple.Render(self.view)
            self.assertEqual(self.counter(display, "NumberOfSamples"), count)

    def test_dragging_is_coarse_and_still_pictures_are_full(self):
        display = self.show(programmable(POLY_DATA))
        simple.Render(self.view)
        rays = lambda: self.counter(display, "NumberOfRays")
        full = rays()
        display.InteractiveRate = 120
        for i in range(3):
            self.view.CameraPosition = (8, 7, 11 + i)
            display.SMProxy.GetProperty("InteractiveRate").SetElement(0, 1000)
            display.SMProxy.UpdateVTKObjects()
            self.view.SMProxy.InteractiveRender()
        self.assertLess(rays(), full / 2)
        simple.Render(self.view)
        self.view.CameraPosition = (8, 7, 11)
        simple.Render(self.view)
        self.assertEqual(rays(), full)

    # Selection

    def selected(self, source):
        """(composite index, id) of the selected points."""
        selection = source.GetSelectionInput(source.Port)
        if selection is None:
            return []
        nodes = selection.Input if hasattr(selection.Input, "__len__") else [selection.Input]
        found = []
        for node in nodes:
            ids = list(node.IDs)
            if "Composite" in node.GetXMLName():
                found += [(ids[i], ids[i + 2]) for i in range(0, len(ids), 3)]
            else:
                found += [(0, i) for i in ids[1::2]]
        return found

    def pixel_of(self, point):
        renderer = self.view.GetRenderer()
        renderer.SetWorldPoint(*point, 1)
        renderer.WorldToDisplay()
        return [int(c) for c in renderer.GetDisplayPoint()[:2]]

    def test_a_click_selects_the_sphere_and_links_to_the_spreadsheet(self):
        source = programmable(POLY_DATA)
        display = self.show(source)
        display.SamplesPerPixel = 4
        simple.Render(self.view)
        corner = self.pixel_of((3, 3, 3.3))  # the front corner of the cube: particle 63
        simple.SetActiveSource(source)
        simple.SelectSurfacePoints(Rectangle=corner * 2, View=self.view)
        self.assertEqual(self.selected(source), [(0, 63)])
        extracted = simple.ExtractSelection(Input=source, Selection=source.GetSelectionInput(0))
        values = simple.servermanager.Fetch(extracted).GetPointData().GetArray("value")
        self.assertEqual([values.GetValue(i) for i in range(values.GetNumberOfTuples())], [63])
        # The hidden are not selected; what they hid is.
        display.CropArray, display.CropRange = ["POINTS", "value"], [0, 62]
        simple.Render(self.view)
        simple.ClearSelection(source)
        simple.SelectSurfacePoints(Rectangle=corner * 2, View=self.view)
        self.assertNotIn((0, 63), self.selected(source))

    def test_rectangle_and_frustum(self):
        source = programmable(POLY_DATA)
        self.show(source)
        simple.Render(self.view)
        simple.SetActiveSource(source)
        simple.SelectSurfacePoints(Rectangle=[0, 0, SIZE[0] - 1, SIZE[1] - 1], View=self.view)
        surface = {i for _, i in self.selected(source)}
        outside = {i for i in range(64) if {i // 16, i // 4 % 4, i % 4} & {3}}
        self.assertLessEqual({63, 60, 51, 15}, surface)
        self.assertGreaterEqual(len(surface), len(outside) - 2)
        simple.ClearSelection(source)
        simple.SelectPointsThrough(Rectangle=[0, 0, SIZE[0] - 1, SIZE[1] - 1], View=self.view)
        extracted = simple.ExtractSelection(Input=source, Selection=source.GetSelectionInput(0))
        self.assertEqual(simple.servermanager.Fetch(extracted).GetNumberOfPoints(), 64)

    def test_blocks_are_selected_by_their_index(self):
        group = simple.GroupDatasets(Input=[programmable(POLY_DATA), simple.Transform(
            Input=programmable(POLY_DATA), Transform="Transform")])
        group.Input[1].Transform.Translate = [-5, 0, 0]
        self.show(group)
        simple.Render(self.view)
        simple.SetActiveSource(group)
        for block, x in ((1, 3), (2, -2)):
            with self.subTest(block):
                simple.ClearSelection(group)
                simple.SelectSurfacePoints(Rectangle=self.pixel_of((x, 3, 3.3)) * 2, View=self.view)
                self.assertEqual(self.selected(group), [(block, 63)])


if __name__ == "__main__":
    plugin = sys.argv.pop(1) if len(sys.argv) > 1 else os.environ["PARTICLEOCCLUSION_PLUGIN"]
    simple.LoadPlugin(plugin, ns=vars(simple))
    unittest.main()
