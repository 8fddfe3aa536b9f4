# SPDX-License-Identifier: BSD-3-Clause
"""The cross beside the progress bar, pressed in the real ParaView window, stops a bake that would take hours; the window
lives on.

Usage: pvpython test_abort.py PARAVIEW
"""
import os
import sys
import tempfile
import time

import screen

HERE = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT = 1280, 960


def stop_bake(display, outcome):
    """Clicks along the status bar, where the cross is, until the session has something to say."""
    until = time.time() + 300
    while not os.path.exists(outcome) and time.time() < until and display.window.poll() is None:
        display.click_along(HEIGHT - 15, 200, 700)
        time.sleep(1)


def main():
    with tempfile.TemporaryDirectory(prefix="particleocclusion-abort-") as folder:
        begun, outcome, log = (os.path.join(folder, name) for name in ("begun", "outcome", "log.txt"))
        with open(log, "w", encoding="utf-8") as file, screen.Screen(WIDTH, HEIGHT, folder) as display:
            display.open_window(sys.argv[1], f"--script={os.path.join(HERE, 'gui_abort.py')}", log=file,
                                PYTHONPATH=HERE, PARTICLEOCCLUSION_TEST_OUTPUT=folder,
                                PARTICLEOCCLUSION_TEST_DATA=os.path.join(HERE, "..", "..", "Data"))
            if display.wait_for(begun) is not None:
                stop_bake(display, outcome)
            said = display.wait_for(outcome, seconds=1)
            lives = display.window.poll() is None
        with open(log, encoding="utf-8", errors="replace") as file:
            printed = file.read()
        if said != "passed" or not lives or "ERR|" in printed:
            raise SystemExit(f"The session in ParaView said: {said}; the window lives: {lives}\n{printed[-4000:]}")


main()
