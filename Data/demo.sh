#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up, builds and runs the demo (Data/demo.py) without a screen: bakes, ray-traces and outlines
# shipped particle data into demo-output/.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../Testing/setup.sh"
configure_and_build default

cd "$source_dir"
results=({direct,ambient-occlusion,combined,silhouettes}.png layers.exr baked.vtp state.pvsm)
rm -rf demo-output
mkdir demo-output
# Without -noreset the X server restarts whenever its last client leaves, and the next one may fail.
xvfb-run -a -s "-noreset -screen 0 1280x1024x24" pvpython Data/demo.py

for result in "${results[@]}"; do
  if [[ ! -s demo-output/$result ]]; then
    echo "The demo failed: demo-output/$result was not written." >&2
    exit 1
  fi
done
echo "Results are in $source_dir/demo-output"
