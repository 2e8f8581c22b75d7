#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# host_diff_can_fail.sh WORK_FOLDER COMPILER: host_diff.sh takes a sound diff and names the line of what is wrong with others.
set -euo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/host_diff.sh
rm -rf "$1" && mkdir -p "$1" && cd "$1"
compiler=$2
printf 'int at_hand;\nvoid grab() {\n  //@ src/Tracking.cc 1\n}\n' > host.cpp
head=$'about it\n--- a/src/Tracking.cc\n+++ b/src/Tracking.cc\n@@ -7,0 +8 @@\n'
printf '%s+at_hand = 1;\n' "$head" > sound.diff
printf '%s+at_hands = 1;\n' "$head" > name.diff                              # line 5
printf '%s+at_hand = 1;\n context;\n' "$head" > context.diff                 # line 6
printf '%s-a;\n-b;\n+at_hand = 1;\n' "$head" > removed.diff                  # line 6
printf '%s+at_hand = 1;\n@@ -9,0 +11 @@\n+at_hand = 2;\n' "$head" > hunk.diff  # a second hunk, for which the host has no place
printf 'about it\n' > empty.diff

bash "$check" sound.diff host.cpp -- "$compiler" || { echo 'a sound diff was refused'; exit 1; }
for expected in name.diff:5: context.diff:6: removed.diff:6: hunk.diff:no.place empty.diff:no.such.hunk; do
  if bash "$check" "${expected%%:*}" host.cpp -- "$compiler" > found 2>&1; then echo "$expected was taken"; exit 1; fi
  case $expected in *[0-9]:) pattern=^$expected ;; *) pattern=${expected#*:} ;; esac
  grep -q "$pattern" found || { echo "expected $expected, found:"; cat found; exit 1; }
done
echo 'all mistakes were found'
