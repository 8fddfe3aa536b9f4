# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin for the scripts of this folder, wherever it is."""
import glob
import os

import paraview.simple

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
DATA = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def load(scope):
    """Puts the plugin's functions, such as SphereAmbientOcclusion, into `scope`: the globals() of the caller.

    Where the Debian package is installed ParaView has loaded it already. Else it is the file that the environment
    variable PARTICLEOCCLUSION_PLUGIN names, or what `cmake --build` left in build/.
    """
    if hasattr(paraview.simple, "SphereAmbientOcclusion"):
        return
    built = glob.glob(os.path.join(ROOT, "build", "lib*", "**", "ParticleOcclusion.so"), recursive=True)
    path = os.environ.get("PARTICLEOCCLUSION_PLUGIN") or (built and built[0])
    if not path:
        raise SystemExit("The plugin is neither installed nor built: run `bash Data/demo.sh`, or set "
                         "PARTICLEOCCLUSION_PLUGIN to ParticleOcclusion.so.")
    paraview.simple.LoadPlugin(path, ns=scope)
