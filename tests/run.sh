#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# tests/run.sh [PRESET [CTEST ARGUMENT...]]: installs what is missing (as root on Debian), configures, builds, tests.
# PRESET is one of CMakePresets.json, `release` unless told. From any folder:
#   bash tests/run.sh dev -R OffsetScore
# STILLPOINT_ONNXRUNTIME_ROOT: a folder with ONNX Runtime, as tests/fetch_onnxruntime.sh makes it; set, its detector is
# built and tested, too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true

bash tests/install_packages.sh g++ cmake make ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libgtest-dev libbenchmark-dev \
  libceres-dev libcli11-dev nlohmann-json3-dev python3-onnx doxygen chromium python3-dev python3-venv python3-pip \
  python3-setuptools python3-wheel python3-pybind11 python3-numpy python3-opencv python3-pytest < /dev/null

# ROS 1 is packaged by Debian 12 and Ubuntu 24.04, and not everywhere: where it is not, ros/ is built without it.
ros_packages=(libroscpp-dev libsensor-msgs-dev libdiagnostic-msgs-dev libvisualization-msgs-dev librosbag-storage-dev python3-roslaunch)
ros=AUTO
if command -v apt-cache > /dev/null && apt-cache show "${ros_packages[@]}" > /dev/null 2>&1 &&
  bash tests/install_packages.sh "${ros_packages[@]}" < /dev/null; then
  ros=ON
else
  echo 'ROS 1 was not found or not installed: the tests of ros/ that need it are skipped'
fi

started=$SECONDS
finish() {
  local status=$?
  local outcome=passed
  [[ $status == 0 ]] || outcome=FAILED
  echo "tests/run.sh $preset: $outcome after $((SECONDS - started)) s"
}
trap finish EXIT

options=("-DSTILLPOINT_BUILD_ROS=$ros")
if [[ -n ${STILLPOINT_ONNXRUNTIME_ROOT:-} ]]; then
  options+=(-DSTILLPOINT_ONNXRUNTIME=ON "-DONNXRUNTIME_ROOT=$STILLPOINT_ONNXRUNTIME_ROOT")
else
  echo 'STILLPOINT_ONNXRUNTIME_ROOT is not set: the tests of the detector on ONNX Runtime are skipped'
fi

cmake --preset "$preset" "${options[@]}"
cmake --build --preset "$preset"
ctest --preset "$preset" "$@" -j2 --output-on-failure
