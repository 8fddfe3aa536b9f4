# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of ParaView's window in the README, in Data/Pictures/: the real `paraview` on a virtual display, worked
with mouse and keys as the README says.

    pvpython Data/gui_pictures.py [FOLDER]

Needs xvfb and xdotool. The plugin is that of build/, or of the environment variable PARTICLEOCCLUSION_PLUGIN.
"""
import argparse
import os
import sys
import tempfile
import time

from PIL import Image, ImageGrab

DATA = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(DATA, "Examples"), os.path.join(DATA, "..", "Testing", "Python")]
import plugin  # noqa: E402
import screen  # noqa: E402

WIDTH, HEIGHT = 1280, 960

#: Runs in ParaView. What a step does is done as soon as there is a file of its name; then there is NAME.done.
SESSION = """
import os
from paraview.simple import *

view = GetActiveViewOrCreate("RenderView")
made = {{}}

def open_file():
    made["particles"] = OpenDataFile({heap!r}, registrationName="heap.vtp")
    Show(made["particles"], view)
    view.ResetActiveCameraToPositiveY()
    ResetCamera(view)
    Render(view)
    SetActiveSource(made["particles"])

def bake():
    baked = FindSource("SphereAmbientOcclusion1")
    baked.Method, baked.SamplesPerTexel = "Reference", 256
    baked.UpdatePipeline()

def shown():
    for source in list(GetSources().values()):
        Delete(source)
    baked = SphereAmbientOcclusion(registrationName="disc, baked", Input=OpenDataFile({disc!r}))
    display = made["display"] = Show(baked, view)
    ColorBy(display, ("POINTS", "damage"))
    GetColorTransferFunction("damage").ApplyPreset("Viridis (matplotlib)", True)
    display.OcclusionOnDiffuse, display.Ambient, display.Diffuse = 0, 0.6, 0.5
    view.ResetActiveCameraToNegativeZ()
    ResetCamera(view)
    view.GetActiveCamera().Elevation(-52)
    view.GetActiveCamera().Azimuth(18)
    view.GetActiveCamera().OrthogonalizeViewUp()
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    SetActiveSource(baked)

def outlined():
    made["display"].SilhouetteVisibility = 1
    Render(view)

def look(*_):
    for step in (open_file, bake, shown, outlined):
        path = os.path.join({folder!r}, step.__name__)
        if os.path.exists(path):
            os.remove(path)
            step()
            open(path + ".done", "w").close()

view.GetInteractor().AddObserver("TimerEvent", look)
view.GetInteractor().CreateRepeatingTimer(200)
open(os.path.join({folder!r}, "ready"), "w").close()
"""


class Session:
    """The window, and the script in it."""

    def __init__(self, display, folder):
        self.display, self.folder = display, folder
        path = os.path.join(folder, "session.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SESSION.format(folder=folder, heap=os.path.join(DATA, "heap.vtp"),
                                      disc=os.path.join(DATA, "bullet_1000.vtp")))
        listed = os.path.join(os.path.dirname(os.path.dirname(plugin.path())), "ParticleOcclusion.plugins.xml")
        display.open_window("paraview", f"--script={path}", PV_PLUGIN_CONFIG_FILE=listed)
        self.wait("ready")

    def wait(self, name):
        if self.display.wait_for(os.path.join(self.folder, name)) is None:
            sys.exit(f"ParaView has not come to {name}.")
        time.sleep(5)  # panels are built after it, and views drawn in full

    def begin(self, step):
        open(os.path.join(self.folder, step), "w", encoding="utf-8").close()

    def run(self, step):
        self.begin(step)
        self.wait(step + ".done")

    def press(self, *words):
        self.display.do(*words)
        time.sleep(3)

    def grab(self, *box):
        """A picture of the window, or of the box (left, top, right, bottom) of it."""
        picture = ImageGrab.grab(xdisplay=self.display.display)
        return picture.crop(box) if box else picture


def walk(session, save):
    """The steps of the README."""
    session.run("open_file")
    save("walk-open", session.grab().resize((WIDTH // 2, HEIGHT // 2), Image.LANCZOS))
    session.press("mousemove", 80, 196, "click", 1)  # keys go to where the mouse was
    session.press("mousemove", 700, 600, "key", "ctrl+space")
    session.press("type", "AO")
    save("walk-search", session.grab(455, 290, 815, 590))
    session.press("key", "Return")
    save("walk-filter", session.grab(0, 430, 290, 935))
    session.begin("bake")
    time.sleep(10)
    save("walk-progress", session.grab(380, HEIGHT - 35, 880, HEIGHT))
    session.display.click_along(HEIGHT - 15, 200, 700)  # the cross is among them
    session.wait("bake.done")
    session.run("shown")
    session.run("outlined")
    save("window", session.grab())
    session.press("mousemove", 130, 523, "click", 1, "type", "silhouette")
    save("walk-silhouettes", session.grab(0, 430, 290, 935))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default=os.path.join(DATA, "Pictures"))
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)

    def save(name, picture):
        picture.convert("RGB").quantize(64).save(os.path.join(options.folder, name + ".png"), optimize=True)

    with tempfile.TemporaryDirectory() as folder, screen.Screen(WIDTH, HEIGHT, folder) as display:
        walk(Session(display, folder), save)


main()
