# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of ParaView's window in the README, in Data/Pictures/: the real `paraview` on a virtual display.

    python3 Data/gui_pictures.py

Needs xvfb. The plugin is that of build/, or of the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import os
import subprocess
import tempfile
import time

from PIL import Image, ImageGrab

DATA = os.path.dirname(os.path.abspath(__file__))
PICTURES = os.path.join(DATA, "Pictures")

#: Runs in ParaView; the window is as it leaves it.
SESSION = """
import sys
sys.path.insert(0, {examples!r})
from paraview.simple import *
import plugin
plugin.load(globals())
view = GetActiveViewOrCreate("RenderView")
particles = OpenDataFile({particles!r})
baked = SphereAmbientOcclusion(Input=particles)
display = Show(baked, view)
ColorBy(display, ("POINTS", "damage"))
display.SilhouetteVisibility = 1
display.OcclusionOnDiffuse, display.Ambient, display.Diffuse = 0, 0.6, 0.5
ResetCamera(view)
view.GetActiveCamera().Elevation(-52)
view.GetActiveCamera().Azimuth(18)
view.GetActiveCamera().OrthogonalizeViewUp()
ResetCamera(view)
view.GetActiveCamera().Zoom(1.4)
Render(view)
SetActiveSource(baked)
open({note!r}, "w").close()
"""


def grab(folder, width, height):
    """The window, as a picture, with settings that are nobody's."""
    note = os.path.join(folder, "ready")
    session = os.path.join(folder, "session.py")
    with open(session, "w", encoding="utf-8") as file:
        file.write(SESSION.format(examples=os.path.join(DATA, "Examples"), note=note,
                                  particles=os.path.join(DATA, "bullet_1000.vtp")))
    environment = dict(os.environ, HOME=folder, XDG_CONFIG_HOME=os.path.join(folder, ".config"), DISPLAY=":97")
    server = subprocess.Popen(["Xvfb", ":97", "-noreset", "-screen", "0", f"{width}x{height}x24"])
    try:
        time.sleep(2)
        window = subprocess.Popen(["paraview", "--dr", "-geometry", f"{width}x{height}+0+0", f"--script={session}"],
                                  env=environment)
        try:
            until = time.time() + 120
            while not os.path.exists(note) and time.time() < until:
                time.sleep(1)
            time.sleep(20)  # the panel is built after the script, and the view drawn in full
            return ImageGrab.grab(xdisplay=":97")
        finally:
            window.kill()
            window.wait()
    finally:
        server.terminate()
        server.wait()
        os.path.exists(note) and os.remove(note)


def save(picture, name):
    os.makedirs(PICTURES, exist_ok=True)
    picture.convert("RGB").quantize(128).save(os.path.join(PICTURES, name), optimize=True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        save(grab(folder, 1280, 960), "window.png")


main()
