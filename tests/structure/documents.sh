#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents.sh PROJECT: each line of C++ in README.md and docs/ is a line of a documents_test.cpp in tests/unit, which is
# compiled and run (docs/benchmarks.md quotes bench/); each file that docs/algorithm.md names is there. Prints `file:line: ...` for each offence.
set -euo pipefail
cd "$1"
compiled=(tests/unit/*/documents_test.cpp)

offences=$(
  for page in README.md docs/*.md; do
    [[ $page != docs/benchmarks.md ]] || continue
    awk -v page="$page" '
      { line = $0; gsub(/^[ \t]+|[ \t]+$/, "", line) }
      FILENAME != page { compiled[line] = 1; next }
      line == "```cpp" { inside = 1; next }
      line == "```" { inside = 0 }
      inside && line != "" && !(line in compiled) { print page ":" FNR ": not compiled anywhere: " line }
    ' "${compiled[@]}" "$page"
  done
  [[ ! -f docs/algorithm.md ]] || grep -onE '`(core|prior|match|motion|score|gate|cluster|memory|verdict|evaluation)/[a-z0-9_/]+\.hpp`' docs/algorithm.md |
    while IFS=: read -r number file; do
      file=${file//\`/}
      [[ -f include/stillpoint/$file ]] || echo "docs/algorithm.md:$number: no such header: $file"
    done
)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
