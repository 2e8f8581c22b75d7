#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/same_bytes.sh [BEFORE [AFTER [DATA]]]: does AFTER (a commit, HEAD unless told) write the same features.csv and
# frames.csv as BEFORE (the commit before it)? For changes that only move or rename. Runs DefaultPolicies with and
# without boxes and PaperPolicies with boxes on kitchen_walk, kitchen_box and kitchen_static of DATA (../shared/data).
# Prints a line for each file that differs, and a count; exit status 1 if any does. Ten minutes on two cores.
set -euo pipefail
root=$(dirname "${BASH_SOURCE[0]}")/..
data=$(realpath -m -- "${3:-$root/../shared/data}")
cd "$root"
after=$(git rev-parse --verify "${2:-HEAD}^{commit}")
before=$(git rev-parse --verify "${1:-$after~1}^{commit}")
[[ -d $data/kitchen_walk ]] || { echo "$data/kitchen_walk is missing: DATA is a folder with the kitchen sequences" >&2; exit 1; }

bash tests/install_packages.sh g++ cmake ninja-build ccache libopencv-dev libeigen3-dev libyaml-cpp-dev libcli11-dev \
  nlohmann-json3-dev < /dev/null >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run COMMIT NAME: all outputs, in folders below $work/NAME.
run() {
  local sequence policies prior
  git clone -q . "$work/$2-source"
  git -C "$work/$2-source" checkout -q "$1"
  cmake -S "$work/$2-source" -B "$work/$2-build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_TESTS=OFF \
    -DSTILLPOINT_BUILD_BENCHMARKS=OFF > /dev/null
  cmake --build "$work/$2-build" --target stillpoint_run >&2
  for sequence in kitchen_walk kitchen_box kitchen_static; do
    while read -r policies prior; do
      "$work/$2-build/examples/stillpoint_run" --tum "$data/$sequence" --policies "$policies" --prior "$prior" --quiet \
        --out "$work/$2/$sequence-$policies-$prior" > /dev/null
    done <<< $'default none\ndefault boxes\npaper boxes'
  done
}
run "$before" before
run "$after" after

compared=0 different=0
for file in "$work"/before/*/{features,frames}.csv; do
  name=${file#"$work/before/"}
  compared=$((compared + 1))
  cmp -s "$file" "$work/after/$name" || { echo "$name differs"; different=$((different + 1)); }
done
echo "$different of $compared files differ between ${before:0:7} and ${after:0:7}"
((different == 0 && compared == 18))
