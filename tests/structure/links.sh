#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# links.sh PROJECT: each relative link in the project's Markdown leads to a file, and to a heading in it. Prints
# `file:line: dead link: target` for each offence.
set -euo pipefail
checker=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/links.py
cd "$1"
mapfile -t pages < <(find . \( -name .git -o -name build -o -name out \) -prune -o -name '*.md' -print | sed 's|^\./||' | LC_ALL=C sort)
python3 "$checker" . "${pages[@]}"
