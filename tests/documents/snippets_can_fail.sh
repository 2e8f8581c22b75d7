#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# snippets_can_fail.sh WORK_FOLDER: snippets.sh takes a sound page, and names the page and line of what is wrong.
set -euo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/snippets.sh
rm -rf "$1" && mkdir -p "$1" && cd "$1"

cat > program.cpp << 'SOURCE'
#include <vector>
#include <string>
int main() {
  // [loop]
  std::vector<int> numbers;
  // [loop]
  for (int i = 0; i < 3; ++i) {
    // [loop]
    numbers.push_back(i);

    numbers.push_back(i + 1);
    // [loop]
  }
  // [open]
}
SOURCE

cat > sound.md << 'PAGE'
<!-- snippet: program.cpp [loop] -->
```cpp
#include <vector>

std::vector<int> numbers;
numbers.push_back(i);
numbers.push_back(i + 1);
```
```sh
of another language
```
PAGE
sed 's/(i);/(j);/' sound.md > changed.md
sed '/(i);/d' sound.md > left_out.md
sed '/i + 1/d' sound.md > too_short.md
sed 's/.*i + 1.*/&\nreturn 0;/' sound.md > too_long.md
sed 's/<vector>/<map>/' sound.md > other_include.md
sed 's/\[loop\]/[no_such]/' sound.md > no_mark.md
sed 's/\[loop\]/[open]/' sound.md > one_mark.md
sed 's/program/no_such/' sound.md > no_file.md
sed 1d sound.md > no_source.md

bash "$check" sound.md || { echo 'a sound page was refused'; exit 1; }
for expected in changed.md:6: left_out.md:6: too_short.md:7: too_long.md:8: other_include.md:3: no_mark.md:1: one_mark.md:1: \
  no_file.md:1: no_source.md:1:; do
  if bash "$check" "${expected%%:*}" > found; then echo "$expected was taken"; exit 1; fi
  grep -q "^$expected" found || { echo "expected an offence at $expected, found:"; cat found; exit 1; }
done
echo 'all mistakes were found'
