# SPDX-License-Identifier: BSD-3-Clause
"""Looks at one particle from nearby and notes what ParaView's tooltip says once somebody rests the mouse on it; crops
what lies in front of another one, and notes again. Run by test_hover.py inside `paraview`, where gui_hover.xml turns
hovering on."""
import os
import traceback

import numpy
from gui_notes import note
from paraview.modules.vtkRemotingMisc import vtkSMTooltipSelectionPipeline
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import reference


def look_at(view, particles, point):
    """From above; the particle nearly fills the height of the view. ParaView looks at all that is shown some time
    after the script: this is called again and again."""
    center = particles.GetPoint(point)
    if numpy.allclose(view.GetActiveCamera().GetFocalPoint(), center):
        return
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = center
    view.CameraPosition = [center[0], center[1], center[2] + 100]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = 1.2 * particles.GetPointData().GetArray("radius").GetValue(point)
    Render(view)


def in_sight(centers, radii, point):
    """Is the particle's top in sight from above, once nothing is shown that has its centre above the particle's?"""
    below = centers[:, 2] <= centers[point, 2]
    below[point] = False
    across = numpy.hypot(*(centers[below, :2] - centers[point, :2]).T)
    tops = centers[below, 2] + numpy.sqrt(numpy.maximum(radii[below] ** 2 - across ** 2, 0))
    return centers[point, 2] + 0.7 * radii[point] > tops[across < radii[below]].max(initial=-numpy.inf)


def session():
    LoadPlugin(os.environ["PARTICLEOCCLUSION_PLUGIN"], ns=globals())
    view = GetActiveViewOrCreate("RenderView")
    source = OpenDataFile(os.path.join(os.environ["PARTICLEOCCLUSION_TEST_DATA"], "molecule.vtp"))
    display = Show(source, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    particles = servermanager.Fetch(source)
    centers = vtk_to_numpy(particles.GetPoints().GetData())
    radii = vtk_to_numpy(particles.GetPointData().GetArray("radius"))
    from_above = [point for point in centers[:, 2].argsort()[::-1] if in_sight(centers, radii, point)]
    watch(view, display, particles, [int(from_above[0]), int(from_above[len(from_above) // 2])])


def watch(view, display, particles, expected):
    """Goes on in ParaView's event loop, after this script."""
    pipeline = vtkSMTooltipSelectionPipeline.GetInstance()
    found = []

    def look(*_):
        if len(found) == len(expected):
            return
        look_at(view, particles, expected[len(found)])
        text = reference("")
        asked = pipeline.GetSelectionRepresentation()  # else there is no tooltip yet, and ParaView would crash
        if not asked or not pipeline.GetTooltipInfo(0, text):
            return
        wanted = f"Id: {expected[len(found)]}\n"
        if wanted not in str(text):
            note("otherwise", f"{text} in place of {wanted}")  # may be what was there before
            return
        found.append(str(text))
        note(f"named{len(found)}", str(text))
        if len(found) < len(expected):
            crop_to(display, particles, expected[len(found)])

    view.GetInteractor().AddObserver("TimerEvent", look)
    view.GetInteractor().CreateRepeatingTimer(100)
    note("begun", "")


def crop_to(display, particles, point):
    """Nothing that has its centre above that of the particle is shown."""
    display.CropPlane, display.CropPlaneNormal = 1, [0, 0, -1]
    display.CropPlaneOrigin = particles.GetPoint(point)


try:
    session()
except BaseException:
    note("begun", traceback.format_exc())
