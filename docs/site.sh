#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# docs/site.sh [FOLDER]: builds the documentation site in FOLDER/html (build/site/html): the guides by mkdocs and the API
# reference by Doxygen. Installs what is missing (as root on Debian); compiles nothing. Exit status 1 if a link is dead,
# in the sources or in the site. From any folder:
#   bash docs/site.sh
set -euo pipefail
root=$(realpath -- "$(dirname "${BASH_SOURCE[0]}")/..")
site=$(realpath -m -- "${1:-$root/build/site}")
cd "$root"

bash tests/install_packages.sh mkdocs python3 doxygen g++ cmake ninja-build libeigen3-dev < /dev/null

bash tests/structure/links.sh .

# The reference. It needs the headers alone, so that OpenCV is not asked for.
cmake -S . -B "$site/reference" -G Ninja --log-level=WARNING -DSTILLPOINT_WITH_OPENCV=OFF -DSTILLPOINT_BUILD_TESTS=OFF \
  -DSTILLPOINT_BUILD_EXAMPLES=OFF -DSTILLPOINT_BUILD_BENCHMARKS=OFF -DSTILLPOINT_BUILD_SHIM=OFF \
  -DSTILLPOINT_BUILD_COMPILED=OFF -DSTILLPOINT_BUILD_DOCS=ON -DSTILLPOINT_DOCS_WITH_GUIDES=OFF > /dev/null
rm -rf "$site/reference/html"
cmake --build "$site/reference" --target stillpoint_docs

# The guides, and what they link to, lie in the site as in the project: their links hold in both.
# docs/README.md says in which order the guides are read; a guide that it does not name comes after them.
mapfile -t guides < <({ echo docs/README.md; grep -oE '\]\([a-z0-9_]+\.md' docs/README.md | sed 's|^](|docs/|'; printf '%s\n' docs/*.md; } |
  awk '!seen[$0]++')
mapfile -t hosts < <(ls -d docs/hosts/*.md 2> /dev/null)
mapfile -t fronts < <(ls -d python/README.md ros/README.md shim/README.md 2> /dev/null)
mapfile -t design < <(ls -d docs/design/*.md 2> /dev/null)
project=(CHANGELOG.md CONTRIBUTING.md SECURITY.md)
pages=(README.md "${guides[@]}" "${hosts[@]}" "${design[@]}" "${fronts[@]}" "${project[@]}")

rm -rf "$site/pages" "$site/html"
mkdir -p "$site/pages"
{ printf '%s\n' "${pages[@]}"; python3 tests/structure/links.py --targets . "${pages[@]}"; } | sort -u |
  xargs -d '\n' cp -r --parents -t "$site/pages"
# GitHub lets a list follow a paragraph without an empty line between them; mkdocs does not.
find "$site/pages" -name '*.md' | while IFS= read -r page; do
  awk '/^ *```/ { in_code = !in_code }
    !in_code && /^- / && before ~ /^[^- ]/ { print "" }
    { print; before = $0 }' "$page" > "$page.new"
  mv "$page.new" "$page"
done
cp -r "$site/reference/html" "$site/pages/reference"
# Doxygen links to #nested-classes on pages that have none.
for page in "$site"/pages/reference/*.html; do
  grep -q 'name="nested-classes"' "$page" || sed -i 's/ href="#nested-classes"//' "$page"
done

# section TITLE PAGE...: a part of the list of pages.
section() {
  (($# > 1)) || return 0
  printf '  - %s:\n' "$1"
  printf '    - %s\n' "${@:2}"
}
{
  cat docs/mkdocs.yml
  echo 'nav:'
  echo '  - Home: README.md'
  section Guides "${guides[@]}"
  section Hosts "${hosts[@]}"
  section 'Other ways in' "${fronts[@]}"
  section Design "${design[@]}"
  echo '  - API reference: reference/index.html'
  section Project "${project[@]}"
} > "$site/mkdocs.yml"
mkdocs --quiet build --config-file "$site/mkdocs.yml"

# Debian 12 has the scripts of mkdocs' theme under an older name, or not at all.
scripts=$site/html/js
[[ -e $scripts/jquery-3.6.0.min.js ]] || cp "$scripts"/jquery-[0-9]*.min.js "$scripts/jquery-3.6.0.min.js"
touch "$scripts/theme_extra.js"
# Its links are right only where the site lies at the root of a server.
rm "$site/html/404.html"

python3 tests/structure/links.py "$site/html" .
echo "The site: $(realpath "$site/html")/index.html, the API reference: reference/index.html beside it"
