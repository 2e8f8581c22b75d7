#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents_can_fail.sh WORK_FOLDER: documents.sh finds headers that are not there.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/documents.sh
work=$1
rm -rf "$work"
mkdir -p "$work/docs" "$work/include/stillpoint/core"
cd "$work"
printf '`core/there.hpp`\n' > docs/algorithm.md
touch include/stillpoint/core/there.hpp
bash "$rules" . || { echo "sound documents were refused"; exit 1; }

printf '`core/missing.hpp`\n' >> docs/algorithm.md
found=$(bash "$rules" . && echo "passed" || true)
expected='docs/algorithm.md:2: no such header: core/missing.hpp'
[[ $found == "$expected" ]] || { printf 'expected: %s\nfound:    %s\n' "$expected" "$found"; exit 1; }
