#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# include_rules.sh PROJECT: which header may include what. A stage knows core/ (types), depth/ and pipeline/ (what is
# kept between frames) and nothing of its neighbours; only filter_frame.hpp and policies.hpp know them all. Prints `file:line: 'include' ...` for each offence; exit status 1.
set -euo pipefail
cd "$1"

# Patterns of `case`; an include is written as in the source, with its <> or "".
std='<+([a-z_0-9])>'  # [[ ]] knows +(...): one or more
eigen='<Eigen/*>'
opencv='<opencv2/*>'
core='"stillpoint/core/*"'
depth='"stillpoint/depth/*"'
pipeline='"stillpoint/pipeline/*"'
bridge='"stillpoint/opencv.hpp"'  # how OpenCV's types are read

# allowed HEADER: the patterns of what that header may include, one a line, and a name for the rule.
allowed() {
  local folder
  case $1 in */*) folder=${1%%/*} ;; *) folder=$1 ;; esac
  local own="\"stillpoint/$folder/*\""
  case $folder in
    core) rule='core/ includes the standard library, Eigen and core/ only'
      printf '%s\n' "$std" "$eigen" "$core" '"stillpoint/version.hpp"' '"stillpoint needs C++17*' ;;
    depth) rule='depth/ includes core/ and depth/'
      printf '%s\n' "$std" "$eigen" "$core" "$depth" ;;
    pipeline) rule='pipeline/ includes core/, depth/ and pipeline/, never a stage'
      printf '%s\n' "$std" "$eigen" "$core" "$depth" "$pipeline" ;;
    motion) rule='motion/ includes core/, depth/, pipeline/, motion/ and OpenCV; neither method knows the other'
      printf '%s\n' "$std" "$eigen" "$opencv" "$core" "$depth" "$pipeline" "$bridge" '"stillpoint/motion/+([a-z_0-9]).hpp"'
      [[ $1 != motion/*/* ]] || printf '"stillpoint/%s/*"\n' "${1%/*}" ;;
    prior | match | score | gate | cluster | memory | verdict)
      rule='a stage includes core/, depth/, pipeline/, its own folder and OpenCV (opencv.hpp), never another stage'
      printf '%s\n' "$std" "$eigen" "$opencv" "$core" "$depth" "$pipeline" "$bridge" "$own" ;;
    movers) rule='movers/ includes core/, depth/, pipeline/, its own folder, K-means, and how rigid motions are estimated'
      printf '%s\n' "$std" "$eigen" "$core" "$depth" "$pipeline" "$own" '"stillpoint/cluster/k_means.hpp"' \
        '"stillpoint/motion/rigid/rigid_estimator.hpp"' ;;
    evaluation | stereo | synthetic) rule="$folder/ includes core/, depth/, its own folder and OpenCV"
      printf '%s\n' "$std" "$eigen" "$opencv" "$core" "$depth" "$bridge" "$own" ;;
    io) rule='io/ includes core/, evaluation/ (trajectories), its own folder, OpenCV and yaml-cpp'
      printf '%s\n' "$std" '<yaml-cpp/*>' "$eigen" "$opencv" "$core" "$bridge" "$own" '"stillpoint/evaluation/*"' ;;
    detectors) rule='detectors/ includes core/, prior/, its own folder, OpenCV and networks'\'' libraries'
      printf '%s\n' '<*>' "$core" "$bridge" "$own" '"stillpoint/prior/*"' ;;
    adapters) rule='adapters/ includes the host, core/, depth/, verdict/ (what a host takes), the pipeline and its own folder'
      printf '%s\n' '<*>' "$core" "$depth" "$bridge" "$own" '"stillpoint/verdict/*"' '"stillpoint/+([a-z_0-9]).hpp"' ;;
    options) rule='options/ includes core/, depth/, io/, the pipeline, policies/ and the stages'
      printf '%s\n' "$std" "$core" "$depth" "$pipeline" "$own" '"stillpoint/io/*"' '"stillpoint/filter_frame.hpp"' \
        '"stillpoint/policies.hpp"' '"stillpoint/policies/*"' "${stages[@]}" ;;
    version.hpp | fwd.hpp) rule="$1 includes nothing" ;;
    opencv.hpp) rule='opencv.hpp includes core/ and OpenCV'
      printf '%s\n' "$std" "$opencv" "$core" ;;
    policies) rule='policies/ includes core/, depth/, the stages, its own folder and compiled.hpp'
      printf '%s\n' "$std" "$core" "$depth" "$own" '"stillpoint/fwd.hpp"' '"stillpoint/compiled.hpp"' "${stages[@]}" ;;
    policies.hpp) rule='policies.hpp includes policies/, core/, depth/ and the stages'
      printf '%s\n' "$std" "$core" "$depth" '"stillpoint/policies/*"' "${stages[@]}" ;;
    compiled.hpp) rule='compiled.hpp includes core/, depth/, pipeline/ and the stages that a host sets'
      printf '%s\n' "$std" "$core" "$depth" "$pipeline" '"stillpoint/fwd.hpp"' "${stages[@]}" ;;
    stillpoint.hpp) rule='stillpoint.hpp includes neither io/, detectors/, adapters/, evaluation/ nor synthetic/'
      printf '%s\n' "$std" "$core" "$depth" "${stages[@]}" '"stillpoint/+([a-z_0-9]).hpp"' '"stillpoint/policies/*"' ;;
    filtered_tracker.hpp) rule='filtered_tracker.hpp includes core/, depth/, pipeline/ and verdict/ (what a host takes)'
      printf '%s\n' "$std" "$core" "$depth" "$pipeline" '"stillpoint/verdict/*"' ;;
    *.hpp) rule='a header beside filter_frame.hpp includes core/, depth/, pipeline/, the null movers and headers of that folder'
      printf '%s\n' "$std" "$core" "$depth" "$pipeline" '"stillpoint/movers/no_movers.hpp"' '"stillpoint/filter_frame.hpp"' '"stillpoint/policies.hpp"' '"stillpoint/fwd.hpp"' \
        "$bridge" ;;
    *) rule="the folder $folder/ is not known to tests/structure/include_rules.sh: say there what it may include" ;;
  esac
}
stages=()
for stage in prior match motion score gate cluster memory verdict movers; do stages+=("\"stillpoint/$stage/*\""); done

offences=0
offence() {
  printf '%s:%s: %s: %s\n' "$1" "$2" "$3" "$4"
  offences=$((offences + 1))
}

root=include/stillpoint
while IFS= read -r file; do
  allowed "${file#"$root"/}" > /dev/null  # sets $rule
  mapfile -t patterns < <(allowed "${file#"$root"/}")
  while IFS=: read -r line text; do
    [[ $text =~ ^[[:space:]]*\#[[:space:]]*include[[:space:]]*(.*[\>\"]) ]] || continue
    include=${BASH_REMATCH[1]}
    if [[ $include == '<Eigen/Dense>' || $include == '<Eigen/Eigen>' || $include == '<opencv2/opencv.hpp>' ]]; then
      offence "$file" "$line" "$include" 'include the narrow header (Eigen/Core, opencv2/core/mat.hpp)'
      continue
    fi
    for pattern in "${patterns[@]}"; do
      # shellcheck disable=SC2053  # the right side is a pattern
      [[ $include == $pattern ]] && continue 2
    done
    offence "$file" "$line" "$include" "$rule"
  done < <(grep -nE '^[[:space:]]*#[[:space:]]*include' "$file" || true)
done < <(find "$root" -name '*.hpp' | LC_ALL=C sort)

[[ $offences == 0 ]] || { echo "$offences forbidden includes" >&2; exit 1; }
