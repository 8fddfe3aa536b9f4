#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian package into a clean Debian 12 and uses it there as a user would: no environment variable, no
# build, nothing but the package and what it depends on. By hand, since it downloads some 400 MB:
#
#   bash Testing/package.sh [PACKAGE.deb]
#
# Without an argument the package is made from build/. Needs mmdebstrap and root, or user namespaces; MIRROR names
# another mirror of Debian. The system is thrown away afterwards.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if (($#)); then
  cp "$1" "$work/package.deb"
else
  (cd build && cpack -G DEB -B "$work/packages" >"$work/cpack.log") || { cat "$work/cpack.log" >&2; exit 1; }
  cp "$work"/packages/*.deb "$work/package.deb"
fi

cat >"$work/bake.py" <<'PYTHON'
from paraview.simple import *
from paraview.modules.vtkRemotingCore import vtkPVPluginTracker

tracker = vtkPVPluginTracker.GetInstance()
loaded = {tracker.GetPluginName(i): tracker.GetPluginLoaded(i) for i in range(tracker.GetNumberOfPlugins())}
assert loaded.get("ParticleOcclusion"), loaded
baked = SphereAmbientOcclusion(Input=OpenDataFile("/usr/share/paraview-5.11/examples/ParticleOcclusion/heap.vtp"))
assert Show(baked).Representation == "Ray-Traced Spheres"
ResetCamera()
SaveScreenshot("/tmp/heap.png", ImageResolution=[400, 300])
baked.UpdatePropertyInformation()
print(baked.GetPropertyValue("NumberOfParticles"), "particles baked by", baked.GetPropertyValue("MethodUsed"))
PYTHON

cat >"$work/check.sh" <<'SHELL'
set -e
examples=/usr/share/paraview-5.11/examples/ParticleOcclusion
screen() { xvfb-run -a -s "-noreset -screen 0 1280x1024x24" "$@"; }
for program in pvpython pvbatch; do
  echo "== $program"
  rm -f /tmp/heap.png
  screen $program /tmp/bake.py
  test "$(stat -c %s /tmp/heap.png)" -gt 10000
done
echo "== python3"
screen python3 $examples/Examples/plain_vtk.py $examples/molecule.vtp /tmp/molecule.png
test "$(stat -c %s /tmp/molecule.png)" -gt 10000
echo "== an example script"
screen pvpython $examples/Examples/figure.py $examples/heap.vtp /tmp/figure --size 320 180 --error 0.05
test "$(stat -c %s /tmp/figure.exr)" -gt 10000
echo "== removed"
apt-get purge --yes particleocclusion >/dev/null
test ! -e /usr/bin/paraview.conf
! screen pvpython /tmp/bake.py 2>/dev/null
echo "The package works in a clean system."
SHELL

mmdebstrap --variant=minbase --format=null \
  --customize-hook="cp '$work/package.deb' '$work/bake.py' '$work/check.sh' \"\$1/tmp/\"" \
  --customize-hook='chroot "$1" apt-get install --yes --no-install-recommends /tmp/package.deb \
    python3-paraview xvfb xauth libgl1-mesa-dri >/dev/null' \
  --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root bash /tmp/check.sh' \
  bookworm /dev/null ${MIRROR:+"$MIRROR"}
