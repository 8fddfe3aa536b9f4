# SPDX-License-Identifier: BSD-3-Clause
"""Runs every Python script of the README as it stands, each in a process of its own.

Usage: pvpython test_readme.py PVPYTHON
"""
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PLUGIN_IN_README = "build/lib/paraview-5.11/plugins/ParticleOcclusion/ParticleOcclusion.so"


def scripts():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        return re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)


def run(number, script, folder):
    """Runs a script in `folder`, which looks like the repository; returns what it wrote."""
    script = script.replace(PLUGIN_IN_README, os.environ["PARTICLEOCCLUSION_PLUGIN"])
    path = os.path.join(folder, f"script{number}.py")
    with open(path, "w", encoding="utf-8") as file:
        file.write(script)
    done = subprocess.run([sys.argv[1], path], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0 or "Traceback" in done.stderr or "ERR|" in done.stderr:
        raise SystemExit(f"Script {number} of the README failed:\n{script}\n{done.stderr}")
    for name in re.findall(r'"([\w-]+\.(?:png|exr|vtp))"', script):
        if os.path.getsize(os.path.join(folder, name)) < 1000:
            raise SystemExit(f"Script {number} of the README wrote nothing to {name}")


with tempfile.TemporaryDirectory() as work:
    os.symlink(os.path.join(ROOT, "Data"), os.path.join(work, "Data"))
    found = scripts()
    assert len(found) >= 3, f"the README has {len(found)} scripts"
    for index, text in enumerate(found, start=1):
        run(index, text, work)
