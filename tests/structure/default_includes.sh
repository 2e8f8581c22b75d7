#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# default_includes.sh PROJECT: who includes stillpoint.hpp compiles the stages of DefaultPolicies, and of OpenCV the core
# alone: not the paper's stages, not the monocular ones, not opencv2/video. Prints what is drawn in all the same and by
# which header; exit status 1.
set -euo pipefail
cd "$1/include"

forbidden='stillpoint/motion/epipolar/|lucas_kanade\.hpp|sampson_score\.hpp|offset_score\.hpp|mean_gate\.hpp|region_clusters\.hpp|flow_neighbours\.hpp|opencv2/'
known=(stillpoint/stillpoint.hpp)
drawn_in=0
for ((i = 0; i < ${#known[@]}; ++i)); do
  while IFS= read -r header; do
    if [[ $header =~ $forbidden && $header != opencv2/core/* ]]; then
      echo "${known[i]}: draws $header into stillpoint.hpp"
      drawn_in=$((drawn_in + 1))
    elif [[ $header == stillpoint/* && " ${known[*]} " != *" $header "* ]]; then
      known+=("$header")
    fi
  done < <(sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*["<](stillpoint\/[^">]+|opencv2\/[^">]+)[">].*/\1/p' "${known[i]}")
done
((${#known[@]} > 20)) || { echo "only ${#known[@]} headers found behind stillpoint.hpp, expected more than 20"; exit 1; }
((drawn_in == 0))
