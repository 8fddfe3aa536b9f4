#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and runs tests with sanitizers: what Testing/run.sh --sanitizers does after its own tests. Arguments choose
# among asan (address and undefined behaviour, with the fuzz targets) and tsan (threads); none: both.
# With --all every test of the core runs, not only those that are done in minutes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# Statistics need many samples, and find no more with a sanitizer than a few of them do; nor do a
# thousand bakes. Which allocations are the project's own is told by the return address, which the
# address sanitizer hides: those of VTK would fail too, which it does not survive. With the thread
# sanitizer one test of each estimator is enough beside the frames, and nothing takes a second only.
declare -A long_tests=(
  [asan]='AgreesWith|Promise|HasNoBias|IsAsGoodAs|Pilot|RefinesAs|TargetError|WithATarget|Independent|Thousand|AbortsLeave|EveryAllocation'
  [tsan]='AgreesWith|Promise|HasNoBias|IsAsGoodAs|Pilot|RefinesAs|TargetError|WithATarget|Independent|AHundredAtRandomMoments.*Embree|EmbreeEstimator.*(SameBits|Closed)'
)
presets=()
for argument in "$@"; do
  case $argument in
    --all) long_tests=([asan]='^$' [tsan]='^$') ;;
    asan | tsan) presets+=("$argument") ;;
    *)
      echo "usage: $0 [--all] [asan] [tsan]" >&2
      exit 1
      ;;
  esac
done
((${#presets[@]})) || presets=(asan tsan)

declare -A tests=([asan]='^(Core|Faults|Fuzz)\.' [tsan]='^Threads\.')

cd "$source_dir"
for preset in "${presets[@]}"; do
  configure_and_build "$preset"
  ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
    TSAN_OPTIONS="suppressions=$source_dir/Testing/Sanitizers/thread-suppressions.txt:halt_on_error=1" \
    ctest --preset "$preset" --parallel "$(nproc)" -R "${tests[$preset]}" -E "${long_tests[$preset]}"
done
