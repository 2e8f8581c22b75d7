#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents.sh PROJECT: each header that docs/algorithm.md names is there, each relative link of a page leads to a file and to
# a heading of it, and a guide (docs/, docs/hosts/; not docs/design/) has at most 150 lines. Prints `file:line: ...` for each
# offence. That the code of the documents compiles is tests/documents.
set -euo pipefail
cd "$1"
[[ -f docs/algorithm.md ]] || exit 0

missing_headers() {
  grep -onE '`(core|prior|match|motion|score|gate|cluster|memory|verdict|evaluation)/[a-z0-9_/]+\.hpp`' docs/algorithm.md |
    while IFS=: read -r number file; do
      file=${file//\`/}
      [[ -f include/stillpoint/$file ]] || echo "docs/algorithm.md:$number: no such header: $file"
    done
}

# The anchors of a page, as GitHub makes them of its headings.
anchors() {
  awk '/^[ \t]*```/ { inside = !inside } !inside && /^#+ /' "$1" |
    sed -E 's/^#+ //; s/\[([^]]*)\]\([^)]*\)/\1/g' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9_ -]//g; s/ /-/g'
}

dead_links() {
  local page number link target
  for page in "${pages[@]}"; do
    awk '/^[ \t]*```/ { inside = !inside } !inside' "$page" | grep -qF '](' || continue
    while IFS=: read -r number link; do
      link=${link#*\](}
      link=${link%)}
      [[ $link == *://* ]] && continue
      target=$(dirname "$page")/${link%%#*}
      [[ $link == \#* ]] && target=$page
      if [[ ! -e $target ]]; then
        echo "$page:$number: no such file: $link"
      elif [[ $link == *#* && $target == *.md ]] && ! anchors "$target" | grep -qxF -- "${link#*#}"; then
        echo "$page:$number: no such heading: $link"
      fi
    done < <(grep -onE '\]\([^) ]+\)' "$page")
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

mapfile -t pages < <(find . -maxdepth 1 -name '*.md'; find docs shim -name '*.md' 2> /dev/null)
pages=("${pages[@]#./}")
offences=$(missing_headers; dead_links; long_guides)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
