#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/build.sh TARGET...: installs what is missing (as root on Debian) and builds programs of bench/ and examples/ in
# Release, in build/ratios. All it says goes to standard error: standard output is that of the program which runs next.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
(($# > 0)) || { echo 'usage: bench/build.sh TARGET...' >&2; exit 2; }

bash tests/install_packages.sh g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libbenchmark-dev \
  libcli11-dev nlohmann-json3-dev < /dev/null >&2
cmake -S . -B build/ratios -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_TESTS=OFF \
  -DSTILLPOINT_BUILD_EXAMPLES=ON -DSTILLPOINT_BUILD_BENCHMARKS=ON > /dev/null
cmake --build build/ratios --target "$@" >&2
