# SPDX-License-Identifier: BSD-3-Clause
"""Silhouettes before and after: pictures of the shipped data and a page that shows them side by side.

Usage: pvpython Data/silhouettes.py [FOLDER]; default silhouettes-output/ in the repository. Takes the
plugin of build/ or of the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import glob
import html
import os
import sys

from paraview.simple import *

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUTPUT = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "silhouettes-output")
SIZE = [480, 360]

#: Title of a row, what was there before, what is there now: settings of the representation.
PLAIN = {"SilhouetteVisibility": 0}
THESIS = {"SilhouetteVisibility": 1, "SilhouetteSamples": 1, "SilhouetteSlopeTest": 0}
LINES = {"SilhouetteVisibility": 1}
ROWS = [
    ("Lines where the depth jumps by more than the automatic threshold", PLAIN, LINES),
    ("Jagged lines of the thesis; antialiased along the rims of the spheres", THESIS, LINES),
    ("Every edge of every particle (Line Density 0.85); fewer lines (0.3)",
     {**LINES, "SilhouetteLineDensity": 0.85}, {**LINES, "SilhouetteLineDensity": 0.3}),
    ("Grey follows the jump; width follows it too",
     {**LINES, "SilhouetteLineDensity": 0.7, "SilhouetteGreyByJump": 1},
     {**LINES, "SilhouetteLineDensity": 0.7, "SilhouetteGreyByJump": 1, "SilhouetteWidthByJump": 1,
      "SilhouetteMaximumLineWidth": 2.5}),
    ("Darkened colours of the particles in place of black; no lines against the background",
     {**LINES, "SilhouetteDarken": 1}, {**LINES, "SilhouetteBackgroundLines": 0}),
]
DEFAULTS = {"SilhouetteVisibility": 0, "SilhouetteMaximumLineWidth": 3, "SilhouetteSamples": 4, "SilhouetteSlopeTest": 1,
            "SilhouetteLineDensity": 0.5, "SilhouetteGreyByJump": 0, "SilhouetteWidthByJump": 0,
            "SilhouetteDarken": 0, "SilhouetteBackgroundLines": 1}
DATA = [("bullet_1000.vtp", "damage", 30, -52, 1.5), ("heap.vtp", "speed", 10, 20, 1.4),
        ("molecule.vtp", "charge", 20, 15, 1.3)]


def load_plugin():
    built = glob.glob(os.path.join(ROOT, "build", "lib*", "**", "ParticleOcclusion.so"), recursive=True)
    plugin = os.environ.get("PARTICLEOCCLUSION_PLUGIN") or (built and built[0])
    if not plugin:
        raise SystemExit("The plugin is not built: run `bash Data/demo.sh`.")
    LoadPlugin(plugin, ns=globals())


def make_view():
    """ParaView's plain render view."""
    view = CreateRenderView()
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1, 1, 1]
    view.UseFXAA = 0
    return view


def show(view, file, array, azimuth, elevation, zoom):
    baked = SphereAmbientOcclusion(Input=OpenDataFile(os.path.join(ROOT, "Data", file)),
                                   TextureResolution=8)
    display = Show(baked, view)
    display.SetRepresentationType("Ray-Traced Spheres")
    ColorBy(display, ("POINTS", array))
    display.SetScalarBarVisibility(view, False)
    ResetCamera(view)
    camera = view.GetActiveCamera()
    camera.Elevation(elevation)
    camera.Azimuth(azimuth)
    camera.OrthogonalizeViewUp()
    ResetCamera(view)
    camera.Zoom(zoom)
    return display


def save(view, display, settings, name):
    for key, value in {**DEFAULTS, **settings}.items():
        setattr(display, key, value)
    SaveScreenshot(os.path.join(OUTPUT, name), view, ImageResolution=SIZE)


def make_pictures():
    """Names of the pictures: [data][row] -> (before, after)."""
    names = {}
    for file, *look in DATA:
        view = make_view()
        display = show(view, file, *look)
        stem = os.path.splitext(file)[0]
        names[file] = []
        for number, (_, before, after) in enumerate(ROWS, start=1):
            pair = tuple(f"{stem}-{number}{side}.png" for side in "ab")
            save(view, display, before, pair[0])
            save(view, display, after, pair[1])
            names[file].append(pair)
        Delete(view)
    return names


def write_page(names):
    with open(os.path.join(OUTPUT, "index.html"), "w", encoding="utf-8") as page:
        page.write("<!DOCTYPE html><html lang='en'><meta charset='utf-8'><title>Silhouettes</title>\n"
                   "<style>body{font-family:sans-serif;margin:2em}img{width:480px;margin:4px}"
                   "</style>\n<h1>Silhouettes, before and after</h1>\n"
                   "<p>All pictures are of ParaView's plain render view.</p>\n")
        for number, (title, _, _) in enumerate(ROWS):
            page.write(f"<h2>{html.escape(title)}</h2>\n")
            for pairs in names.values():
                page.write("<p>" + "".join(f"<img src='{name}' alt=''>" for name in pairs[number]) + "</p>\n")
        page.write("</html>\n")


def main():
    os.makedirs(OUTPUT, exist_ok=True)
    load_plugin()
    write_page(make_pictures())
    print("The page is", os.path.join(OUTPUT, "index.html"))


if __name__ == "__main__":
    main()
