#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents.sh PROJECT: each header that docs/algorithm.md names is there. Prints `file:line: ...` for each offence. That the
# code of the documents compiles is tests/documents.
set -euo pipefail
cd "$1"
[[ -f docs/algorithm.md ]] || exit 0

offences=$(
  grep -onE '`(core|prior|match|motion|score|gate|cluster|memory|verdict|evaluation)/[a-z0-9_/]+\.hpp`' docs/algorithm.md |
    while IFS=: read -r number file; do
      file=${file//\`/}
      [[ -f include/stillpoint/$file ]] || echo "docs/algorithm.md:$number: no such header: $file"
    done
)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
