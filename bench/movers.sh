#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/movers.sh [NAME...]: movers against the true poses of objects: share of frames in which each is found, switches
# of its identifier, error of its pose carried over a second, of its speed, relative pose error, share of the filter's
# time. NAMEs are kitchen sequences of ../shared/data or synthetic scenes, NAME+boxes the same with a detector's boxes;
# without any, those of docs/movers.md. Prints one table in Markdown. About four minutes.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

bash "$root/tests/install_packages.sh" g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libbenchmark-dev \
  libcli11-dev < /dev/null >&2

cmake -S "$root" -B "$root/build/ratios" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_TESTS=OFF \
  -DSTILLPOINT_BUILD_EXAMPLES=OFF > /dev/null
cmake --build "$root/build/ratios" --target stillpoint_movers >&2
"$root/build/ratios/bench/stillpoint_movers" "$@"
