#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# file_rules_can_fail.sh FOLDER: makes a small tree in FOLDER that breaks each rule once; file_rules.sh must name them.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/file_rules.sh
rm -rf "$1" && mkdir -p "$1/include/stillpoint/core" "$1/tests" "$1/examples" && cd "$1"

licence='// SPDX-License-Identifier: MIT'
printf '%s\n' "$licence" '#include <cmath>' > include/stillpoint/good.hpp
printf '%s\n' '#pragma once' > include/stillpoint/nobodys.hpp
printf '%s\n' "$licence" '#include <random>' 'int dice() { return rand(); }' > include/stillpoint/gambler.hpp
printf '%s\n' "$licence" 'void f() { std::cerr << 1; }' > include/stillpoint/talker.hpp
printf '%s\n' "$licence" '#include <opencv2/core/hal/intrin.hpp>' 'cv::v_float32x4 four();' \
  '#if __has_include("opencv2/core/hal/intrin.hpp")' > include/stillpoint/vectors.hpp
{ echo "$licence"; printf '//%.0s\n' {1..300}; } > include/stillpoint/long.hpp
{ echo "$licence"; printf '//%.0s\n' {1..40}; } > examples/01_minimal.cpp
printf '%s\n' "$licence" > examples/02_opencv_tracker.cpp
printf '%s\n' "$licence" > examples/99_unknown.cpp
printf '%s\n' "$licence" '#include <optional>' > include/stillpoint/core/leaf.hpp
printf '%s\n' "$licence" '#include "stillpoint/core/leaf.hpp"' > include/stillpoint/core/branch.hpp
printf '%s\n' 'true' > tests/nobodys.sh
printf '%s\n' "$licence" 'void f() { std::cerr << 1; }' > tests/may_talk.cpp

bash "$rules" "$PWD" > found && { echo 'the rules were broken and nothing was said'; exit 1; }
diff - <(cut -d: -f1,2 found) << 'EXPECTED' || { echo 'expected (<) is not what was found (>)'; exit 1; }
examples/01_minimal.cpp:41
examples/99_unknown.cpp:1
include/stillpoint/core/leaf.hpp:1
include/stillpoint/gambler.hpp:2
include/stillpoint/gambler.hpp:3
include/stillpoint/long.hpp:301
include/stillpoint/nobodys.hpp:1
include/stillpoint/talker.hpp:2
include/stillpoint/vectors.hpp:2
include/stillpoint/vectors.hpp:3
include/stillpoint/vectors.hpp:4
tests/nobodys.sh:1
EXPECTED
echo 'all offences were found'
