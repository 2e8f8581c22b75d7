#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# opencv_components.sh PROJECT: each target links those components of OpenCV that its headers include, and no others. What
# it links is in cmake/StillpointDependencies.cmake.
set -euo pipefail
cd "$1"

# linked NAME...: the components in the lists of these names.
linked() {
  local name
  for name in "$@"; do
    sed -nE "s/^set\($name (.*)\)$/\1/p" cmake/StillpointDependencies.cmake | tr ' ' '\n'
  done | LC_ALL=C sort -u
}

# included FOLDER...: the components that headers in these include.
included() {
  grep -rhoE --include='*.hpp' '#include <opencv2/[a-z0-9]+' "$@" | sed 's|.*/||' | LC_ALL=C sort -u
}

status=0
# compare TARGET MISSING NEEDLESS
compare() {
  [[ -z $2 ]] || { echo "$1: headers include what it does not link:" $2; status=1; }
  [[ -z $3 ]] || { echo "$1: links what no header includes:" $3; status=1; }
}

cd include/stillpoint
mapfile -t rooms < <(find . -mindepth 1 -maxdepth 1 ! -name io ! -name detectors ! -name '.*')
cd ../..
main_linked=$(linked STILLPOINT_OPENCV_COMPONENTS)
main_included=$(cd include/stillpoint && included "${rooms[@]}")
compare stillpoint::stillpoint "$(LC_ALL=C comm -13 <(echo "$main_linked") <(echo "$main_included"))" \
  "$(LC_ALL=C comm -23 <(echo "$main_linked") <(echo "$main_included"))"
# These link stillpoint::stillpoint as well.
for pair in io:STILLPOINT_IO_OPENCV_COMPONENTS detectors:STILLPOINT_DNN_OPENCV_COMPONENTS; do
  own_linked=$(linked "${pair#*:}")
  own_included=$(included "include/stillpoint/${pair%%:*}")
  compare "include/stillpoint/${pair%%:*}" \
    "$(LC_ALL=C comm -13 <(linked STILLPOINT_OPENCV_COMPONENTS "${pair#*:}") <(echo "$own_included"))" \
    "$(LC_ALL=C comm -23 <(echo "$own_linked") <(echo "$own_included"))"
done
exit "$status"
