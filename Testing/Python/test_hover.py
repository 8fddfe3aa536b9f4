# SPDX-License-Identifier: BSD-3-Clause
"""The mouse, resting on a particle in the real ParaView window, has the tooltip of that particle; also of one that is
seen only since others are cropped.

Usage: pvpython test_hover.py PARAVIEW
"""
import os
import sys
import tempfile
import time

import screen

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT = 1280, 960
MIDDLE = (785, 560)  # of the view, about
WELCOME = (625, 440)  # in a dialog that tells what hovering is, in the middle of the window


def rest_on_particle(display, named):
    """Rests the mouse here and there on the particle until it is named; returns whether it was."""
    until = time.time() + 180
    step = 0
    while not os.path.exists(named) and time.time() < until and display.window.poll() is None:
        step += 1
        display.do("mousemove", *WELCOME, "key", "Return")
        display.do("mousemove", MIDDLE[0] + 5 * (step % 4), MIDDLE[1] + 5 * (step % 3))
        display.wait_for(named, seconds=3)
    return os.path.exists(named)


def main():
    with tempfile.TemporaryDirectory(prefix="particleocclusion-hover-") as folder:
        log = os.path.join(folder, "log.txt")
        with open(log, "w", encoding="utf-8") as file, screen.Screen(WIDTH, HEIGHT, folder) as display:
            display.open_window(sys.argv[1], f"--script={os.path.join(HERE, 'gui_hover.py')}",
                                f"--test-script={os.path.join(HERE, 'gui_hover.xml')}", log=file,
                                PYTHONPATH=HERE, PARTICLEOCCLUSION_TEST_OUTPUT=folder,
                                PARTICLEOCCLUSION_TEST_DATA=os.path.join(HERE, "..", "..", "Data"))
            begun = display.wait_for(os.path.join(folder, "begun"))
            passed = begun == "" and all(
                rest_on_particle(display, os.path.join(folder, named)) for named in ("named1", "named2"))
            otherwise = display.wait_for(os.path.join(folder, "otherwise"), seconds=0.1)
        with open(log, encoding="utf-8", errors="replace") as file:
            printed = file.read()
        if not passed or "ERR|" in printed:
            raise SystemExit(f"The session in ParaView said: {begun} {otherwise}\n{printed[-4000:]}")


main()
