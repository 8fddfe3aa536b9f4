# SPDX-License-Identifier: BSD-3-Clause
"""Notes of a session inside `paraview` to the test that runs it, which waits for them (screen.py)."""
import os


def note(name, text):
    """Leaves a file with the text, at once as a whole: the test reads it as soon as it is there."""
    path = os.path.join(os.environ["PARTICLEOCCLUSION_TEST_OUTPUT"], name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
