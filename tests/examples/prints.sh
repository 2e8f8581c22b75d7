#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# prints.sh PATTERN... -- PROGRAM [ARGUMENT...]: the program ends with status 0 and prints, in this order, a line for each
# pattern that the whole line matches (extended regular expressions).
set -euo pipefail
patterns=()
while [[ $1 != -- ]]; do
  patterns+=("$1")
  shift
done
shift
status=0
printed=$("$@") || status=$?
printf '%s\n' "$printed"
[[ $status == 0 ]] || { echo "$1 ended with status $status"; exit 1; }
while IFS= read -r line; do
  [[ ${#patterns[@]} == 0 || ! $line =~ ^(${patterns[0]})$ ]] || patterns=("${patterns[@]:1}")
done <<< "$printed"
[[ ${#patterns[@]} == 0 ]] || { echo "no line, after those before it, matches: ${patterns[0]}"; exit 1; }
