# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin for the scripts of this folder, wherever it is."""
import glob
import os

import paraview.simple

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
DATA = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def path():
    """ParticleOcclusion.so: what the environment variable PARTICLEOCCLUSION_PLUGIN names, or `cmake --build` left."""
    built = glob.glob(os.path.join(ROOT, "build", "lib*", "**", "ParticleOcclusion.so"), recursive=True)
    found = os.environ.get("PARTICLEOCCLUSION_PLUGIN") or (built and built[0])
    if not found:
        raise SystemExit("The plugin is neither installed nor built: run `bash Data/demo.sh`, or set "
                         "PARTICLEOCCLUSION_PLUGIN to ParticleOcclusion.so.")
    return found


def load(scope):
    """Puts the plugin's functions, such as SphereAmbientOcclusion, into `scope`: the globals() of the caller.

    Where the Debian package is installed ParaView has loaded it already.
    """
    if not hasattr(paraview.simple, "SphereAmbientOcclusion"):
        paraview.simple.LoadPlugin(path(), ns=scope)
