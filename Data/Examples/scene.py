# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts share: a view for pictures on paper, a light from the side, spheres, colours, a camera."""
from paraview.simple import *


def make_view(size, kind="RenderView"):
    """A white view of `size` pixels, without axes; kind "RenderViewWithSilhouettes" has lines on everything."""
    view = CreateView(kind)
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1, 1, 1]
    view.UseFXAA = 0  # it would blur edges and lines, which are smooth already
    return view


def light_from_the_side(view):
    """A directional light from the upper left, in place of the headlight, so that shadows show."""
    view.UseLight = 0
    light = AddLight(view=view)
    light.Coords = "Camera"
    light.Type = "Directional"
    light.Position = [-0.9, 1.1, 1.4]
    light.FocalPoint = [0, 0, 0]
    light.DiffuseColor = [1, 1, 1]
    light.Intensity = 1


def show_spheres(baked, view, ambient=0, diffuse=1):
    """In one colour. With ambient light, occlusion darkens that alone, as that of an overcast sky."""
    display = Show(baked, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = [0.92, 0.9, 0.86]
    display.Ambient, display.Diffuse = ambient, diffuse
    display.OcclusionOnDiffuse = int(ambient == 0)
    return display


def color_by(display, array):
    """By a point array, with a colour map that grows evenly in lightness: for prints and colour-blind readers too."""
    ColorBy(display, ("POINTS", array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset("Viridis (matplotlib)", True)
    return table


def aim_camera(view, elevation, azimuth=0, zoom=1):
    """At everything; angles in degrees from ParaView's own view."""
    ResetCamera(view)
    camera = view.GetActiveCamera()
    camera.Elevation(elevation)
    camera.Azimuth(azimuth)
    camera.OrthogonalizeViewUp()
    ResetCamera(view)
    camera.Zoom(zoom)
