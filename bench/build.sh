#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/build.sh TARGET: installs what is missing (as root on Debian) and builds a program of bench/ in Release, in
# build/ratios. All it says goes to standard error: standard output is that of the program which runs next.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
target=${1:?usage: bench/build.sh TARGET}

bash tests/install_packages.sh g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libbenchmark-dev \
  libcli11-dev < /dev/null >&2
cmake -S . -B build/ratios -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_TESTS=OFF \
  -DSTILLPOINT_BUILD_EXAMPLES=OFF > /dev/null
cmake --build build/ratios --target "$target" >&2
