# SPDX-License-Identifier: BSD-3-Clause
"""Drives the real ParaView window with gui_session.py and compares the screenshot.

Usage: pvpython test_gui.py PARAVIEW
"""
import os
import shutil
import subprocess
import sys
import tempfile

import images

HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.path.join(HERE, "..", "..", "Data")


def run_paraview(executable, output):
    """Runs the session with settings of its own, so that those of the user play no part."""
    environment = dict(os.environ,
                       HOME=output,
                       XDG_CONFIG_HOME=os.path.join(output, ".config"),
                       PARTICLEOCCLUSION_TEST_OUTPUT=output,
                       PARTICLEOCCLUSION_TEST_DATA=DATA)
    # --dr: no settings of the user's, and no welcome window that would wait for a click.
    command = [executable, "--dr", f"--script={os.path.join(HERE, 'gui_session.py')}"]
    with open(os.path.join(output, "log.txt"), "w", encoding="utf-8") as log:
        subprocess.run(command, env=environment, stdout=log, stderr=log, timeout=300, check=False)


def read(path):
    if not os.path.exists(path):
        return "(missing)"
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def main():
    output = tempfile.mkdtemp(prefix="particleocclusion-gui-")
    try:
        run_paraview(sys.argv[1], output)
        outcome = read(os.path.join(output, "outcome.txt"))
        if outcome != "passed":
            log = read(os.path.join(output, "log.txt"))
            raise SystemExit(f"The session in ParaView failed: {outcome}\n{log[-4000:]}")
        images.compare(os.path.join(output, "gui.png"), "gui.png")
        if "Ray-Traced Spheres" not in read(os.path.join(output, "gui.pvsm")):
            raise SystemExit("The saved state does not mention the representation.")
    finally:
        shutil.rmtree(output)


main()
