#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/accuracy.sh [DATA [FRAMES]]: measures what each correction is worth and writes the tables into docs/design/ablation.md, between
# its markers. DATA is a folder with kitchen_walk, kitchen_box and kitchen_static, unless told ../shared/data; without
# it there are the synthetic scenes alone. FRAMES of each sequence, all unless told. About ten minutes on two free cores.
set -euo pipefail
root=$(dirname "${BASH_SOURCE[0]}")/..
data=$(realpath -m -- "${1:-$root/../shared/data}")
shift $(($# > 0))
cd "$root"

bash bench/build.sh stillpoint_accuracy

page=docs/design/ablation.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build/ratios/bench/stillpoint_accuracy "$data" "$@" > "$work/tables"
awk -v tables="$work/tables" '
  /^<!-- end of tables -->$/ { skip = 0 }
  !skip { print }
  /^<!-- tables: / { while ((getline line < tables) > 0) print line; skip = 1 }
' "$page" > "$work/page"
mv "$work/page" "$page"
cat "$work/tables"
