# SPDX-License-Identifier: BSD-3-Clause
"""The example for plain VTK writes the right picture.

Usage: pvpython test_plain_vtk.py PLAINVTK
"""
import os
import subprocess
import sys
import tempfile

import images

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data")

with tempfile.TemporaryDirectory() as folder:
    picture = os.path.join(folder, "plain-vtk.png")
    subprocess.run([sys.argv[1], os.path.join(DATA, "molecule.vtp"), picture], check=True, timeout=100)
    images.compare(picture, "plain-vtk.png")
