#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# file_rules.sh PROJECT: every source says whose it is, no header and no example is long, nobody draws random numbers
# behind our back nor uses what newer versions of OpenCV do not have, each header asks for C++17 first.
# Prints `file:line: ...` for each offence; exit status 1.
set -euo pipefail
cd "$1"
longest=300  # lines; a header that passes it is two
declare -A longest_example=([01_minimal]=40 [02_opencv_tracker]=110 [03_custom_stage]=150 [04_movers]=40)  # they are to be read

folders=()
for folder in include tests examples bench cmake shim python .ci; do
  [[ ! -d $folder ]] || folders+=("$folder")
done

offences=$(
  while IFS= read -r file; do
    head -n 3 "$file" | grep -q 'SPDX-License-Identifier: MIT' || echo "$file:1: no line 'SPDX-License-Identifier: MIT'"
    case $file in
      examples/[0-9]*.cpp)
        name=$(basename "$file" .cpp) lines=$(wc -l < "$file")
        ((lines <= ${longest_example[$name]:-0})) ||
          echo "$file:$lines: more than ${longest_example[$name]:-0} lines: an example shows one idea" ;;
      include/*)
      lines=$(wc -l < "$file")
      ((lines <= longest)) || echo "$file:$lines: more than $longest lines: split it by idea"
      # Distributions of <random> differ between standard libraries, and global generators between runs.
      grep -nE '#include <random>|std::random_device|\b(rand|srand|theRNG)\(' "$file" |
        sed "s|^\([0-9]*\):.*|$file:\1: random numbers come from core/random.hpp only|" || true
      grep -nE 'std::(cout|cerr|clog)|\bf?printf\(' "$file" |
        sed "s|^\([0-9]*\):.*|$file:\1: a guest prints nothing|" || true
      # OpenCV 4.11 took the operators away from its vector types.
      grep -nE 'opencv2/core/hal/|CV_SIMD|\bv_u?(int|float)(8|16|32|64)(x[0-9]+)?\b' "$file" |
        sed "s|^\([0-9]*\):.*|$file:\1: no universal intrinsics of OpenCV: loops that compilers vectorise, or Eigen|" || true ;;
    esac
  done < <(find "${folders[@]}" -type f \
    \( -name '*.hpp' -o -name '*.cpp' -o -name '*.sh' -o -name '*.py' -o -name '*.cmake' -o -name CMakeLists.txt \) |
    LC_ALL=C sort)
  # Whichever header a host includes: the first of ours to be read to its end is one that includes no other.
  find include -mindepth 3 -name '*.hpp' ! -name needs_cpp17.hpp -exec grep -L '^#include "stillpoint/' {} + |
    LC_ALL=C sort | sed 's|$|:1: in C++14 not one error: include core/needs_cpp17.hpp|'
)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
