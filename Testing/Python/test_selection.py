# SPDX-License-Identifier: BSD-3-Clause
"""What is under the mouse, and what is selected: ParaView's tooltip pipeline, which shows the particle that the
pointer rests on, and the spreadsheet, which lists those that are selected in the view."""
import os
import re
import sys
import unittest

import numpy
from paraview import servermanager
from paraview import simple
from paraview.modules.vtkRemotingMisc import vtkSMTooltipSelectionPipeline
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import reference, vtkCollection

PLUGIN = os.environ["PARTICLEOCCLUSION_PLUGIN"]
DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")
SIZE = [500, 200]
PICKING_RADIUS = 50  # of a square around the pointer in which ParaView looks for a particle, on background


class Selection(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        simple.LoadPlugin(PLUGIN, ns=vars(simple))
        particles = simple.OpenDataFile(os.path.join(DATA, "molecule.vtp"))
        cls.baked = simple.SphereAmbientOcclusion(Input=particles, TextureResolution=4, SamplesPerTexel=4)
        cls.view = simple.CreateView("RenderView")
        cls.view.ViewSize = SIZE
        cls.view.CameraParallelProjection = 1
        cls.display = simple.Show(cls.baked, cls.view)
        cls.display.SilhouetteVisibility = 1
        simple.ResetCamera(cls.view)
        simple.Render(cls.view)
        data = servermanager.Fetch(cls.baked)
        cls.centers = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        cls.radii = vtk_to_numpy(data.GetPointData().GetArray("radius")).astype(float)

    def nearest(self, pixel, shown=None):
        """The particle whose sphere a ray along -z through the pixel's centre meets first, None if it meets none, and
        how many pixels it is away from where that changes."""
        pixel_size = 2 * self.view.CameraParallelScale / SIZE[1]
        x, y = (self.view.CameraFocalPoint[axis] + (pixel[axis] + 0.5 - SIZE[axis] / 2) * pixel_size
                for axis in (0, 1))
        across = numpy.hypot(self.centers[:, 0] - x, self.centers[:, 1] - y)
        shown = numpy.ones(len(self.radii), bool) if shown is None else shown
        to_rim = numpy.abs(across - self.radii) / pixel_size
        inside = shown & (across < self.radii)
        if not inside.any():
            return None, to_rim[shown].min()
        z = self.centers[:, 2] + numpy.sqrt(numpy.maximum(self.radii ** 2 - across ** 2, 0))
        z[~inside] = -numpy.inf
        first = int(z.argmax())
        ahead = (z[first] - numpy.delete(z, first).max()) / pixel_size  # of the next one that it interpenetrates
        in_front = shown & (self.centers[:, 2] > z[first])  # what a rim of these covers is theirs
        in_front[first] = True
        return first, min(ahead, to_rim[in_front].min())

    def tooltip(self, pixel):
        """Its text where the pointer rests on a pixel, None on background."""
        displays, selections = vtkCollection(), vtkCollection()
        region = [pixel[0], pixel[1], pixel[0], pixel[1]]
        self.view.SMProxy.SelectSurfacePoints(region, displays, selections, 0, False)
        if selections.GetNumberOfItems() == 0:
            return None
        pipeline = vtkSMTooltipSelectionPipeline.GetInstance()
        pipeline.Show(displays.GetItemAsObject(0), selections.GetItemAsObject(0), self.view.SMProxy)
        text = reference("")
        self.assertTrue(pipeline.GetTooltipInfo(0, text))
        pipeline.Hide(self.view.SMProxy)
        return str(text)

    def check_tooltips(self, shown=None):
        random = numpy.random.default_rng(5)
        pixels = [[int(random.integers(side // 3, side - side // 3)) for side in SIZE] for _ in range(120)]
        found = []
        for pixel in pixels + [[2, 2], [SIZE[0] - 3, SIZE[1] - 3]]:
            expected, margin = self.nearest(pixel, shown)
            if margin < 0.1 or (expected is None and margin < 1.5 * PICKING_RADIUS):
                continue  # too near to a rim, or to a particle
            text = self.tooltip(pixel)
            id_shown = None if text is None else int(re.search(r"Id: (\d+)", text).group(1))
            self.assertEqual(id_shown, expected, pixel)
            if text:
                self.assertIn("AmbientOcclusion", text)
            found.append(expected)
        self.assertGreater(len(set(found)), 10)
        self.assertIn(None, found)

    def test_the_tooltip_is_that_of_the_particle_under_the_pointer(self):
        self.check_tooltips()

    def crop(self):
        """Hides the half in front; returns which particles are left."""
        self.display.CropPlane = 1
        self.display.CropPlaneOrigin = list(self.centers.mean(axis=0))
        self.display.CropPlaneNormal = [0, 0, -1]
        simple.Render(self.view)
        return self.centers[:, 2] <= self.centers[:, 2].mean()

    def uncrop(self):
        self.display.CropPlane = 0
        simple.Render(self.view)

    def test_what_is_cropped_has_no_tooltip(self):
        self.check_tooltips(self.crop())
        self.uncrop()

    def test_marks_of_what_is_selected_and_cropped_cover_nothing(self):
        simple.SetActiveView(self.view)
        simple.SelectSurfacePoints(Rectangle=[0, 0, SIZE[0] - 1, SIZE[1] - 1], View=self.view)
        selected = list(self.baked.GetSelectionInput(0).Input[0].IDs)[1::2]
        shown = self.crop()
        self.assertGreater((~shown[selected]).sum(), 500, "they are marked in front of what is shown")
        self.check_tooltips(shown)
        simple.ClearSelection(self.baked)
        self.uncrop()

    def test_the_spreadsheet_lists_what_is_selected_in_the_view(self):
        sheet = simple.CreateView("SpreadSheetView")
        simple.AssignViewToLayout(view=sheet, layout=simple.CreateLayout("Sheet"))  # leaves the other view its size
        simple.Show(self.baked, sheet)
        sheet.FieldAssociation = "Point Data"
        simple.Render(sheet)
        self.assertEqual(sheet.GetClientSideObject().GetNumberOfRows(), len(self.radii))
        middle = [side // 2 for side in SIZE]
        rectangle = [middle[0] - 10, middle[1] - 10, middle[0] + 10, middle[1] + 10]
        simple.SetActiveView(self.view)
        simple.SelectSurfacePoints(Rectangle=rectangle, View=self.view)
        ids = sorted(list(self.baked.GetSelectionInput(0).Input[0].IDs)[1::2])
        seen = {self.nearest([x, y])[0] for x in range(rectangle[0], rectangle[2] + 1)
                for y in range(rectangle[1], rectangle[3] + 1)}
        self.assertLessEqual(len(seen ^ set(ids)), 2, "but for rims, where rounding decides")
        sheet.SelectionOnly = 1
        simple.Render(sheet)
        table = sheet.GetClientSideObject()
        rows = [table.GetValueByName(row, "vtkOriginalPointIds").ToInt() for row in range(table.GetNumberOfRows())]
        self.assertEqual(sorted(rows), ids)
        simple.ClearSelection(self.baked)


result = unittest.main(exit=False).result
# ParaView's tooltip pipeline outlives the window, and ends the process with an X error when it is taken down.
sys.stderr.flush()
os._exit(0 if result.wasSuccessful() else 1)
