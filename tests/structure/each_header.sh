#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# each_header.sh WORK_FOLDER FLAG...: each header alone, twice, by clang++, as structure_each_header does it where there is
# no clang++. A header that includes one of the hubs anyway, itself or by another header, finds it precompiled, with all
# that the hub includes: what a header lacks is not among those. Each is compiled as a header to be, which leaves templates
# to whoever uses them: those are instantiated once, where all headers are compiled together; and here for detectors/, which
# are not among these. ONNXRUNTIME_INCLUDE: a folder, or the headers that need it are left out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$1
shift
flags=("$@")
mkdir -p "$work"

# From the smallest to the one that includes most: a header takes the last that it includes.
hubs=(core/geometry core/matches opencv depth/depth_lookup synthetic/scene match/surface_search)

# HEADER HUB of each header, with - for none.
headers_and_hubs() {
  (cd include && grep -rE '^#include "stillpoint/' stillpoint --include='*.hpp') | LC_ALL=C sort |
    awk -v hubs="${hubs[*]}" '
      { split($0, part, ":"); split($0, quoted, "\""); includes[part[1]] = includes[part[1]] " " quoted[2] }
      function reach(header, from,    list, count, i) {
        count = split(includes[header], list, " ")
        for (i = 1; i <= count; ++i)
          if (reached[list[i]] != from) { reached[list[i]] = from; reach(list[i], from) }
      }
      END {
        hub_count = split(hubs, hub, " ")
        while (("cd include && find stillpoint -name \"*.hpp\" | LC_ALL=C sort" | getline header) > 0) {
          reach(header, header)
          found = "-"
          for (i = 1; i <= hub_count; ++i)
            if (reached["stillpoint/" hub[i] ".hpp"] == header) found = hub[i]
          print header, found
        }
      }'
}

# What a hub instantiates is instantiated there, not by each who includes it: a third of the time.
for hub in "${hubs[@]}"; do
  clang++ "${flags[@]}" -fpch-instantiate-templates -x c++-header "include/stillpoint/$hub.hpp" -o "$work/${hub//\//_}.pch"
done

bad=0 count=0
while read -r header hub; do
  optional=()
  if [[ $header == *onnxruntime* || $header == *onnx_runtime* ]]; then
    [[ -n ${ONNXRUNTIME_INCLUDE:-} ]] || continue
    optional=(-isystem "$ONNXRUNTIME_INCLUDE")
  fi
  [[ $hub == - ]] || optional+=(-include-pch "$work/${hub//\//_}.pch")
  count=$((count + 1))
  compile=(-x c++-header -o "$work/header.pch")
  [[ $header != */detectors/* ]] || compile=(-x c++ -fsyntax-only)
  printf '#include "%s"\n#include "%s"\n' "$header" "$header" |
    clang++ "${flags[@]}" "${optional[@]}" "${compile[@]}" - ||
    { echo "$header does not compile alone"; bad=$((bad + 1)); }
done < <(headers_and_hubs)
echo "$((count - bad)) of $count headers compile alone"
((count > 0 && bad == 0))
