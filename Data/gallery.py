# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: a page of pictures of the shipped data, and of a generated foam, before and after.

    pvpython Data/gallery.py [FOLDER]     a page, index.html; default gallery-output/ in the repository
    pvpython Data/gallery.py --readme     the pictures of the README, in Data/Pictures/

Takes the plugin that is installed, of build/, or of the environment variable PARTICLEOCCLUSION_PLUGIN. The foam is made
by build/bin/GenerateParticles; without it the page has none.
"""
import argparse
import html
import os
import subprocess
import sys
import tempfile

from paraview.simple import *
from PIL import Image

import demo  # which finds the examples
import plugin
import scene

SIZE = [480, 360]
PICTURES = os.path.join(demo.ROOT, "Data", "Pictures")
GENERATOR = os.path.join(demo.ROOT, "build", "bin", "GenerateParticles")

#: Title of a row, what was there before, what is there now: settings of the representation.
DIRECT = {"ShadingMode": "Direct Light"}
OCCLUSION = {"ShadingMode": "Ambient Occlusion"}
BOTH = {"ShadingMode": "Direct Light and Ambient Occlusion", "Shadows": 1}
PLAIN = {"SilhouetteVisibility": 0}
THESIS = {"SilhouetteVisibility": 1, "SilhouetteSamples": 1, "SilhouetteSlopeTest": 0}
LINES = {"SilhouetteVisibility": 1}
ROWS = [
    ("Direct light alone; ambient occlusion alone", DIRECT, OCCLUSION),
    ("Direct light with shadows; with ambient occlusion and lines too", {**DIRECT, "Shadows": 1}, {**BOTH, **LINES}),
    ("Lines where the depth jumps by more than the automatic threshold", PLAIN, LINES),
    ("Jagged lines of the thesis; antialiased along the rims of the spheres", THESIS, LINES),
    ("Lines as in figure 4.4 of the thesis: thresholds of 20 and 0.2 radii",
     {**THESIS, "SilhouetteThreshold": 20, "SilhouetteThresholdUnit": "Particle radii"},
     {**THESIS, "SilhouetteThreshold": 0.2, "SilhouetteThresholdUnit": "Particle radii"}),
    ("Every edge of every particle (Line Density 0.85); fewer lines (0.3)",
     {**LINES, "SilhouetteLineDensity": 0.85}, {**LINES, "SilhouetteLineDensity": 0.3}),
    ("Grey follows the jump; width follows it too",
     {**LINES, "SilhouetteLineDensity": 0.7, "SilhouetteGreyByJump": 1},
     {**LINES, "SilhouetteLineDensity": 0.7, "SilhouetteGreyByJump": 1, "SilhouetteWidthByJump": 1,
      "SilhouetteMaximumLineWidth": 2.5}),
    ("Darkened colours of the particles in place of black; no lines against the background",
     {**LINES, "SilhouetteDarken": 1}, {**LINES, "SilhouetteBackgroundLines": 0}),
]
DEFAULTS = {"ShadingMode": "Direct Light and Ambient Occlusion", "Shadows": 0,
            "SilhouetteVisibility": 0, "SilhouetteMaximumLineWidth": 3, "SilhouetteSamples": 4,
            "SilhouetteSlopeTest": 1,
            "SilhouetteThreshold": 0, "SilhouetteThresholdUnit": "World units", "SilhouetteLineDensity": 0.5,
            "SilhouetteGreyByJump": 0,
            "SilhouetteWidthByJump": 0, "SilhouetteDarken": 0, "SilhouetteBackgroundLines": 1}

#: File, array of the colours, azimuth, elevation, zoom.
SETS = [("bullet_1000.vtp", "damage", 30, -52, 1.5), ("heap.vtp", "speed", 10, 20, 1.4),
        ("molecule.vtp", "charge", 20, 15, 1.3)]
FOAM = ("foam.vtp", None, 25, 20, 1.25)


def make_view():
    """ParaView's plain render view, with a light from the side."""
    view = scene.make_view(SIZE)
    scene.light_from_the_side(view)
    return view


