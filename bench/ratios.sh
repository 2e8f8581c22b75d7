#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/ratios.sh [FOLDER [REPETITIONS [FRAMES]]]: our times beside OpenCV's, one line each: name ours_ms theirs_ms ratio.
# FOLDER is a sequence in the layout of the TUM benchmark with camera.yaml and boxes.txt, unless told
# ../shared/data/kitchen_walk; where there is none, a synthetic scene is measured. Lines that begin with # explain.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=$PWD/../shared/data/kitchen_walk
if (($# > 0)); then
  case $1 in /*) folder=$1 ;; *) folder=$here/$1 ;; esac
  shift
fi

bash bench/build.sh stillpoint_ratios

LC_ALL=C lscpu | awk -F ': +' '/^(CPU\(s\)|Model name|CPU family|Model):/ { printf "%s %s: %s", n++ ? "," : "#", $1, $2 } END { print "" }'
LC_ALL=C uptime | sed 's/.*load average/# load average before the run/'
exec build/ratios/bench/stillpoint_ratios "$folder" "$@"
