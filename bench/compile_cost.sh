#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# compile_cost.sh [REPETITIONS [COMPILER]]: what a file of a host takes to compile, by what it includes: processor seconds
# (user and system) of COMPILER (g++) with -O2, and peak memory. Each is the least of REPETITIONS (5); the cases run in
# turn, so that all meet the same machine. The ratio is to a file that includes Eigen/Core and opencv2/core.hpp.
# EIGEN_INCLUDE and OPENCV_INCLUDE say where the headers are, if not where Debian has them. Needs GNU time (Debian: time).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
repetitions=${1:-5}
compiler=${2:-g++}
[[ -x /usr/bin/time ]] || { echo 'GNU time is missing (Debian: time)' >&2; exit 1; }
flags=(-O2 -Iinclude -Ishim/include -isystem "${EIGEN_INCLUDE:-/usr/include/eigen3}"
  -isystem "${OPENCV_INCLUDE:-/usr/include/opencv4}")
filter='#include <stillpoint/stillpoint.hpp>
const stillpoint::FrameResult& judge(stillpoint::FrameFilter<>& filter, const stillpoint::FrameView& frame,
                                     std::vector<cv::KeyPoint>& keypoints) {
  const stillpoint::FrameResult& result = filter.filter_frame(frame, keypoints);
  stillpoint::compact(result.keep(), keypoints);
  return result;
}'
shim='#include <stillpoint_shim.hpp>
const stillpoint_shim::Result& judge(stillpoint_shim::Filter& filter, const cv::Mat& image, const cv::Mat& depth,
                                     const std::vector<cv::KeyPoint>& keypoints) {
  return filter.filter_frame(image, depth, 1.0, keypoints);
}'

# Name, flags, source. The first is what the others are compared with.
cases=(
  'Eigen/Core and opencv2/core.hpp' -std=c++17 $'#include <Eigen/Core>\n#include <opencv2/core.hpp>'
  'stillpoint/core.hpp' -std=c++17 '#include <stillpoint/core.hpp>'
  'stillpoint/stillpoint.hpp' -std=c++17 '#include <stillpoint/stillpoint.hpp>'
  'header-only: FrameFilter<> called' -std=c++17 "$filter"
  'compiled: FrameFilter<> called' '-std=c++17 -DSTILLPOINT_COMPILED' "$filter"
  'shim, C++11, called' -std=c++11 "$shim"
)

# measure FLAGS SOURCE: user seconds, system seconds and peak kilobytes of one compilation.
measure() {
  # shellcheck disable=SC2086  # flags are several words
  /usr/bin/time -q -f '%U %S %M' -o "$measured" "$compiler" $1 "${flags[@]}" -x c++ -c -o /dev/null - <<< "$2" || return 1
  cat "$measured"
}
measured=$(mktemp)
trap 'rm -f "$measured"' EXIT

for ((round = 0; round < repetitions; ++round)); do
  for ((i = 0; i < ${#cases[@]}; i += 3)); do
    numbers=$(measure "${cases[i + 1]}" "${cases[i + 2]}") || { echo "${cases[i]}: does not compile" >&2; exit 1; }
    printf '%s\t%s\n' $((i / 3)) "$numbers"
  done
done |
  LC_ALL=C awk -F '\t' -v names="$(for ((i = 0; i < ${#cases[@]}; i += 3)); do printf '%s\t' "${cases[i]}"; done)" \
    -v compiler="$("$compiler" --version | head -n 1)" -v repetitions="$repetitions" '
    {
      split($2, measured, " ")
      seconds = measured[1] + measured[2]
      megabytes = measured[3] / 1000
      if (!($1 in best) || seconds < best[$1]) best[$1] = seconds
      if (!($1 in peak) || megabytes < peak[$1]) peak[$1] = megabytes
    }
    END {
      printf "# %s, -O2, least of %d\n%-34s %9s %7s %9s\n", compiler, repetitions, "included", "seconds", "ratio", "peak_MB"
      split(names, name, "\t")
      for (i = 0; i in best; ++i) printf "%-34s %9.2f %7.2f %9.0f\n", name[i + 1], best[i], best[i] / best[0], peak[i]
    }'
