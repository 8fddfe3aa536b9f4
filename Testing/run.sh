#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up, builds and runs all tests on a virtual display, then those with sanitizers
# (Testing/sanitizers.sh). Arguments go to ctest (-R NAME, ...); with any there are no sanitizers.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
configure_and_build default

cd "$source_dir"
# Without -noreset the X server restarts whenever its last client leaves, and the next one may fail.
xvfb-run -a -s "-noreset -screen 0 1280x1024x24" \
  ctest --preset default --parallel "$(nproc)" "$@"
(($#)) || exec bash Testing/sanitizers.sh
