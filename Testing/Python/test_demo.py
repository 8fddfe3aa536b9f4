# SPDX-License-Identifier: BSD-3-Clause
"""The demo, at a smaller size: its pictures against the baselines, its files read back, its state loaded."""
import os
import sys
import tempfile

import images

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "Data"))
import demo  # noqa: E402
from paraview.simple import *  # noqa: E402,F403

PICTURES = ("direct", "ambient-occlusion", "combined", "silhouettes")


def check_pictures():
    for name in PICTURES:
        images.compare(demo.output(name + ".png"), f"demo-{name}.png")


def check_exr():
    for name in ("layers.exr", "textures.exr"):
        with open(demo.output(name), "rb") as file:
            assert file.read(4) == b"\x76\x2f\x31\x01", f"{name} is not an OpenEXR file"


def check_baked():
    baked = OpenDataFile(demo.output("baked.vtp"))
    baked.UpdatePipeline()
    information = baked.GetDataInformation()
    assert information.GetNumberOfPoints() == 25710
    mean = baked.GetPointDataInformation()["AmbientOcclusion"].GetRange()
    assert 0 <= mean[0] < 0.05 < 0.7 < mean[1] <= 1, mean
    for name in ("AmbientOcclusionTextures", "AmbientOcclusionParameters"):
        assert baked.GetFieldDataInformation()[name] is not None, f"{name} is missing"


def check_state():
    """A new session that loads the state shows the same picture."""
    ResetSession()
    LoadState(demo.output("state.pvsm"))
    view = GetActiveViewOrCreate("RenderViewWithSilhouettes")
    view.UseFXAA = 0  # ParaView takes it from the user's settings, not from the state
    SaveScreenshot(demo.output("state.png"), view, ImageResolution=demo.SIZE)
    images.compare(demo.output("state.png"), "demo-silhouettes.png")


with tempfile.TemporaryDirectory() as folder:
    demo.OUTPUT = folder
    demo.SIZE = [400, 280]
    demo.main()
    check_pictures()
    check_exr()
    check_baked()
    check_state()
