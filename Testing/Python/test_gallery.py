# SPDX-License-Identifier: BSD-3-Clause
"""The gallery, smaller and of one set: every picture of the page is there, and before and after differ; the pictures
of the README are of few colours.

Usage: pvpython test_gallery.py GENERATEPARTICLES
"""
import os
import re
import sys
import tempfile

import images

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Data"))
import gallery  # noqa: E402

GENERATOR = sys.argv[1]
gallery.SIZE = [240, 180]
gallery.SETS = [look for look in gallery.SETS if look[0] == "molecule.vtp"]

with tempfile.TemporaryDirectory() as folder:
    gallery.GENERATOR = ""
    sys.argv[1:] = [folder]
    gallery.main()
    with open(os.path.join(folder, "index.html"), encoding="utf-8") as page:
        names = re.findall("src='(.*?)'", page.read())
    assert len(names) == 2 * len(gallery.ROWS), names
    for before, after in zip(names[::2], names[1::2]):
        difference = images.read(os.path.join(folder, before)) - images.read(os.path.join(folder, after))
        assert abs(difference).mean() > 0.05, (before, after)

    gallery.GENERATOR, gallery.PICTURES = GENERATOR, os.path.join(folder, "Pictures")
    sys.argv[1:] = ["--readme"]
    gallery.main()
    assert len(os.listdir(gallery.PICTURES)) == 3
    for name in os.listdir(gallery.PICTURES):
        with gallery.Image.open(os.path.join(gallery.PICTURES, name)) as picture:
            assert picture.size == (240, 180) and picture.mode == "P", name
