# SPDX-License-Identifier: BSD-3-Clause
"""Crops of ray-traced spheres in a view: by ranges of arrays, a plane and a box, and by filters before them.

The plugin's path is the argument or the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import sys
import tempfile
import unittest

from paraview import simple

import test_display
import test_representation
from test_display import POLY_DATA, VECTORS
from test_representation import differing, picture, programmable


class Crop(unittest.TestCase):
    """A cube of 4 x 4 x 4 spheres; x = i // 16, "value" = i."""

    setUp = test_representation.Representation.setUp
    tearDown = test_representation.Representation.tearDown
    show = test_representation.Representation.show
    covered = test_representation.Representation.covered
    counter = test_display.Display.counter

    def test_crop_range_needs_no_update_of_the_pipeline(self):
        script = POLY_DATA + "\nself.GetPolyDataOutput().Modified()"
        source = programmable(script)
        display = self.show(source)
        everything = picture(self.view)
        executed = source.GetClientSideObject().GetOutputDataObject(0).GetMTime()
        display.CropArray = ["POINTS", "value"]
        self.assertEqual(differing(picture(self.view), everything), 0, "the default range holds all")
        display.CropRange = [16, 31]
        cropped = picture(self.view)
        self.assertEqual(self.counter(display, "NumberOfShownSpheres"), 16)
        self.assertEqual(source.GetClientSideObject().GetOutputDataObject(0).GetMTime(), executed)
        display.CropArray = [None, ""]
        self.assertEqual(differing(picture(self.view), everything), 0)
        simple.Hide(source, self.view)
        threshold = simple.Threshold(Input=source, Scalars=["POINTS", "value"], LowerThreshold=16, UpperThreshold=31)
        self.show(threshold)
        self.assertLess(differing(picture(self.view), cropped), 0.001)

    def test_crop_domains_are_those_of_the_data(self):
        display = self.show(programmable(POLY_DATA))
        display.CropArray = ["POINTS", "value"]
        domain = display.SMProxy.GetProperty("CropRange").GetDomain("range")
        self.assertEqual((domain.GetMinimum(0), domain.GetMaximum(0)), (0, 63))
        self.assertEqual(list(display.CropBoxOrigin), [0, 0, 0])
        self.assertEqual(list(display.CropBoxSize), [3, 3, 3])
        self.assertEqual(list(display.CropPlaneOrigin), [1.5, 1.5, 1.5])

    def test_crop_domains_follow_array_and_component_in_display_and_filter(self):
        source = programmable(VECTORS)
        baked = simple.SphereAmbientOcclusion(Input=source, TextureResolution=4, SamplesPerTexel=4)
        display = self.show(source)
        for proxy in (display, baked):
            domain = proxy.SMProxy.GetProperty("CropRange").GetDomain("range")
            limits = lambda: (domain.GetMinimum(0), domain.GetMaximum(0))
            self.assertFalse(domain.GetMinimumExists(0), "no array, no range")
            proxy.CropArray = "value"
            self.assertEqual(limits(), (0, 63))
            proxy.CropArray = "vector"
            self.assertEqual(limits(), (0, 5), "the magnitude")
            proxy.CropComponent = 1
            self.assertEqual(limits(), (0, 4))
            self.assertEqual(list(proxy.CropRange), [-1e300, 1e300], "what is cropped is up to the user")

    def test_crop_by_magnitude_component_plane_and_box(self):
        display = self.show(programmable(VECTORS))
        shown = lambda: (picture(self.view), self.counter(display, "NumberOfShownSpheres"))[1]
        display.CropArray, display.CropRange = ["POINTS", "vector"], [4.9, 5.1]
        self.assertEqual(shown(), 31, "NaN is in no range")
        display.CropArray = [None, ""]
        display.CropRanges = ["vector", "1", "3.9", "4.1", "value", "0", "0", "39"]
        self.assertEqual(shown(), 8)
        display.CropRanges = []
        display.CropPlane, display.CropPlaneOrigin, display.CropPlaneNormal = 1, [0.5, 0, 0], [-1, 0, 0]
        self.assertEqual(shown(), 16)
        display.CropBox, display.CropBoxOrigin, display.CropBoxSize = 1, [-1, -1, -1], [9, 1.5, 9]
        self.assertEqual(shown(), 4)
        display.CropPlane = 0
        self.assertEqual(shown(), 16)

    def test_upstream_crops_keep_texture_and_particle_together(self):
        """The colour of each pixel is that of the whole set wherever the same particle is seen."""
        baked = simple.SphereAmbientOcclusion(Input=programmable(POLY_DATA), TextureResolution=8, SamplesPerTexel=16)
        display = self.show(baked)
        display.ShadingMode = "Ambient Occlusion"
        display.CropArray, display.CropRange = ["POINTS", "value"], [20, 41]
        expected = picture(self.view)
        self.assertGreater(len({tuple(c) for c in expected.reshape(-1, 3)}), 50)
        simple.Hide(baked, self.view)
        simple.SetActiveSource(baked)
        simple.QuerySelect(QueryString="(value >= 20) & (value <= 41)", FieldType="POINT")
        selection = baked.GetSelectionInput(0)
        simple.ClearSelection(baked)
        clip = simple.Clip(Input=baked, ClipType="Scalar", Scalars=["POINTS", "value"], Value=19.5, Invert=0)
        filters = {
            "Threshold": simple.Threshold(Input=baked, Scalars=["POINTS", "value"], LowerThreshold=20,
                                          UpperThreshold=41),
            "Clip": simple.Clip(Input=clip, ClipType="Scalar", Scalars=["POINTS", "value"], Value=41.5, Invert=1),
            "ExtractSelection": simple.ExtractSelection(Input=baked, Selection=selection),
        }
        for name, cropped in filters.items():
            with self.subTest(name):
                display = self.show(cropped)
                display.ShadingMode = "Ambient Occlusion"
                display.ColorArrayName = [None, ""]  # not by the active scalars
                self.assertEqual(display.RadiusArray, "(automatic)")
                self.assertLess(differing(picture(self.view), expected), 0.001)
                simple.Hide(cropped, self.view)

    def test_state_keeps_what_is_cropped(self):
        display = self.show(programmable(POLY_DATA))
        display.CropArray, display.CropRange, display.Opacity = ["POINTS", "value"], [5, 40], 0.5
        display.CropPlane, display.CropPlaneOrigin = 1, [0, 0, 0.5]
        display.CropBox, display.CropBoxSize = 1, [2.5, 9, 9]
        display.SamplesPerPixel, display.InteractiveRate = 3, 20
        expected = picture(self.view)
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "state.pvsm")
            simple.SaveState(name)
            simple.LoadState(name)
        view = next(v for v in simple.GetRenderViews() if v != self.view)
        view.UseFXAA = 0
        self.assertLess(differing(picture(view), expected), 0.001)
        display = next(r for r in view.Representations if hasattr(r, "CropRange"))
        self.assertEqual(list(display.CropRange), [5, 40])
        self.assertEqual((display.CropPlane, display.CropBox, display.SamplesPerPixel, display.InteractiveRate),
                         (1, 1, 3, 20))
        simple.Delete(view)


if __name__ == "__main__":
    plugin = sys.argv.pop(1) if len(sys.argv) > 1 else os.environ["PARTICLEOCCLUSION_PLUGIN"]
    simple.LoadPlugin(plugin, ns=vars(simple))
    unittest.main()
