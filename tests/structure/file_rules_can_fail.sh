#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# file_rules_can_fail.sh FOLDER: makes a small tree in FOLDER that breaks each rule once; file_rules.sh must name them.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/file_rules.sh
rm -rf "$1" && mkdir -p "$1"/{docs/{design,hosts},examples,include/stillpoint/{core,options},shim,tests} && cd "$1"

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

# One line for each word that is refused; below, what may use them.
printf '%s\n' "$licence" '#include <cmath>' 'float space_trust;' '/// Suspicion, 0 to 1' 'bool is_suspect;' \
  'double kCreepGain;' '// It crept along.' 'float restlessness;' '// Things have names.' '// a picture' \
  '// What moves now' '// learned from what stands still' '// who stand still' '// The standing camera' \
  'struct Sighting {};' '// key points' '// polished' '// false alarms' '// 95 % below 1 px' '// 2 px a frame' \
  '// O(n) an iteration' > include/stillpoint/words.hpp
printf '%s\n' '# A guide' 'Trust it.' > docs/guide.md
printf '%s\n' 'Trust it.' > docs/hosts/host.md
printf '%s\n' 'Trust it.' > README.md
printf '%s\n' 'Trust it.' > shim/README.md
printf '%s\n' "$licence" '#include <cmath>' 'using Sighting [[deprecated("Observation")]] = Observation;' \
  '// Nothing or something is anything; a moment a frame shows, whatever moves.' > include/stillpoint/old.hpp
printf '%s\n' "$licence" '#include "stillpoint/core/leaf.hpp"' '{"gate.trusted", "gone"},' \
  > include/stillpoint/options/replaced_options.hpp
printf '%s\n' 'Trust it.' > docs/design/history.md
printf '%s\n' 'Trust it.' > CHANGELOG.md

bash "$rules" "$PWD" > found && { echo 'the rules were broken and nothing was said'; exit 1; }
diff - <(cut -d: -f1,2 found) << 'EXPECTED' || { echo 'expected (<) is not what was found (>)'; exit 1; }
README.md:1
docs/guide.md:2
docs/hosts/host.md:1
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
include/stillpoint/words.hpp:3
include/stillpoint/words.hpp:4
include/stillpoint/words.hpp:5
include/stillpoint/words.hpp:6
include/stillpoint/words.hpp:7
include/stillpoint/words.hpp:8
include/stillpoint/words.hpp:9
include/stillpoint/words.hpp:10
include/stillpoint/words.hpp:11
include/stillpoint/words.hpp:12
include/stillpoint/words.hpp:13
include/stillpoint/words.hpp:14
include/stillpoint/words.hpp:15
include/stillpoint/words.hpp:16
include/stillpoint/words.hpp:17
include/stillpoint/words.hpp:18
include/stillpoint/words.hpp:19
include/stillpoint/words.hpp:20
include/stillpoint/words.hpp:21
shim/README.md:1
tests/nobodys.sh:1
EXPECTED
echo 'all offences were found'
