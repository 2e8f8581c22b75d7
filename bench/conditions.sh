#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/conditions.sh [FOLDER...] [OPTION...]: recall, false-positive rate, error of the filter's own motion and of a
# tracker behind it under each condition of bench/degradations.hpp. FOLDERs are labelled recordings in the layout of the
# TUM benchmark, unless told the kitchen sequences of ../shared/data; `bench/conditions.sh --help` lists the options.
# Prints one table in Markdown. Without options about half an hour on two free cores.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

bash "$root/tests/install_packages.sh" g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libbenchmark-dev \
  libcli11-dev < /dev/null >&2

cmake -S "$root" -B "$root/build/ratios" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_TESTS=OFF \
  -DSTILLPOINT_BUILD_EXAMPLES=OFF > /dev/null
cmake --build "$root/build/ratios" --target stillpoint_conditions >&2
"$root/build/ratios/bench/stillpoint_conditions" "$@"
