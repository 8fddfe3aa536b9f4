#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Set-up shared by Testing/run.sh, Testing/sanitizers.sh and Data/demo.sh: installs the system packages
# that are missing (Testing/packages.txt), configures and builds with the preset `default` into build/
# or, of Testing/sanitizers.sh, with presets of its own (configure_and_build PRESET).
# What apt, CMake and the compiler say goes to build/setup.log; its end is shown if they fail.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
log=$source_dir/build/setup.log

# Compilers and libraries of the system only: an activated conda, pyenv or virtual environment would
# give CMake another Python and other libraries than those that ParaView was built with.
use_system_tools() {
  export PATH=/usr/local/sbin:/usr/sbin:/sbin:/usr/bin:/bin:/usr/games
  unset PYTHONPATH PYTHONHOME VIRTUAL_ENV CONDA_PREFIX CMAKE_PREFIX_PATH CC CXX CFLAGS CXXFLAGS \
    LDFLAGS LD_LIBRARY_PATH
}

# run WHAT COMMAND...: runs a command with its output in the log.
run() {
  local what=$1
  shift
  echo "== $what" >>"$log"
  if ! "$@" >>"$log" 2>&1; then
    {
      tail -n 40 "$log"
      echo "Set-up failed: $what. The whole log is in $log"
    } >&2
    exit 1
  fi
}

missing_packages() {
  comm -23 \
    <(sed 's/#.*//' "$source_dir/Testing/packages.txt" | awk 'NF { print $1 }' | sort) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort)
}

install_packages() {
  if ! command -v apt-get dpkg-query >/dev/null; then
    echo "This is not a Debian-like system, so nothing was installed: continuing with what is here." \
      "If the build fails, install what corresponds to the Debian packages in Testing/packages.txt." >&2
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages)
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "Neither root nor sudo: have these packages installed, then run this again:" >&2
      echo "  ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} system packages (with their dependencies up to 600 MB to download) ..."
  run "apt-get update" "${as_root[@]}" apt-get update
  run "apt-get install" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends -o DPkg::Lock::Timeout=300 "${missing[@]}"
}

# configure_and_build PRESET: `default` is in build/, others in build-PRESET/. Ninja configures again by
# itself when a CMake file has changed.
configure_and_build() {
  local preset=$1 folder=build
  [[ $preset == default ]] || folder=build-$preset
  cd "$source_dir"
  if [[ ! -f $folder/build.ninja || CMakePresets.json -nt $folder/build.ninja ]]; then
    echo "Configuring $preset ..."
    run "cmake --preset $preset" cmake --preset "$preset"
  fi
  echo "Building $preset ..."
  run "cmake --build --preset $preset" cmake --build --preset "$preset" --parallel "$(nproc)"
}

use_system_tools
mkdir -p "$source_dir/build"
: >"$log"
install_packages
