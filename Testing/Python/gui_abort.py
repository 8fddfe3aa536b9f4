# SPDX-License-Identifier: BSD-3-Clause
"""Begins a bake of many hours, which somebody must stop by the cross beside the progress bar, then one of a moment.
Run by test_abort.py inside `paraview`."""
import os
import traceback

from gui_notes import note
from paraview.simple import *


def session():
    LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())
    view = GetActiveViewOrCreate("RenderView")
    particles = OpenDataFile(os.path.join(os.environ["PARTICLEOCCLUSION_TEST_DATA"], "bullet_1000.vtp"))
    baked = SphereAmbientOcclusion(Input=particles, Method="Reference", SamplesPerTexel=16384)
    note("begun", "")
    baked.UpdatePipeline()
    if "AmbientOcclusion" in baked.PointData.keys():
        raise RuntimeError("the bake was not aborted")
    bake_again(baked, view)


def bake_again(baked, view):
    """Goes on in ParaView's event loop, after this script; clicks that are still to come may stop a bake again."""
    baked.Method, baked.TextureResolution, baked.SamplesPerTexel = "Sweep", 4, 4
    interactor = view.GetInteractor()
    tries = []

    def bake(*_):
        tries.append(1)
        baked.Seed = len(tries)
        baked.UpdatePipeline()
        if "AmbientOcclusion" in baked.PointData.keys():
            interactor.DestroyTimer(timer)
            Show(baked, view)
            Render(view)
            note("outcome", "passed")
        elif len(tries) == 100:
            note("outcome", "the bakes after the aborted one were none")

    interactor.AddObserver("TimerEvent", bake)
    timer = interactor.CreateRepeatingTimer(500)


try:
    session()
except BaseException:
    note("outcome", traceback.format_exc())
