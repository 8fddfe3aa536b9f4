# SPDX-License-Identifier: BSD-3-Clause
"""Runs every Python script of the documents as it stands, each in a process of its own; all their links lead somewhere.

Usage: pvpython test_readme.py PVPYTHON
"""
import os
import re
import subprocess
import sys
import tempfile

import links

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PLUGIN_IN_DOCUMENTS = "build/lib/paraview-5.11/plugins/ParticleOcclusion/ParticleOcclusion.so"
DOCUMENTS = {"README.md": 1, os.path.join("Plugin", "README.md"): 5}  # with the least number of scripts


def scripts(document):
    with open(os.path.join(ROOT, document), encoding="utf-8") as file:
        return re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)


def run(name, script, folder):
    """Runs a script in `folder`, which looks like the repository, and looks at what it wrote."""
    script = script.replace(PLUGIN_IN_DOCUMENTS, os.environ["PARTICLEOCCLUSION_PLUGIN"])
    path = os.path.join(folder, "script.py")
    with open(path, "w", encoding="utf-8") as file:
        file.write(script)
    done = subprocess.run([sys.argv[1], path], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0 or "Traceback" in done.stderr or "ERR|" in done.stderr:
        raise SystemExit(f"{name} failed:\n{script}\n{done.stderr}")
    for output in re.findall(r'"([\w-]+\.(?:png|exr|vtp))"', script):
        if os.path.getsize(os.path.join(folder, output)) < 1000:
            raise SystemExit(f"{name} wrote nothing to {output}")


assert not links.broken(ROOT), links.broken(ROOT)
with tempfile.TemporaryDirectory() as work:
    os.symlink(os.path.join(ROOT, "Data"), os.path.join(work, "Data"))
    for document, least in DOCUMENTS.items():
        found = scripts(document)
        assert len(found) >= least, f"{document} has {len(found)} scripts"
        for index, text in enumerate(found, start=1):
            run(f"Script {index} of {document}", text, work)
