#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# bench/trackers.sh [DATA [TRACKER...]]: how far the trackers of examples/ drift behind the filter, behind the true labels
# and behind nothing. DATA is a folder with kitchen_walk, kitchen_box and kitchen_static, unless told ../shared/data. Each
# row is the median over --start 0 to 4, in brackets the least and the greatest; prints a table for docs/trackers.md.
set -euo pipefail
root=$(dirname "${BASH_SOURCE[0]}")/..
data=$(realpath -m -- "${1:-$root/../shared/data}")
shift $(($# > 0))
cd "$root"
trackers=("$@")
((${#trackers[@]} > 0)) || trackers=(odometry klt orb)

bash bench/build.sh stillpoint_run

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# ate TRACKER SEQUENCE PRIOR: the five starts' ATE, filtered and unfiltered, metres, one pair a line; "inf" where the report
# has none, as the tracker was lost.
ate() {
  local start
  for start in 0 1 2 3 4; do
    build/ratios/examples/stillpoint_run --tum "$data/$2" --prior "$3" --backend "$1" --start "$start" \
      --out "$work/out" --quiet > /dev/null
    awk -F '[:,]' '/"ate_rmse_m"/ { filtered = $2 } /"ate_rmse_unfiltered_m"/ { unfiltered = $2 }
      function metres(ate) { return ate ~ /[0-9]/ ? ate + 0 : "inf" }
      END { print metres(filtered), metres(unfiltered) }' "$work/out/report.json"
  done
}
# column N FILE: its median, least and greatest value.
column() {
  sort -g -k "$1,$1" "$2" | awk -v n="$1" '
    function metres(ate) { return ate == "inf" ? "lost" : sprintf("%.4f", ate) }
    { x[NR] = $n }
    END { printf "%s (%s to %s)", metres(x[int((NR + 1) / 2)]), metres(x[1]), metres(x[NR]) }'
}
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (a + 0 > 0 && b + 0 > 0) printf "%.2f", a / b; else printf "n/a" }'; }

printf '| tracker | sequence | ATE filtered, m | ATE with the labels, m | ATE unfiltered, m | filtered by labels | filtered by unfiltered |\n'
printf '|---|---|---|---|---|---|---|\n'
for tracker in "${trackers[@]}"; do
  for sequence in kitchen_walk kitchen_box kitchen_static; do
    ate "$tracker" "$sequence" none > "$work/none"
    filtered=$(column 1 "$work/none")
    unfiltered=$(column 2 "$work/none")
    labels='' by_labels=''
    if [[ $sequence != kitchen_static ]]; then
      ate "$tracker" "$sequence" labels > "$work/labels"
      labels=$(column 1 "$work/labels")
      by_labels=$(ratio "${filtered%% *}" "${labels%% *}")
    fi
    echo "| $tracker | $sequence | $filtered | $labels | $unfiltered | $by_labels |" \
      "$(ratio "${filtered%% *}" "${unfiltered%% *}") |"
  done
done
