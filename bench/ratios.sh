#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/ratios.sh [FOLDER [REPETITIONS [FRAMES]]]: our times beside OpenCV's, one line each: name ours_ms theirs_ms ratio.
# FOLDER is a sequence in the layout of the TUM benchmark with camera.yaml and boxes.txt, unless told
# ../shared/data/kitchen_walk; where there is none, a synthetic scene is measured. Lines that begin with # explain.
set -euo pipefail
root=$(dirname "${BASH_SOURCE[0]}")/..
folder=$(realpath -m -- "${1:-$root/../shared/data/kitchen_walk}")
shift $(($# > 0))
cd "$root"

bash bench/build.sh stillpoint_ratios

LC_ALL=C lscpu | awk -F ': +' '/^(CPU\(s\)|Model name|CPU family|Model):/ { printf "%s %s: %s", n++ ? "," : "#", $1, $2 } END { print "" }'
LC_ALL=C uptime | sed 's/.*load average/# load average before the run/'
exec build/ratios/bench/stillpoint_ratios "$folder" "$@"
