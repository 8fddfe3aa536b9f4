# SPDX-License-Identifier: BSD-3-Clause
"""The example for plain VTK writes the right picture, and says what is wrong.

Usage: pvpython test_plain_vtk.py PLAINVTK
"""
import os
import subprocess
import sys
import tempfile

import images

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")



def run(*arguments):
    return subprocess.run([sys.argv[1], *arguments], capture_output=True, text=True, timeout=300)


def check_refused(*arguments, says):
    done = run(*arguments)
    assert done.returncode == 1, (arguments, done.returncode)
    assert says in done.stderr, (arguments, done.stderr)


PARTICLES = os.path.join(DATA, "molecule.vtp")
with tempfile.TemporaryDirectory() as folder:
    picture = os.path.join(folder, "plain-vtk.png")
    done = run(PARTICLES, picture)
    assert done.returncode == 0, done.stderr
    images.compare(picture, "plain-vtk.png")

    unwritable = os.path.join(folder, "missing", "picture.png")
    missing = os.path.join(folder, "missing.vtp")
    check_refused(says="Usage:")
    check_refused(PARTICLES, picture, "more", says="Usage:")
    check_refused(missing, picture, says=missing)
    check_refused(PARTICLES, unwritable, says=unwritable)
