#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# plain_include.sh COMPILER STANDARD: project/ as a host without CMake compiles it, with -I: no header is a system header
# there, and none may draw a warning that the host has asked for. One file of all sources, as they share most of the
# headers (-Wno-return-type: each `main` goes by another name there), another of what takes the compiled pipeline; the
# shim's alone, in C++11 as well. EIGEN_INCLUDE and OPENCV_INCLUDE: where those are, if not where Debian has them;
# ONNXRUNTIME_INCLUDE: a folder, or what needs it is left out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
compiler=$1
flags=(-fsyntax-only -O1 -Wall -Wextra -Wno-return-type -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Werror
  -Iinclude -Ishim/include -I. -isystem "${EIGEN_INCLUDE:-/usr/include/eigen3}"
  -isystem "${OPENCV_INCLUDE:-/usr/include/opencv4}" -x c++ -)
if "$compiler" -Werror -Wuseless-cast -fsyntax-only -x c++ - <<< 'int i;' 2> /dev/null; then
  flags=(-Wuseless-cast "${flags[@]}")
fi

# one_file SOURCE...: all of these as one.
one_file() {
  local source
  for source in "$@"; do
    printf '#define main %s_main\n#include "tests/consumers/project/%s.cpp"\n#undef main\n' "$source" "$source"
    printf 'int %s_main();\n' "$source"
  done
}

sources=(core_only with_opencv with_options with_movers with_files with_stereo with_adapters)
[[ ! -e ${OPENCV_INCLUDE:-/usr/include/opencv4}/opencv2/dnn.hpp ]] || sources+=(with_detector)
if [[ -n ${ONNXRUNTIME_INCLUDE:-} ]]; then
  sources+=(with_onnxruntime)
  flags=(-isystem "$ONNXRUNTIME_INCLUDE" "${flags[@]}")
fi
{
  one_file "${sources[@]}"
  # What each of a host's keypoint types draws in.
  echo '#include <opencv2/core/types.hpp>'
  for keypoint in cv::KeyPoint cv::Point2f cv::Point2d stillpoint::Vector2f stillpoint::Vector2d; do
    printf 'template stillpoint::span<const stillpoint::Vector2f> stillpoint::read_pixels(const std::vector<%s>&, %s);\n' \
      "$keypoint" 'std::vector<stillpoint::Vector2f>&'
  done
  # What no source above calls of the filter, or of its policies.
  for policies in 'WithMovers<DefaultPolicies>' MonocularPolicies; do
    printf 'namespace stillpoint { template class FrameFilter<%s>; }\n' "$policies"
  done
} | "$compiler" "-std=$2" "${flags[@]}"
one_file with_compiled with_movers | "$compiler" "-std=$2" -DSTILLPOINT_COMPILED "${flags[@]}"
"$compiler" "-std=$2" "${flags[@]}" <<< '#include <stillpoint_shim.hpp>'
one_file with_shim | "$compiler" -std=c++11 "${flags[@]}"
echo "$compiler -std=$2: no warning"
