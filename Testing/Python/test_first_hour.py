# SPDX-License-Identifier: BSD-3-Clause
"""Plays gui_first_hour.xml in the real ParaView window: search, presets, texts and displays as a new user meets them.

Usage: pvpython test_first_hour.py PARAVIEW
"""
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PLUGIN = os.environ["PARTICLEOCCLUSION_PLUGIN"]


def main():
    home = tempfile.mkdtemp(prefix="particleocclusion-first-hour-")
    # As ParaView loads what is installed: at its start, before the window is there.
    listed = os.path.join(os.path.dirname(os.path.dirname(PLUGIN)), "ParticleOcclusion.plugins.xml")
    environment = dict(os.environ, HOME=home, XDG_CONFIG_HOME=os.path.join(home, ".config"),
                       PV_PLUGIN_CONFIG_FILE=listed)
    command = [sys.argv[1], "--dr", "--exit",
               f"--data={os.path.join(HERE, '..', '..', 'Data', 'heap.vtp')}",
               f"--test-script={os.path.join(HERE, 'gui_first_hour.xml')}"]
    try:
        session = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                 errors="replace", timeout=300, check=False)
        passed = session.returncode == 0 and "Success =  true" in session.stdout
        if not passed or "ERR|" in session.stdout or "WARN|" in session.stdout:
            raise SystemExit(f"ParaView has ended with {session.returncode}:\n{session.stdout[-4000:]}")
    finally:
        shutil.rmtree(home)


main()
