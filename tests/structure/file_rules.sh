#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# file_rules.sh PROJECT: every source says whose it is, no header and no example is long, nobody draws random numbers
# behind our back nor uses what newer versions of OpenCV do not have, each header asks for C++17 first. What users read
# has the field's words: one term for one idea.
# Prints `file:line: ...` for each offence; exit status 1.
set -euo pipefail
cd "$1"
longest=300  # lines; a header that passes it is two
declare -A longest_example=([01_minimal]=40 [02_opencv_tracker]=110 [03_custom_stage]=150 [04_movers]=40)  # they are to be read

folders=()
for folder in include tests examples bench cmake shim python ros .ci; do
  [[ ! -d $folder ]] || folders+=("$folder")
done

mapfile -t files < <(find "${folders[@]}" -type f \
  \( -name '*.hpp' -o -name '*.cpp' -o -name '*.sh' -o -name '*.py' -o -name '*.cmake' -o -name CMakeLists.txt \) |
  LC_ALL=C sort)
mapfile -t headers < <(printf '%s\n' "${files[@]}" | grep '^include/')
mapfile -t programs < <(printf '%s\n' "${files[@]}" | grep -E '^examples/[0-9][^/]*\.cpp$')

# no_header_has PATTERN WHY: one process for all headers; nothing to report is no error.
no_header_has() {
  grep -nHE "$1" "${headers[@]}" < /dev/null | sed -E "s@^([^:]*:[0-9]+):.*@\1: $2@" || true
}

# Headers and guides (docs/design/ tells of earlier versions): code and comments. Old names may be deprecated or replaced.
readable=()
for folder in include shim; do
  [[ ! -d $folder ]] || mapfile -t -O "${#readable[@]}" readable < <(find "$folder" -type f ! -name replaced_options.hpp)
done
[[ ! -f README.md ]] || readable+=(README.md)
[[ ! -d docs ]] || mapfile -t -O "${#readable[@]}" readable < <(find docs -path docs/design -prune -o -name '*.md' -print)

# nobody_writes PATTERN INSTEAD: without regard to upper and lower case.
nobody_writes() {
  grep -niHE "$1" "${readable[@]}" < /dev/null | grep -vF '[[deprecated(' |
    sed -E "s@^([^:]*:[0-9]+):.*@\1: another word: $2@" || true
}

offences=$({
  # The version is that of version.hpp wherever somebody else's format asks for it.
  if [[ -f include/stillpoint/version.hpp ]]; then
    version=$(sed -nE 's/^#define STILLPOINT_VERSION "(.*)"$/\1/p' include/stillpoint/version.hpp)
    [[ ! -f ros/ros2/package.xml ]] || grep -qF "<version>$version</version>" ros/ros2/package.xml ||
      echo "ros/ros2/package.xml:1: expected version $version, as in version.hpp"
    [[ ! -f CITATION.cff ]] || grep -qx "version: $version" CITATION.cff ||
      echo "CITATION.cff:1: expected version $version, as in version.hpp"
  fi
  awk 'FNR <= 3 && /SPDX-License-Identifier: MIT/ { marked[FILENAME] = 1 }
    END { for (i = 1; i < ARGC; ++i) if (!(ARGV[i] in marked)) print ARGV[i] ":1: no line \x27SPDX-License-Identifier: MIT\x27" }' \
    "${files[@]}"
  for file in "${programs[@]}"; do
    name=$(basename "$file" .cpp) lines=$(wc -l < "$file")
    ((lines <= ${longest_example[$name]:-0})) ||
      echo "$file:$lines: more than ${longest_example[$name]:-0} lines: an example shows one idea"
  done
  ((${#headers[@]} == 0)) || wc -l "${headers[@]}" | awk -v longest="$longest" '$2 != "total" && $1 > longest {
    print $2 ":" $1 ": more than " longest " lines: split it by idea" }'
  # Distributions of <random> differ between standard libraries, and global generators between runs.
  no_header_has '#include <random>|std::random_device|\b(rand|srand|theRNG)\(' 'random numbers come from core/random.hpp only'
  no_header_has 'std::(cout|cerr|clog)|\bf?printf\(' 'a guest prints nothing'
  # OpenCV 4.11 took the operators away from its vector types.
  no_header_has 'opencv2/core/hal/|CV_SIMD|\bv_u?(int|float)(8|16|32|64)(x[0-9]+)?\b' \
    'no universal intrinsics of OpenCV: loops that compilers vectorise, or Eigen'
  if ((${#readable[@]} > 0)); then
    nobody_writes 'trust' 'static prior, weight; of data: used, valid'
    nobody_writes 'suspic|suspect' 'dynamic prior'
    nobody_writes 'creep|crept' 'slow, moves slowly'
    nobody_writes 'restless|undisputed' 'the name of the quantity, and its unit'
    nobody_writes '\bthings?\b' 'object'
    nobody_writes '\bpictures?\b' 'image'
    nobody_writes '\b(what (moves?|stands?)|who stands? still)\b' 'dynamic, static features; moving objects'
    nobody_writes '\b(standing camera|camera that stands)\b' 'stationary camera'
    nobody_writes '\bsightings?\b' 'observation'
    nobody_writes '\bkey points?\b' 'keypoint'
    nobody_writes '\bpolish(ed|es|ing)?\b' 'refine'
    nobody_writes '\bfalse alarms?\b' 'false positives, false-positive rate'
    nobody_writes '[0-9] % (below|above)\b' '95th percentile'
    nobody_writes '(\b(px|pixels?|mm|cm|m|ms|nats|bytes?|MB|times|frames|images|features|call)|\)) an? (frame|second|feature|keypoint|pixel|iteration)\b' \
      'per frame, per second'
  fi
  # Whichever header a host includes: the first of ours to be read to its end is one that includes no other.
  find include -mindepth 3 -name '*.hpp' ! -name needs_cpp17.hpp -exec grep -L '^#include "stillpoint/' {} + |
    sed 's|$|:1: in C++14 not one error: include core/needs_cpp17.hpp|'
} | LC_ALL=C sort -t : -k 1,1 -k 2,2n)
[[ -z $offences ]] || { printf '%s\n' "$offences"; exit 1; }
