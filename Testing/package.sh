#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian package into a clean Debian 12 and uses it there as a user would: no environment variable, no
# build, nothing but the package and what it depends on. Then removes it, unpacks the archive somewhere, moves it, and
# uses that. By hand, since it downloads some 400 MB:
#
#   bash Testing/package.sh
#
# Package and archive are made from build/. Needs mmdebstrap and root, or user namespaces; MIRROR names
# another mirror of Debian. The system is thrown away afterwards.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for kind in DEB TGZ; do
  (cd build && cpack -G $kind -B "$work/$kind" >"$work/cpack.log") || { cat "$work/cpack.log" >&2; exit 1; }
done
mv "$work"/DEB/*.deb "$work/package.deb"
mv "$work"/TGZ/*.tar.gz "$work/archive.tar.gz"

cat >"$work/bake.py" <<'PYTHON'
import os

from paraview.simple import *
from paraview.modules.vtkRemotingCore import vtkPVPluginTracker

tracker = vtkPVPluginTracker.GetInstance()
loaded = {tracker.GetPluginName(i): tracker.GetPluginLoaded(i) for i in range(tracker.GetNumberOfPlugins())}
assert loaded.get("ParticleOcclusion"), loaded
baked = SphereAmbientOcclusion(Input=OpenDataFile(os.environ["EXAMPLES"] + "/heap.vtp"))
assert Show(baked).Representation == "Ray-Traced Spheres"
ResetCamera()
SaveScreenshot("/tmp/heap.png", ImageResolution=[400, 300])
baked.UpdatePropertyInformation()
print(baked.GetPropertyValue("NumberOfParticles"), "particles baked by", baked.GetPropertyValue("MethodUsed"))
PYTHON

cat >"$work/check.sh" <<'SHELL'
set -e
export EXAMPLES=/usr/share/paraview-5.11/examples/ParticleOcclusion
screen() { xvfb-run -a -s "-noreset -screen 0 1280x1024x24" "$@"; }
for program in pvpython pvbatch; do
  echo "== $program"
  rm -f /tmp/heap.png
  screen $program /tmp/bake.py
  test "$(stat -c %s /tmp/heap.png)" -gt 10000
done
echo "== python3"
screen python3 $EXAMPLES/Examples/plain_vtk.py $EXAMPLES/molecule.vtp /tmp/molecule.png
test "$(stat -c %s /tmp/molecule.png)" -gt 10000
echo "== an example script"
screen pvpython $EXAMPLES/Examples/figure.py $EXAMPLES/heap.vtp /tmp/figure --size 320 180 --error 0.05
test "$(stat -c %s /tmp/figure.exr)" -gt 10000
echo "== removed"
apt-get purge --yes particleocclusion >/dev/null
test ! -e /usr/bin/paraview.conf
if screen pvpython /tmp/bake.py 2>/dev/null; then
  echo "The plugin is loaded though its package is gone." >&2
  exit 1
fi
echo "== the archive, unpacked and moved"
mkdir /tmp/unpacked
tar -xzf /tmp/archive.tar.gz -C /tmp/unpacked
mv /tmp/unpacked/* /opt/particles
rm -f /tmp/heap.png
plugins=$(dirname "$(find /opt/particles -name ParticleOcclusion.plugins.xml)")
EXAMPLES=/opt/particles/share/paraview-5.11/examples/ParticleOcclusion PV_PLUGIN_PATH=$plugins screen pvpython /tmp/bake.py
test "$(stat -c %s /tmp/heap.png)" -gt 10000
PYTHONPATH=/opt/particles/lib/python3/dist-packages screen python3 \
  /opt/particles/share/paraview-5.11/examples/ParticleOcclusion/Examples/plain_vtk.py \
  /opt/particles/share/paraview-5.11/examples/ParticleOcclusion/molecule.vtp /tmp/molecule2.png
cmp /tmp/molecule.png /tmp/molecule2.png
echo "Package and archive work in a clean system."
SHELL

mmdebstrap --variant=minbase --format=null \
  --customize-hook="cp '$work/package.deb' '$work/archive.tar.gz' '$work/bake.py' '$work/check.sh' \"\$1/tmp/\"" \
  --customize-hook='chroot "$1" apt-get install --yes --no-install-recommends /tmp/package.deb \
    python3-paraview xvfb xauth libgl1-mesa-dri >/dev/null' \
  --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root bash /tmp/check.sh' \
  bookworm /dev/null ${MIRROR:+"$MIRROR"}
