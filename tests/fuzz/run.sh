#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# run.sh MINUTES [TARGET...]: replays the corpus of each target (lists, yaml, decoders, filter; all of them unless told)
# and then fuzzes it for MINUTES, which may be a fraction: so long for each of them, one after the other. 0 replays only.
# SEED=N in the environment fuzzes in the same order each time. Builds them first, in build/fuzz
# (-DSTILLPOINT_BUILD_FUZZERS=ON, preset `fuzz`). What is found lies in build/fuzz/found/TARGET: mend it, and put the
# input into tests/fuzz/corpus/TARGET. Exit status 1 where something is.
set -uo pipefail
minutes=${1:?"run.sh MINUTES [TARGET...]"}
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
targets=("$@")
((${#targets[@]})) || targets=(lists yaml decoders filter)
seconds=$(awk -v m="$minutes" 'BEGIN { printf "%d", 60 * m }')

cmake --preset fuzz > /dev/null && cmake --build --preset fuzz || exit 1
export ASAN_OPTIONS=detect_stack_use_after_return=1:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
[[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm  # readers are handed files: a disk would be what is measured

failed=()
for target in "${targets[@]}"; do
  program=build/fuzz/tests/fuzz/fuzz_$target
  found=build/fuzz/found/$target grown=build/fuzz/corpus/$target  # what a run learns stays for the next one
  mkdir -p "$found" "$grown"
  limits=(-max_len=4096 -timeout=60 -rss_limit_mb=3000 -artifact_prefix="$found/")
  echo "--- $target: the corpus"
  # One process for all of them; where one fails, its name is the last that was printed.
  "$program" "${limits[@]}" tests/fuzz/corpus/"$target"/* > "$found/replay.log" 2>&1 ||
    { tail -n 40 "$found/replay.log"; failed+=("$target"); continue; }
  ! grep '^judged: 0 of' "$found/replay.log" ||
    { echo "the corpus of $target reaches no stage"; failed+=("$target"); continue; }
  ((seconds > 0)) || continue
  echo "--- $target: $seconds s of fuzzing"
  "$program" "${limits[@]}" -seed="${SEED:-0}" -max_total_time="$seconds" -print_final_stats=1 "$grown" tests/fuzz/corpus/"$target" \
    > "$found/fuzz.log" 2>&1 || { tail -n 60 "$found/fuzz.log"; failed+=("$target"); continue; }
  grep -E '^stat::number_of_executed_units' "$found/fuzz.log"
done
((${#failed[@]} == 0)) || { echo "found something: ${failed[*]}"; exit 1; }
