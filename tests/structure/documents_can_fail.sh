#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# documents_can_fail.sh WORK_FOLDER: documents.sh finds code that nobody compiles and headers that are not there.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/documents.sh
work=$1
rm -rf "$work"
mkdir -p "$work/docs" "$work/tests/unit/pipeline" "$work/include/stillpoint/core"
cd "$work"
printf '  int known = 1;\n' > tests/unit/pipeline/documents_test.cpp
printf '```cpp\nint known = 1;\n```\n```sh\nanything\n```\n' > README.md
printf '`core/there.hpp`\n' > docs/algorithm.md
touch include/stillpoint/core/there.hpp
bash "$rules" . || { echo "sound documents were refused"; exit 1; }

printf '```cpp\nint unknown = 2;\n```\n' >> README.md
printf '`core/missing.hpp`\n' >> docs/algorithm.md
found=$(bash "$rules" . && echo "passed" || true)
for expected in 'README.md:8: not compiled anywhere: int unknown = 2;' 'docs/algorithm.md:2: no such header: core/missing.hpp'; do
  [[ $found == *"$expected"* ]] || { printf 'expected: %s\nfound:    %s\n' "$expected" "$found"; exit 1; }
done
