# SPDX-License-Identifier: BSD-3-Clause
"""What a user does in the ParaView window: load the plugin, open a file, apply the filter, choose the
representation, outline it, save a picture and the state. Run by test_gui.py inside `paraview`."""
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
    SaveState(os.path.join(OUTPUT, "gui.pvsm"))


def end(outcome):
    """ParaView has no command to quit: leave a note for the test and end the process."""
    with open(os.path.join(OUTPUT, "outcome.txt"), "w", encoding="utf-8") as note:
        note.write(outcome)
    if not os.environ.get("PARTICLEOCCLUSION_TEST_STAY"):
        os._exit(0)


try:
    session()
    end("passed")
except BaseException:
    end(traceback.format_exc())
