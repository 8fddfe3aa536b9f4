# SPDX-License-Identifier: BSD-3-Clause
"""What is installed and packed works elsewhere than where it was built: the plugin in ParaView, the Python package,
and the CMake package in a program of its own. Testing/package.sh installs the Debian package into a clean system.

Usage: pvpython test_package.py PVPYTHON CMAKE CPACK BUILD_FOLDER
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

import links

PVPYTHON, CMAKE, CPACK, BUILD = sys.argv[1:5]
ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PLUGIN = "paraview-5.11/plugins/ParticleOcclusion"

BAKE = """
import os
from paraview.simple import *
baked = SphereAmbientOcclusion(Input=OpenDataFile(os.environ["EXAMPLES"] + "/molecule.vtp"), TextureResolution=4)
display = Show(baked)
assert display.Representation == "Ray-Traced Spheres", display.Representation
SaveScreenshot("picture.png", ImageResolution=[100, 100])
baked.UpdatePropertyInformation()
assert baked.GetPropertyValue("NumberOfParticles") == 3341
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "ParticleOcclusion" in line}
assert len(loaded) == 4 and all(path.startswith(os.environ["PREFIX"]) for path in loaded), loaded
"""

CLASSES = """
import os
from particleocclusion import vtkRayTracedSphereMapper, vtkSphereAmbientOcclusion
assert vtkSphereAmbientOcclusion().GetTextureResolution() == 16
assert "AmbientOcclusionTextures" in vtkSphereAmbientOcclusion.__doc__
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "ParticleOcclusion" in line}
assert len(loaded) == 4 and all(path.startswith(os.environ["PREFIX"]) for path in loaded), loaded
"""


def run(*command, **environment):
    """Runs a command in a folder of its own, with the environment of a user who has no build."""
    own = {name: value for name, value in os.environ.items() if not name.startswith(("PARTICLEOCCLUSION_", "PYTHONPATH"))}
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False,
                              env={**own, **environment})
    if done.returncode != 0 or "Traceback" in done.stderr or "ERR|" in done.stderr:
        raise SystemExit(f"{' '.join(command)} failed ({done.returncode}):\n{done.stdout}\n{done.stderr}")
    return done.stdout


def run_python(script, prefix, **environment):
    with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
        file.write(script)
        file.flush()
        run(PVPYTHON, file.name, PREFIX=prefix, EXAMPLES=f"{prefix}/share/paraview-5.11/examples/ParticleOcclusion",
            **environment)


def check_prefix(prefix):
    """ParaView's two ways to name a plugin, and Python's to name a package."""
    library = os.path.dirname(os.path.dirname(glob.glob(f"{prefix}/lib*/**/{PLUGIN}", recursive=True)[0]))
    run_python(BAKE, prefix, PV_PLUGIN_PATH=f"{library}/plugins")
    run_python(BAKE, prefix, PV_PLUGIN_CONFIG_FILE=f"{library}/plugins/ParticleOcclusion.plugins.xml")
    run_python(CLASSES, prefix, PYTHONPATH=f"{prefix}/lib/python3/dist-packages")


def check_no_trace_of_build(prefix):
    """No library or CMake file names the folder that it was built in."""
    for path in glob.glob(f"{prefix}/lib*/**/*", recursive=True):
        if os.path.isfile(path) and path.endswith((".so", ".cmake", ".xml", ".py")):
            with open(path, "rb") as file:
                assert BUILD.encode() not in file.read(), f"{path} names {BUILD}"


def check_program(prefix, folder):
    """The example for plain VTK, built against what is installed, with no tree of the project."""
    run(CMAKE, "-S", f"{prefix}/share/paraview-5.11/examples/ParticleOcclusion/Examples", "-B", f"{folder}/program",
        f"-DCMAKE_PREFIX_PATH={prefix}")
    run(CMAKE, "--build", f"{folder}/program")
    picture = os.path.join(folder, "program.png")
    run(f"{folder}/program/PlainVTK", f"{prefix}/share/paraview-5.11/examples/ParticleOcclusion/heap.vtp", picture)
    assert os.path.getsize(picture) > 10000


def check_documents(prefix):
    """The README with all that it leads to; no archive, and nothing empty."""
    assert os.path.exists(f"{prefix}/share/doc/particleocclusion/README.md")
    assert not links.broken(prefix), links.broken(prefix)
    strangers = [path for path, folders, files in os.walk(prefix) if not folders and not files]
    strangers += glob.glob(f"{prefix}/**/*.a", recursive=True)
    assert not strangers, strangers


def version():
    with open(f"{BUILD}/CMakeCache.txt", encoding="utf-8") as cache:
        return re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.*)$", cache.read(), re.MULTILINE).group(1)


def check_version():
    """What names the version by hand names that of the build."""
    for path, pattern, named in (("CITATION.cff", r"^version: (.*)$", version()),
                                 ("CHANGELOG.md", r"^## ([\d.]+)", version()),
                                 ("Data/Examples/CMakeLists.txt", r"find_package\(ParticleOcclusion ([\d.]+)",
                                  version().rpartition(".")[0])):
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            found = re.search(pattern, file.read(), re.MULTILINE).group(1)
        assert found == named, f"{path} names the version {found} in place of {named}"


def pack(kind, folder):
    run(CPACK, "-G", kind, "--config", f"{BUILD}/CPackConfig.cmake", "-B", folder)
    return glob.glob(f"{folder}/particleocclusion[-_]*")[0]


def check_archive(folder):
    with tarfile.open(pack("TGZ", f"{folder}/archive")) as archive:
        archive.extractall(f"{folder}/elsewhere")
    check_prefix(glob.glob(f"{folder}/elsewhere/*")[0])


def check_debian_package(folder):
    """Its dependencies, and that the file which ParaView reads leads to the plugin."""
    package = pack("DEB", f"{folder}/debian")
    root = f"{folder}/root"
    run("dpkg-deb", "-x", package, root)
    depends = run("dpkg-deb", "-f", package, "Depends")
    for name in ("paraview (>= 5.11", "paraview (<< 5.1", "libembree", "libtbb", "libopenexr"):
        assert name in depends, depends
    assert run("dpkg-deb", "-f", package, "Version").strip() == version()
    with open(f"{root}/usr/bin/paraview.conf", encoding="utf-8") as file:
        listed = os.path.join(f"{root}/usr/bin", file.read().strip())
    with open(listed, encoding="utf-8") as file:
        assert re.search('name="ParticleOcclusion" auto_load="1"', file.read())
    run_python(BAKE, f"{root}/usr", PV_PLUGIN_CONFIG_FILE=listed)
    strangers = [path for path in glob.glob(f"{root}/**/*", recursive=True) if re.search(r"\.a$|\.o$|/Testing/.*\.(cxx|h|py|sh)$", path)]
    assert not strangers, strangers


def main():
    # A path without links: what the system says of loaded libraries is compared with it.
    folder = os.path.realpath(tempfile.mkdtemp(prefix="particleocclusion-package-"))
    try:
        run(CMAKE, "--install", BUILD, "--prefix", f"{folder}/prefix")
        check_no_trace_of_build(f"{folder}/prefix")
        assert not os.path.exists(f"{folder}/prefix/bin/paraview.conf")
        check_documents(f"{folder}/prefix")
        check_version()
        check_prefix(f"{folder}/prefix")
        check_program(f"{folder}/prefix", folder)
        check_archive(folder)
        if shutil.which("dpkg-shlibdeps"):
            check_debian_package(folder)
    finally:
        shutil.rmtree(folder)


main()
