#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# compile_cost.sh [REPETITIONS [COMPILER]]: what a file of a host takes to compile, by what it includes: processor seconds
# of COMPILER (g++) with -O2, the best of REPETITIONS (5), and how much that is above Eigen/Core. The cases run in turn, so
# that all meet the same machine. EIGEN_INCLUDE and OPENCV_INCLUDE say where the headers are, if not where Debian has them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
repetitions=${1:-5}
compiler=${2:-g++}
flags=(-O2 -Iinclude -Ishim/include -isystem "${EIGEN_INCLUDE:-/usr/include/eigen3}"
  -isystem "${OPENCV_INCLUDE:-/usr/include/opencv4}")
filter='#include <stillpoint/stillpoint.hpp>
const stillpoint::FrameResult& judge(stillpoint::FrameFilter<>& filter, const stillpoint::FrameView& frame,
                                     const std::vector<stillpoint::Vector2f>& keypoints) {
  return filter.filter_frame(frame, keypoints);
}'
shim='#include <stillpoint_shim.hpp>
const stillpoint_shim::Result& judge(stillpoint_shim::Filter& filter, const cv::Mat& image, const cv::Mat& depth,
                                     const std::vector<cv::KeyPoint>& keypoints) {
  return filter.filter_frame(image, depth, 1.0, keypoints);
}'

# Name, standard, source.
cases=(
  'Eigen/Core' c++17 '#include <Eigen/Core>'
  'opencv2/core.hpp' c++17 '#include <opencv2/core.hpp>'
  'stillpoint/core.hpp' c++17 '#include <stillpoint/core.hpp>'
  'stillpoint/filter_frame.hpp' c++17 '#include <stillpoint/filter_frame.hpp>'
  'stillpoint/stillpoint.hpp' c++17 '#include <stillpoint/stillpoint.hpp>'
  'the same, FrameFilter<> called' c++17 "$filter"
  'stillpoint_shim.hpp, C++11, called' c++11 "$shim"
)

# seconds STANDARD SOURCE: processor time of one compilation.
seconds() {
  local TIMEFORMAT=%U
  { time "$compiler" "-std=$1" "${flags[@]}" -x c++ -c -o /dev/null - <<< "$2" >&2; } 2>&1
}

declare -A best
for ((round = 0; round < repetitions; ++round)); do
  for ((i = 0; i < ${#cases[@]}; i += 3)); do
    taken=$(seconds "${cases[i + 1]}" "${cases[i + 2]}")
    best[$i]=$(printf '%s\n' "$taken" ${best[$i]:-} | LC_ALL=C sort -n | head -n 1)
  done
done

printf '# %s, -O2, best of %s\n%-36s %9s %9s\n' "$("$compiler" --version | head -n 1)" "$repetitions" included seconds more
for ((i = 0; i < ${#cases[@]}; i += 3)); do
  LC_ALL=C awk -v name="${cases[i]}" -v s="${best[$i]}" -v base="${best[0]}" \
    'BEGIN { printf "%-36s %9.2f %9.2f\n", name, s, s - base }'
done
