#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Sets up, builds and runs all tests on a virtual display. Arguments go to ctest (-R NAME, ...).
# With --sanitizers as the first one, the tests of Testing/sanitizers.sh follow.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
configure_and_build default

sanitizers=false
if [[ ${1-} == --sanitizers ]]; then
  sanitizers=true
  shift
fi
cd "$source_dir"
# Without -noreset the X server restarts whenever its last client leaves, and the next one may fail.
xvfb-run -a -s "-noreset -screen 0 1280x1024x24" \
  ctest --preset default --parallel "$(nproc)" "$@"
if $sanitizers; then
  bash Testing/sanitizers.sh
fi
