# SPDX-License-Identifier: BSD-3-Clause
"""What a user does in the ParaView window: load the plugin, open a file, apply the filter, choose the
representation, outline it, save a picture and the state; switch representations, change colours, crop, select,
load the state, and wait for textures of a file and smooth edges. Run by test_gui.py inside `paraview`."""
import os
import traceback

from paraview.simple import *

OUTPUT = os.environ["PARTICLEOCCLUSION_TEST_OUTPUT"]
DATA = os.environ["PARTICLEOCCLUSION_TEST_DATA"]


def session():
    LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())
    default_view = GetActiveViewOrCreate("RenderView")
    particles = OpenDataFile(os.path.join(DATA, "molecule.vtp"))
    Show(particles, default_view)
    baked = SphereAmbientOcclusion(Input=particles, TextureResolution=8, SamplesPerTexel=25)
    display = Show(baked, default_view)
    if display.Representation != "Ray-Traced Spheres":
        raise RuntimeError(f"the baked data are shown as {display.Representation}")
    Hide(particles, default_view)

    view = CreateView("RenderViewWithSilhouettes")
    AssignViewToLayout(view=view, layout=GetLayout(default_view))
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0
    display = Show(baked, view)
    ColorBy(display, ("POINTS", "charge"))
    ResetCamera(view)
    Render(view)
    SaveScreenshot(os.path.join(OUTPUT, "gui.png"), view, ImageResolution=[400, 300])
    use_display(baked, display, view)
    SaveData(os.path.join(OUTPUT, "textures.exr"), baked)
    SaveState(os.path.join(OUTPUT, "gui.pvsm"))
    wait_for_textures_and_smooth_edges(*load_state())


def counter(display, name):
    display.SMProxy.UpdatePropertyInformation()
    return display.SMProxy.GetProperty(name).GetElement(0)


def expect(truth, what):
    if not truth:
        raise RuntimeError(what)


def use_display(baked, display, view):
    """The panel shows the display's properties, with widgets in the view, while they are changed."""
    SetActiveView(view)
    SetActiveSource(baked)
    everything = counter(display, "NumberOfShownSpheres")
    for representation in ("Points", "Ray-Traced Spheres"):
        display.SetRepresentationType(representation)
        Render(view)
    frames = counter(display, "NumberOfTracedFrames")
    ColorBy(display, ("POINTS", "AmbientOcclusion"))
    GetColorTransferFunction("AmbientOcclusion").RescaleTransferFunction(0, 2)
    Render(view)
    expect(counter(display, "NumberOfTracedFrames") == frames, "a colour map has cost rays")

    display.CropArray, display.CropRange = ["POINTS", "AmbientOcclusion"], [0.2, 2]
    Render(view)
    cropped = counter(display, "NumberOfShownSpheres")
    expect(0 < cropped < everything, f"{cropped} of {everything} particles are within the range")
    display.CropPlane = display.CropBox = 1
    Render(view)
    half = counter(display, "NumberOfShownSpheres")
    expect(0 < half < cropped, f"{half} particles are before a plane through the middle")
    display.CropPlane = display.CropBox = 0

    middle = [int(size / 2) for size in view.ViewSize]
    SelectSurfacePoints(Rectangle=[middle[0] - 20, middle[1] - 20, middle[0] + 20, middle[1] + 20], View=view)
    ids = list(baked.GetSelectionInput(0).Input[0].IDs)[1::2]
    expect(ids, "nothing is selected in the middle of the view")
    extracted = servermanager.Fetch(ExtractSelection(Input=baked, Selection=baked.GetSelectionInput(0)))
    values = extracted.GetPointData().GetArray("AmbientOcclusion")
    expect(min(values.GetValue(i) for i in range(values.GetNumberOfTuples())) >= 0.2, "a hidden particle is selected")
    ClearSelection(baked)


def load_state():
    """The view and display of the state, which ParaView now shows."""
    views = set(GetRenderViews())
    LoadState(os.path.join(OUTPUT, "gui.pvsm"))
    for view in GetRenderViews():
        for display in view.Representations if view not in views else []:
            if list(getattr(display, "CropRange", [])) == [0.2, 2]:
                return view, display
    raise RuntimeError("the state has lost the crop range")


def wait_for_textures_and_smooth_edges(view, display):
    """Goes on in ParaView's event loop, after this script."""
    SetActiveView(view)
    display.TextureFile = os.path.join(OUTPUT, "textures.exr")
    display.SamplesPerPixel = 8
    view.CameraViewAngle = 31
    Render(view)
    expect(counter(display, "NumberOfSamples") == 1, "the first picture was not shown at once")
    expect(counter(display, "NumberOfMissingTextures") > 0, "the first picture has waited for textures")
    interactor = view.GetInteractor()
    waits = []

    def look(*_):
        waits.append(1)
        samples, missing = counter(display, "NumberOfSamples"), counter(display, "NumberOfMissingTextures")
        if samples == 8 and missing == 0 and counter(display, "NumberOfResidentTextures") > 0:
            end("passed")
        elif len(waits) > 600:
            end(f"after a minute the picture has {samples} of 8 rays a pixel and lacks {missing} textures")

    interactor.AddObserver("TimerEvent", look)
    interactor.CreateRepeatingTimer(100)


def end(outcome):
    """ParaView has no command to quit: leave a note for the test and end the process."""
    with open(os.path.join(OUTPUT, "outcome.txt"), "w", encoding="utf-8") as note:
        note.write(outcome)
    if not os.environ.get("PARTICLEOCCLUSION_TEST_STAY"):
        os._exit(0)


try:
    session()
except BaseException:
    end(traceback.format_exc())
