#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents.sh PROJECT: each header that docs/algorithm.md names is there, and a guide (docs/, docs/hosts/; not docs/design/)
# has at most 150 lines. Prints `file:line: ...` for each offence. Links are links.sh's, that the code compiles is tests/documents'.
set -euo pipefail
cd "$1"
[[ -f docs/algorithm.md ]] || exit 0

missing_headers() {
  grep -onE '`(core|depth|pipeline|detectors|prior|match|motion|score|gate|cluster|memory|verdict|evaluation)/[a-z0-9_/]+\.hpp`' docs/algorithm.md |
    while IFS=: read -r number file; do
      file=${file//\`/}
      [[ -f include/stillpoint/$file ]] || echo "docs/algorithm.md:$number: no such header: $file"
    done
}

long_guides() {
  local page lines
  for page in docs/*.md docs/hosts/*.md; do
    [[ -f $page ]] || continue
    lines=$(wc -l < "$page")
    ((lines <= 150)) || echo "$page:151: a guide has at most 150 lines, this one $lines"
  done
}

offences=$(missing_headers; long_guides)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
