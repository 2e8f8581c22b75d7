#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# demo.sh [ARGUMENT...]: installs what is missing (as root on Debian), builds stillpoint_run, runs it on its synthetic
# scene and says where program and report are. Arguments go to stillpoint_run after --demo and --out: those of a run of the
# scene, such as --frames 60 or --policies paper; neither another input nor another --out. From any folder:
#   bash examples/demo.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/demo
program=$build/examples/stillpoint_run

bash "$root/tests/install_packages.sh" g++ cmake ninja-build libopencv-dev libeigen3-dev libyaml-cpp-dev libcli11-dev \
  nlohmann-json3-dev < /dev/null

# Without examples/slam, which takes as long to compile as the rest.
echo "Building stillpoint_run: a few minutes, the first time."
cmake -S "$root" -B "$build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_EXAMPLES=ON \
  -DSTILLPOINT_BUILD_TESTS=OFF -DSTILLPOINT_BUILD_BENCHMARKS=OFF -DSTILLPOINT_BUILD_DOCS=OFF \
  -DCMAKE_DISABLE_FIND_PACKAGE_Ceres="${STILLPOINT_DEMO_WITHOUT_SLAM:-ON}" \
  -DSTILLPOINT_WARNINGS_AS_ERRORS="${STILLPOINT_WARNINGS_AS_ERRORS:-OFF}" > /dev/null
cmake --build "$build" --target stillpoint_run

"$program" --demo --out "$build/report" "$@"

[[ -f $build/report/report.html ]] || exit 0  # --help, --version
cat << END

Program: $program
Report:  $build/report/report.html (open it in a browser)
Your own recording, in the layout of the TUM RGB-D benchmark (docs/first_steps.md):
  $program --tum FOLDER --out OUT
END
