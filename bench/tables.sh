#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/tables.sh FOLDER...: the paper's tables 1 to 4. Each FOLDER is a sequence of the TUM or Bonn benchmark as it is
# unpacked (rgbd_dataset_freiburg3_walking_xyz, rgbd_bonn_crowd), or of the same layout; each is run with the filter and
# without it in front of the SLAM of examples/slam. Prints Markdown; tables.csv in the working folder has all figures.
# STILLPOINT_RUN_ARGUMENTS: more for stillpoint_run, such as '--prior MODEL --detect-every 10 --sync'.
set -euo pipefail
here=$PWD
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
(($# > 0)) || { echo 'usage: bench/tables.sh FOLDER...' >&2; exit 2; }

bash "$project/tests/install_packages.sh" libceres-dev < /dev/null >&2
bash "$project/bench/build.sh" stillpoint_run stillpoint_tables
build=$project/build/ratios

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
declare -A folder_of
names=(walking_xyz walking_rpy walking_halfsphere walking_static sitting_xyz sitting_rpy sitting_halfsphere sitting_static
  bonn_crowd)
for folder in "$@"; do
  name=$(basename "$folder")
  name=${name#rgbd_dataset_freiburg3_}
  name=${name#rgbd_}
  [[ " ${names[*]} " == *" $name "* ]] || names+=("$name")
  folder_of[$name]=$folder
done

read -ra more <<< "${STILLPOINT_RUN_ARGUMENTS:-}"
for name in "${names[@]}"; do
  folder=${folder_of[$name]:-}
  if [[ -z $folder || ! -d $folder ]]; then
    echo "$name"
    continue
  fi
  "$build/examples/stillpoint_run" --tum "$folder" --backend slam --mapping-in-step --out "$work/$name" \
    --quiet "${more[@]}" > /dev/null
  printf '%s\t%s\t%s\t%s\n' "$name" "$folder/groundtruth.txt" "$work/$name/trajectory.txt" \
    "$work/$name/trajectory_unfiltered.txt"
done > "$work/rows"
"$build/bench/stillpoint_tables" "$here/tables.csv" < "$work/rows"
