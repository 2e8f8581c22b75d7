#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# compile.sh PREAMBLE=FILE WITHOUT=REGEX PAGE.md... -- COMPILER FLAG...: compiles, without making anything of it, the C++ of
# the pages in one translation unit (code_of_pages.awk); an error names the page and its line.
set -euo pipefail
program=$(dirname "${BASH_SOURCE[0]}")/code_of_pages.awk
pages=()
while [[ $1 != -- ]]; do
  pages+=("$1")
  shift
done
shift
awk -f "$program" "${pages[@]}" | "$@" -fsyntax-only -x c++ -
