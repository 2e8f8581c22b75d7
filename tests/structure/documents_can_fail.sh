#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents_can_fail.sh WORK_FOLDER: documents.sh finds headers that are not there, and long guides.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/documents.sh
work=$1
rm -rf "$work"
mkdir -p "$work/docs/design" "$work/include/stillpoint/core"
cd "$work"
sound() {
  printf '# The algorithm\n`core/there.hpp`\n\n' > docs/algorithm.md
  { printf '# Other\n'; printf '\n%.0s' {1..200}; } \
    > docs/design/other.md
}
sound
touch include/stillpoint/core/there.hpp
bash "$rules" . || { echo "sound documents were refused"; exit 1; }

refuses() {  # FILE EXPECTED: with what standard input adds to FILE
  local found
  sound
  cat >> "$1"
  found=$(bash "$rules" . && echo "passed" || true)
  [[ $found == "$2" ]] || { printf 'expected: %s\nfound:    %s\n' "$2" "$found"; exit 1; }
}
refuses docs/algorithm.md 'docs/algorithm.md:4: no such header: core/missing.hpp' <<< '`core/missing.hpp`'
refuses docs/algorithm.md 'docs/algorithm.md:151: a guide has at most 150 lines, this one 151' < <(printf '\n%.0s' {1..148})
