# SPDX-License-Identifier: BSD-3-Clause
"""Time series, states, traces, undo, several views, and memory that is given back."""
import os
import sys
import tempfile
import unittest

import images
import numpy
from paraview import servermanager, smstate, smtrace
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

PLUGIN = os.environ["PARTICLEOCCLUSION_PLUGIN"]
SIZE = [200, 150]
STEPS = 3


def write_step(path, step):
    """A cube of touching spheres that drifts apart and grows by a layer every step."""
    side = 4 + step
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(side)] * 3), axis=-1).reshape(-1, 3)
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(grid * (1 + 0.3 * step), deep=True))
    data.SetPoints(points)
    radii = numpy_to_vtk(numpy.full(len(grid), 0.5), deep=True)
    radii.SetName("radius")
    data.GetPointData().AddArray(radii)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetDataModeToBinary()
    writer.SetFileName(path)
    writer.Write()


def new_view():
    view = simple.CreateView("RenderViewWithSilhouettes")
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0
    return view


def show(source, view):
    display = simple.Show(source, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    return display


def textures(source):
    data = servermanager.Fetch(source)
    return vtk_to_numpy(data.GetFieldData().GetArray("AmbientOcclusionTextures"))


class Session(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, name):
        return os.path.join(self.folder, name)

    def series(self):
        files = [self.file(f"step{step}.vtp") for step in range(STEPS)]
        for step, path in enumerate(files):
            write_step(path, step)
        return files


class Cache(Session):
    def test_a_step_back_and_a_later_session_load_what_was_baked(self):
        reader = simple.XMLPolyDataReader(FileName=self.series())
        settings = dict(TextureResolution=4, UseCache=1, CacheDirectory=self.file("cache"))
        baked = simple.SphereAmbientOcclusion(Input=reader, **settings)

        def step(source, time):
            source.UpdatePipeline(time)
            source.UpdatePropertyInformation()
            return source.GetPropertyValue("LoadedFromCache"), textures(source)

        forward = [step(baked, time) for time in range(STEPS)]
        back = [step(baked, time) for time in reversed(range(STEPS - 1))]
        self.assertEqual([loaded for loaded, _ in forward], [0] * STEPS)
        self.assertEqual([loaded for loaded, _ in back], [1] * (STEPS - 1))
        self.assertEqual(len(os.listdir(self.file("cache"))), STEPS)
        later = simple.SphereAmbientOcclusion(
            Input=simple.XMLPolyDataReader(FileName=[self.file("step2.vtp")]), **settings)
        loaded, table = step(later, 0)
        self.assertEqual(loaded, 1)
        numpy.testing.assert_array_equal(table, forward[2][1])
        numpy.testing.assert_array_equal(back[-1][1], forward[0][1])


class TimeSeries(Session):
    def setUp(self):
        super().setUp()
        self.files = self.series()
        reader = simple.XMLPolyDataReader(FileName=self.files)
        self.baked = simple.SphereAmbientOcclusion(Input=reader, TextureResolution=4)
        self.view = new_view()
        self.display = show(self.baked, self.view)
        self.animation = simple.GetAnimationScene()
        self.animation.UpdateAnimationUsingDataTimeSteps()
        simple.ResetCamera(self.view)

    def picture(self, name):
        simple.SaveScreenshot(self.file(name), self.view, ImageResolution=SIZE)
        return images.read(self.file(name))

    def picture_of_file(self, step):
        """The same view of the one file, in a pipeline of its own."""
        simple.Hide(self.baked, self.view)
        baked = simple.SphereAmbientOcclusion(
            Input=simple.XMLPolyDataReader(FileName=[self.files[step]]), TextureResolution=4)
        show(baked, self.view)
        picture = self.picture("single.png")
        table = textures(baked)
        simple.Delete(baked)
        simple.Show(self.baked, self.view)
        return picture, table

    def test_every_step_has_its_own_spheres_and_textures(self):
        camera = (list(self.view.CameraPosition), list(self.view.CameraFocalPoint))
        seen = []
        for step, time in enumerate(self.animation.TimeKeeper.TimestepValues):
            self.animation.AnimationTime = time
            picture = self.picture("step.png")
            table = textures(self.baked)
            self.display.UpdatePropertyInformation()
            self.assertEqual(self.display.GetPropertyValue("NumberOfSpheres"), (4 + step)**3)
            expected_picture, expected_table = self.picture_of_file(step)
            numpy.testing.assert_array_equal(table, expected_table)
            numpy.testing.assert_array_equal(picture, expected_picture)
            seen.append(picture)
        self.assertEqual(len(seen), STEPS)
        self.assertGreater(numpy.abs(seen[0] - seen[1]).mean(), 1)
        self.assertEqual(camera, (list(self.view.CameraPosition), list(self.view.CameraFocalPoint)))

    def test_an_animation_is_played_and_saved(self):
        stills = []
        for time in self.animation.TimeKeeper.TimestepValues:
            self.animation.AnimationTime = time
            stills.append(self.picture("still.png"))
        self.animation.GoToFirst()
        self.animation.Play()
        self.assertEqual(self.animation.AnimationTime, STEPS - 1)
        simple.SaveAnimation(self.file("frame.png"), self.view, ImageResolution=SIZE)
        for step, still in enumerate(stills):
            frame = images.read(self.file(f"frame.{step:04d}.png"))
            numpy.testing.assert_array_equal(frame, still)


CACHE = tempfile.TemporaryDirectory()
# The encoding and the storage exclude each other: the bake reports it and passes the particles on.
FILTER = dict(RadiusFrom="Diameter", RadiusArray="radius", Density=2.0, RadiusScale=0.9, ConstantRadius=0.4,
              TextureResolution=5, SamplesPerTexel=20, TargetError=0.2, Method="Embree", MaximumDistance=3.0, Background="Gradient",
              BackgroundUp=[0.0, 1.0, 0.5], BackgroundBottom=0.25, BackgroundTop=1.5,
              CropArray="radius", CropComponent=0, CropRange=[0.1, 2.0], CropPlane=1,
              CropPlaneOrigin=[0.5, 0.25, 0.0], CropPlaneNormal=[1.0, 0.0, 0.5],
              CropBox=1, CropBoxOrigin=[-9.0, -9.0, -9.0], CropBoxSize=[20.0, 20.0, 20.0],
              BakeLight=1, LightDirection=[0.0, -1.0, -0.5], LightIntensity=0.5,
              BackgroundImage="sky.exr", DilateInside=0, InsideThreshold=0.1, Encoding="Float32Linear",
              Storage="Variable Size", StorageError=0.02, ReuseUnchanged=1, OutOfCore=1, Seed=7,
              IdArray="radius", UseCache=1, CacheDirectory=CACHE.name, CacheSizeLimit=100)
DISPLAY = dict(RadiusArray="radius", RadiusScale=0.8, ConstantRadius=0.3, ShadingMode="Ambient Occlusion",
               OcclusionOnDiffuse=0, Shadows=1, LayersFile="layers.exr", LayersResolution=[320, 240],
               TextureFile="textures.exr", TextureBudget=2.5)
VIEW = dict(SilhouetteVisibility=0, SilhouetteThreshold=2.5, SilhouetteBackgroundDepth=30.0,
            SilhouetteColor=[1.0, 0.5, 0.25], SilhouetteOpacity=0.5)


def values(proxy, names):
    found = {}
    for name in names:
        value = proxy.GetPropertyValue(name)
        if hasattr(value, "__len__") and not isinstance(value, str):
            value = list(value) if len(value) > 1 else value[0]
        found[name] = value
    return found


def set_all(proxy, chosen):
    """Sets properties as the panels of the window do, which trace that they were modified."""
    tracing = None
    if servermanager.vtkSMTrace.GetActiveTracer():
        tracing = smtrace._create_trace_item_internal("PropertiesModified", kwargs={"proxy": proxy.SMProxy})
    for name, value in chosen.items():
        proxy.SetPropertyWithName(name, value)
    if tracing:
        tracing.finalize()


def change_times(proxy):
    """When each property was modified last, by name."""
    times = {}
    properties = proxy.SMProxy.NewPropertyIterator()
    properties.Begin()
    while not properties.IsAtEnd():
        times[properties.GetKey()] = properties.GetProperty().GetMTime()
        properties.Next()
    return times


class State(Session):
    def make(self):
        """A pipeline in which no property of the plugin has its default."""
        path = self.series()[0]
        reader = simple.XMLPolyDataReader(registrationName="particles", FileName=[path])
        walls = simple.Plane(registrationName="walls", Origin=[-2, -2, -2], Point1=[9, -2, -2], Point2=[-2, 9, -2])
        baked = simple.SphereAmbientOcclusion(registrationName="baked", Input=reader, Occluders=walls)
        set_all(baked, FILTER)
        view = new_view()
        display = show(baked, view)
        set_all(display, DISPLAY)
        set_all(view, VIEW)
        simple.Render(view)

    def check(self):
        baked = simple.FindSource("baked")
        self.assertIsNotNone(baked)
        self.assertEqual(values(baked, FILTER), FILTER)
        self.assertEqual(baked.Occluders, simple.FindSource("walls"))
        view = [v for v in simple.GetViews() if v.GetXMLName() == "RenderViewWithSilhouettes"][0]
        self.assertEqual(values(view, VIEW), VIEW)
        display = simple.GetDisplayProperties(baked, view)
        self.assertEqual(display.Representation, "Ray-Traced Spheres")
        self.assertEqual(values(display, DISPLAY), DISPLAY)

    def test_the_tables_above_name_every_property(self):
        """A new property must be added above, or it is not tested."""
        self.make()
        baked = simple.FindSource("baked")
        own = {name for name in baked.ListProperties()
               if not baked.GetProperty(name).SMProperty.GetInformationOnly()}
        own -= {"Input", "Occluders", "Preset", "Estimate"}  # the last two have no value
        self.assertEqual(own, set(FILTER))
        for name, value in list(values(baked, FILTER).items()):
            prototype = baked.GetProperty(name).SMProperty
            self.assertFalse(prototype.IsValueDefault(), name)

    def test_a_state_file_brings_everything_back(self):
        self.make()
        simple.SaveState(self.file("all.pvsm"))
        simple.ResetSession()
        simple.LoadState(self.file("all.pvsm"))
        self.check()

    def test_a_python_state_brings_everything_back(self):
        self.make()
        script = smstate.get_state()
        simple.ResetSession()
        exec(compile(script, "state", "exec"), {})
        self.check()

    def test_a_trace_repeats_everything(self):
        smtrace.start_trace()
        try:
            self.make()
        finally:
            script = smtrace.stop_trace()
        simple.ResetSession()
        exec(compile(script, "trace", "exec"), {})
        self.check()

    def test_nothing_changes_by_itself(self):
        """A trace takes what changes while properties are set for set properties, and cannot be played then."""
        self.make()
        baked = simple.FindSource("baked")
        view = simple.GetActiveView()
        for proxy in (baked, simple.GetDisplayProperties(baked, view), view):
            proxy.SMProxy.UpdatePropertyInformation()
            before = change_times(proxy)
            self.assertGreater(len(before), 30)
            memory = bytearray(os.urandom(1 << 20) * 16)
            proxy.SMProxy.UpdatePropertyInformation()
            self.assertEqual(change_times(proxy), before)
            del memory

    def test_changes_are_undone_and_redone(self):
        stack = servermanager.vtkSMUndoStack()
        builder = servermanager.vtkSMUndoStackBuilder()
        builder.SetUndoStack(stack)
        manager = servermanager.vtkSMProxyManager.GetProxyManager()
        manager.SetUndoStackBuilder(builder)  # states of proxies are kept from now on
        self.addCleanup(manager.SetUndoStackBuilder, None)
        self.make()
        baked = simple.FindSource("baked")
        view = simple.GetActiveView()
        display = simple.GetDisplayProperties(baked, view)
        for proxy, name, other in ((baked, "SamplesPerTexel", 25), (display, "Shadows", 0),
                                   (view, "SilhouetteThreshold", 1.0)):
            before = proxy.GetPropertyValue(name)
            builder.Begin(name)
            proxy.SetPropertyWithName(name, other)
            builder.End()
            builder.PushToStack()
            stack.Undo()
            self.assertEqual(proxy.GetPropertyValue(name), before, name)
            stack.Redo()
            self.assertEqual(proxy.GetPropertyValue(name), other, name)


class Memory(Session):
    def scenes(self, display):
        display.UpdatePropertyInformation()
        return display.GetPropertyValue("NumberOfScenes")

    def test_views_share_a_scene_and_give_it_back(self):
        particles = simple.XMLPolyDataReader(FileName=[self.series()[0]])
        views = [new_view(), new_view()]
        displays = [show(particles, view) for view in views]
        for view in views:
            simple.Render(view)
        self.assertEqual(self.scenes(displays[0]), 1)
        displays[1].RadiusScale = 0.5
        simple.Render(views[1])
        self.assertEqual(self.scenes(displays[0]), 2)
        simple.Hide(particles, views[1])
        simple.Render(views[1])
        self.assertEqual(self.scenes(displays[0]), 1)
        simple.Show(particles, views[1])
        simple.Render(views[1])
        self.assertEqual(self.scenes(displays[0]), 2)
        displays[1].SetRepresentationType("Points")
        simple.Render(views[1])
        self.assertEqual(self.scenes(displays[0]), 1)
        simple.Delete(views[1])
        simple.Hide(particles, views[0])
        self.assertEqual(self.scenes(displays[0]), 0)

    def test_a_deleted_source_leaves_no_scene(self):
        view = new_view()
        particles = simple.XMLPolyDataReader(FileName=[self.series()[0]])
        other = simple.XMLPolyDataReader(FileName=[self.series()[1]])
        kept = show(other, view)
        show(particles, view)
        simple.Render(view)
        self.assertEqual(self.scenes(kept), 2)
        simple.Delete(particles)
        simple.Render(view)
        self.assertEqual(self.scenes(kept), 1)


class Layers(Session):
    def test_layers_have_the_resolution_that_is_asked_for(self):
        view = new_view()
        particles = simple.XMLPolyDataReader(FileName=[self.series()[0]])
        display = show(particles, view)
        simple.ResetCamera(view)
        simple.Render(view)
        sizes = {}
        for resolution in ([0, 0], [640, 480]):
            display.LayersFile = self.file(f"layers{resolution[0]}.exr")
            display.LayersResolution = resolution
            display.SMProxy.InvokeCommand("WriteLayers")
            with open(display.LayersFile, "rb") as file:
                head = file.read(2000)
            window = head.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
            sizes[resolution[0]] = numpy.frombuffer(head[window:window + 16], "<i4")[2:] + 1
        self.assertEqual(list(sizes[640]), [640, 480])
        self.assertEqual(list(sizes[0]), SIZE)


if __name__ == "__main__":
    simple.LoadPlugin(PLUGIN, ns=vars(simple))
    done = unittest.main(exit=False)
    # ParaView 5.11 crashes where Python ends after ResetSession.
    sys.stderr.flush()
    os._exit(0 if done.result.wasSuccessful() else 1)
