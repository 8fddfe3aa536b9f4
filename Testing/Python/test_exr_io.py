# SPDX-License-Identifier: BSD-3-Clause
"""Saves textures and layers as OpenEXR and loads them again, as a ParaView script would."""

import os
import tempfile
import unittest

from paraview import servermanager
from paraview.simple import (
    LoadPlugin,
    ProgrammableSource,
    SaveData,
    XMLPolyDataReader,
)

# paraview.simple names proxies by their labels: LoadOcclusionTexturesEXR.
LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())

MAKE_BAKED = """
import numpy
from vtkmodules.vtkCommonCore import VTK_INT, vtkPoints, vtkStringArray
from vtkmodules.util.numpy_support import numpy_to_vtk
rng = numpy.random.default_rng(5)
def add(attributes, name, values, type=None):
    array = numpy_to_vtk(values, deep=True, array_type=type)
    array.SetName(name)
    attributes.AddArray(array)
output = self.GetPolyDataOutput()
points = vtkPoints()
points.SetData(numpy_to_vtk(rng.random((COUNT, 3)), deep=True))
output.SetPoints(points)
add(output.GetPointData(), "AmbientOcclusion", rng.random(COUNT).astype("f4"))
add(output.GetPointData(), "AmbientOcclusionTexture",
    rng.integers(0, 11, COUNT).astype("i4"), VTK_INT)
add(output.GetFieldData(), "AmbientOcclusionTextures",
    rng.integers(0, 256, (11, 64)).astype("u1"))
parameters = vtkStringArray()
parameters.SetName("AmbientOcclusionParameters")
for text in ("version=1", "resolution=8", "encoding=UInt8Gamma2", "gamma=2", "maximum=0.7"):
    parameters.InsertNextValue(text)
output.GetFieldData().AddArray(parameters)
"""

MAKE_IMAGE = """
from vtkmodules.vtkCommonCore import vtkFloatArray
image = self.GetImageDataOutput()
image.SetDimensions(4, 3, 1)
depth = vtkFloatArray()
depth.SetName("Z")
depth.SetNumberOfTuples(12)
for i in range(12):
    depth.SetValue(i, 2.5)
image.GetPointData().AddArray(depth)
"""

MAKE_IMAGE_EXTENT = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
self.GetOutputInformation(0).Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), 0, 3, 0, 2, 0, 0)
"""


def baked_source(count=30):
    source = ProgrammableSource(OutputDataSetType="vtkPolyData")
    source.Script = MAKE_BAKED.replace("COUNT", str(count))
    source.UpdatePipeline()
    return source


def values(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def strings(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


class TestExrIO(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def assert_same_bake(self, expected, found):
        for name in ("AmbientOcclusion", "AmbientOcclusionTexture"):
            self.assertEqual(
                values(expected.GetPointData().GetArray(name)),
                values(found.GetPointData().GetArray(name)),
            )
        name = "AmbientOcclusionTextures"
        table = found.GetFieldData().GetArray(name)
        self.assertEqual(table.GetDataTypeAsString(), "unsigned char")
        self.assertEqual(values(expected.GetFieldData().GetArray(name)), values(table))
        name = "AmbientOcclusionParameters"
        self.assertEqual(
            strings(expected.GetFieldData().GetAbstractArray(name)),
            strings(found.GetFieldData().GetAbstractArray(name)),
        )

    def test_textures_come_back_onto_particles_from_vtp(self):
        baked = baked_source()
        SaveData(self.file("a.exr"), proxy=baked)
        SaveData(self.file("a.vtp"), proxy=baked, DataMode="Binary")
        particles = XMLPolyDataReader(FileName=[self.file("a.vtp")])
        loaded = LoadOcclusionTexturesEXR(Input=particles, FileName=self.file("a.exr"))
        loaded.UpdatePipeline()
        self.assert_same_bake(servermanager.Fetch(baked), servermanager.Fetch(loaded))
        self.assert_same_bake(servermanager.Fetch(baked), servermanager.Fetch(particles))

    def test_other_number_of_particles_gives_no_textures(self):
        SaveData(self.file("a.exr"), proxy=baked_source(30))
        loaded = LoadOcclusionTexturesEXR(Input=baked_source(29), FileName=self.file("a.exr"))
        loaded.UpdatePipeline()
        self.assertEqual(loaded.GetDataInformation().GetNumberOfPoints(), 0)

    def test_writers_are_offered_for_their_kind_of_data(self):
        factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
        self.assertIn("Ambient Occlusion Textures", self.offered(factory, baked_source()))
        self.assertNotIn("Rendered Layers", self.offered(factory, baked_source()))
        image = self.image_source()
        self.assertIn("Rendered Layers", self.offered(factory, image))
        self.assertNotIn("Ambient Occlusion Textures", self.offered(factory, image))

    @staticmethod
    def offered(factory, source):
        return factory.GetSupportedFileTypes(source.SMProxy, 0)

    @staticmethod
    def image_source():
        source = ProgrammableSource(OutputDataSetType="vtkImageData")
        source.Script = MAKE_IMAGE
        source.ScriptRequestInformation = MAKE_IMAGE_EXTENT
        source.UpdatePipeline()
        return source

    def test_layers_are_saved(self):
        SaveData(self.file("layers.exr"), proxy=self.image_source())
        with open(self.file("layers.exr"), "rb") as stream:
            head = stream.read(400)
        self.assertTrue(head.startswith(b"\x76\x2f\x31\x01"))
        self.assertIn(b"channels\0chlist\0", head)
        self.assertIn(b"Z\0", head)
        self.assertEqual(os.listdir(self.folder.name), ["layers.exr"])

    def test_reader_is_in_the_particles_category(self):
        hints = loaded_hints("filters", "OcclusionTextureReader")
        menu = hints.FindNestedElementByName("ShowInMenu")
        self.assertEqual(menu.GetAttribute("category"), "Particles")


def loaded_hints(group, name):
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    return manager.GetPrototypeProxy(group, name).GetHints()


if __name__ == "__main__":
    unittest.main()
