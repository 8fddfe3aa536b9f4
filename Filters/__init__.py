# SPDX-License-Identifier: BSD-3-Clause
"""The classes of ParticleOcclusion for scripts that use VTK without ParaView's proxies.

Import it by the Python of the VTK that it was built with: pvpython, or python3 on Debian. `help()` of a class
shows its documentation.
"""
from .ParticleOcclusionFilters import *
from .ParticleOcclusionRendering import *
