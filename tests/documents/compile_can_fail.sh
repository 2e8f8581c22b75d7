#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# compile_can_fail.sh WORK_FOLDER COMPILER: compile.sh takes sound pages, and names the page and line of what is wrong.
set -euo pipefail
compile=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/compile.sh
rm -rf "$1" && mkdir -p "$1" && cd "$1"
compiler=$2
echo 'namespace documents { extern int at_hand; }' > preamble.hpp

cat > sound.md << 'PAGE'
<!-- given: int of_this_page = 3; -->
```cpp
#include <vector>

std::vector<int> numbers(of_this_page);
numbers.push_back(at_hand);
```
```cpp
// A type, used by the block after it.
struct Stage { int value; };
```
```cpp
Stage stage{at_hand};
```
```cpp
#include <nowhere/onnxruntime.hpp>
```
```cpp-host
of some other host;
```
PAGE
printf '\n```cpp\nat_hand = 1;\nat_hands = 2;\n```\n' > unknown_name.md
printf '```cpp\nstruct Stage { int value };\n```\n' > no_semicolon.md
printf '```cpp\n#include <vector>\n#include <no/such/header>\n```\n' > no_header.md

run() { bash "$compile" "PREAMBLE=$PWD/preamble.hpp" WITHOUT=onnxruntime "$@" -- "$compiler" -std=c++17; }
run sound.md || { echo 'a sound page was refused'; exit 1; }
for expected in unknown_name.md:4: no_semicolon.md:2: no_header.md:3:; do
  if run sound.md "${expected%%:*}" 2> found; then echo "$expected was taken"; exit 1; fi
  grep -q "^$expected.*error" found || { echo "expected an error at $expected, found:"; cat found; exit 1; }
done
echo 'all mistakes were found'
