#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# tests/run.sh [PRESET [CTEST ARGUMENT...]]: installs what is missing (as root on Debian), configures, builds, tests.
# PRESET is one of CMakePresets.json, `release` unless told. From any folder:
#   bash tests/run.sh dev -R OffsetScore
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true

bash tests/install_packages.sh g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libgtest-dev libbenchmark-dev \
  libcli11-dev nlohmann-json3-dev libceres-dev python3-onnx < /dev/null

started=$SECONDS
finish() {
  local status=$?
  local outcome=passed
  [[ $status == 0 ]] || outcome=FAILED
  echo "tests/run.sh $preset: $outcome after $((SECONDS - started)) s"
}
trap finish EXIT

cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" "$@" -j2 --output-on-failure
