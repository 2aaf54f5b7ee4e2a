#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs what pcl_gpf needs to be built and tested. Quick, and offline, when everything is there already.
#   tools/install_dependencies.sh            g++ and the libraries
#   tools/install_dependencies.sh --all      also clang with its sanitizers
#   tools/install_dependencies.sh --list     only print the names of the Debian packages
set -eu

packages="g++ cmake ninja-build pkg-config ccache libpcl-dev libeigen3-dev libflann-dev
libboost-program-options-dev libpng-dev libtbb-dev libhwy-dev nlohmann-json3-dev libgtest-dev libbenchmark-dev"

list_only=no
for argument in "$@"; do
  case "$argument" in
    --all) packages="$packages clang" ;;
    --list) list_only=yes ;;
    *) echo "usage: $0 [--all] [--list]" >&2; exit 2 ;;
  esac
done

if [ "$list_only" = yes ]; then
  printf '%s\n' $packages
  exit 0
fi

if ! command -v apt-get >/dev/null 2>&1; then
  cat >&2 <<'TEXT'
This is not Debian or Ubuntu. Please install with the package manager of this system:
  a C++17 compiler (g++ >= 12 or clang >= 14), CMake >= 3.25, Ninja, pkg-config,
  PCL >= 1.13, Eigen >= 3.3, FLANN, Boost.Program_options, libpng >= 1.6, oneTBB >= 2021,
  Google Highway >= 1.0, nlohmann-json >= 3.11, GoogleTest >= 1.12, Google Benchmark >= 1.7
and then run cmake --preset release.
TEXT
  exit 1
fi

missing=""
for package in $packages; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
if [ -z "$missing" ]; then
  exit 0
fi

run_as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "Please install as root:$missing" >&2
    exit 1
  fi
  run_as_root="sudo"
fi

echo "Installing:$missing" >&2
$run_as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q
$run_as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