def show(view, path, array, azimuth, elevation, zoom):
    baked = SphereAmbientOcclusion(Input=OpenDataFile(path))
    display = scene.show_spheres(baked, view, ambient=0.6, diffuse=0.6)
    display.SamplesPerPixel = 8
    if array:
        scene.color_by(display, array)
        display.SetScalarBarVisibility(view, False)
    scene.aim_camera(view, elevation, azimuth, zoom)
    return display


def save(view, display, settings, path):
    for key, value in {**DEFAULTS, **settings}.items():
        setattr(display, key, value)
    SaveScreenshot(path, view, ImageResolution=SIZE)


def make_pictures(sets, folder):
    """Names of the pictures: [set][row] -> (before, after)."""
    names = []
    for path, *look in sets:
        view = make_view()
        display = show(view, path, *look)
        stem = os.path.splitext(os.path.basename(path))[0]
        names.append([])
        for number, (_, before, after) in enumerate(ROWS, start=1):
            pair = tuple(f"{stem}-{number}{side}.png" for side in "ab")
            save(view, display, before, os.path.join(folder, pair[0]))
            save(view, display, after, os.path.join(folder, pair[1]))
            names[-1].append(pair)
        Delete(view)
    return names


def write_page(names, folder):
    with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as page:
        page.write("<!DOCTYPE html><html lang='en'><meta charset='utf-8'><title>ParticleOcclusion</title>\n"
                   "<style>body{font-family:sans-serif;margin:2em}img{width:480px;margin:4px}"
                   "</style>\n<h1>Particles, before and after</h1>\n"
                   "<p>All pictures are of ParaView's plain render view, with the default settings of the bake.</p>\n")
        for number, (title, _, _) in enumerate(ROWS):
            page.write(f"<h2>{html.escape(title)}</h2>\n")
            for pairs in names:
                page.write("<p>" + "".join(f"<img src='{name}' alt=''>" for name in pairs[number]) + "</p>\n")
        page.write("</html>\n")


def make_foam(folder, count):
    """The foam in a list, or none where the program that makes it is not built."""
    if not os.path.exists(GENERATOR):
        return []
    path = os.path.join(folder, FOAM[0])
    subprocess.run([GENERATOR, "foam", str(count), path], check=True)
    return [(path, *FOAM[1:])]


def make_readme_pictures(sets):
    """The foam by direct light, by occlusion, and by both with lines: each of 256 colours, to be small."""
    view = make_view()
    display = show(view, *sets[0])
    os.makedirs(PICTURES, exist_ok=True)
    for name, settings in (("direct", {**DIRECT, "Shadows": 1}), ("occlusion", OCCLUSION), ("both", {**BOTH, **LINES})):
        path = os.path.join(PICTURES, f"foam-{name}.png")
        save(view, display, settings, path)
        with Image.open(path) as picture:
            picture.convert("RGB").quantize(64).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=os.path.join(demo.ROOT, "gallery-output"))
    parser.add_argument("--readme", action="store_true", help="only the pictures of the README")
    options = parser.parse_args()
    plugin.load(globals())
    with tempfile.TemporaryDirectory() as scratch:
        if options.readme:
            foam = make_foam(scratch, 40000)
            if not foam:
                sys.exit(f"{GENERATOR} is not built: run `bash Data/demo.sh`.")
            make_readme_pictures(foam)
            return
        shipped = [(os.path.join(demo.ROOT, "Data", file), *look) for file, *look in SETS]
        os.makedirs(options.folder, exist_ok=True)
        write_page(make_pictures(shipped + make_foam(scratch, 20000), options.folder), options.folder)
    print("The page is", os.path.join(options.folder, "index.html"))


if __name__ == "__main__":
    main()
