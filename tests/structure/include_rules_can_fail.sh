#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# include_rules_can_fail.sh FOLDER: makes a small tree in FOLDER with one offence against each rule, and one lawful
# include beside each; include_rules.sh must name exactly the offences, with file and line.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/include_rules.sh
rm -rf "$1" && mkdir -p "$1/include/stillpoint" && cd "$1"

# header FILE LAWFUL FORBIDDEN: the forbidden include is on line 2.
header() {
  mkdir -p "$(dirname "include/stillpoint/$1")"
  printf '#include %s\n  #  include %s  // why not\n' "$2" "$3" > "include/stillpoint/$1"
  [[ -z $3 ]] || printf 'include/stillpoint/%s:2: %s\n' "$1" "$3" >> expected
}
: > expected
header movers/a.hpp '"stillpoint/cluster/k_means.hpp"' '"stillpoint/motion/kabsch.hpp"'
header core/a.hpp '<Eigen/Core>' '<opencv2/core.hpp>'
header core/b.hpp '<cstdint>' '"stillpoint/prior/box_prior.hpp"'
header core/c.hpp '<vector>' '<Eigen/Dense>'
header depth/a.hpp '"stillpoint/core/frame.hpp"' '"stillpoint/pipeline/frame_history.hpp"'
header pipeline/a.hpp '"stillpoint/depth/depth_lookup.hpp"' '"stillpoint/match/past_reprojection.hpp"'
header motion/rigid/a.hpp '"stillpoint/motion/ransac.hpp"' '"stillpoint/motion/epipolar/essential.hpp"'
header motion/epipolar/a.hpp '"stillpoint/motion/epipolar/essential.hpp"' '"stillpoint/motion/rigid/inertia.hpp"'
header motion/b.hpp '"stillpoint/pipeline/frame_history.hpp"' '"stillpoint/motion/rigid/inertia.hpp"'
header gate/a.hpp '"stillpoint/core/score.hpp"' '"stillpoint/score/offset_score.hpp"'
header match/a.hpp '"stillpoint/opencv.hpp"' '"stillpoint/filter_frame.hpp"'
header match/b.hpp '<opencv2/video/tracking.hpp>' '"../core/span.hpp"'
header motion/a.hpp '"stillpoint/motion/b.hpp"' '"stillpoint/stillpoint.hpp"'
header io/a.hpp '"stillpoint/evaluation/trajectory.hpp"' '"stillpoint/detectors/mobility_table.hpp"'
header core/d.hpp '<vector>' '<yaml-cpp/parser.h>'
header options/a.hpp '"stillpoint/io/yaml_file.hpp"' '<yaml-cpp/parser.h>'
header evaluation/a.hpp '"stillpoint/core/span.hpp"' '"stillpoint/io/table_reader.hpp"'
header synthetic/a.hpp '"stillpoint/core/random.hpp"' '"backends/klt.hpp"'
header detectors/a.hpp '<opencv2/dnn.hpp>' '"stillpoint/match/lucas_kanade.hpp"'
header adapters/a.hpp '<System.h>' '"stillpoint/io/tum_sequence.hpp"'
header newcomer/a.hpp '<cmath>' '"stillpoint/core/span.hpp"'
header filtered_tracker.hpp '"stillpoint/verdict/weights.hpp"' '"stillpoint/filter_frame.hpp"'
header opencv.hpp '<opencv2/core/mat.hpp>' '"stillpoint/match/lucas_kanade.hpp"'
header filter_frame.hpp '"stillpoint/core/camera.hpp"' '"stillpoint/gate/mean_gate.hpp"'
header policies.hpp '"stillpoint/gate/mean_gate.hpp"' '"stillpoint/io/camera_file.hpp"'
header stillpoint.hpp '"stillpoint/policies.hpp"' '"stillpoint/evaluation/trajectory.hpp"'
header version.hpp '<cstddef>' '<string>'
header fwd.hpp '"stillpoint/core/camera.hpp"' '<Eigen/Core>'
# Three whose first line is forbidden as well: nothing is lawful there.
printf 'include/stillpoint/%s\n' 'newcomer/a.hpp:1: <cmath>' 'version.hpp:1: <cstddef>' \
  'fwd.hpp:1: "stillpoint/core/camera.hpp"' >> expected

bash "$rules" "$PWD" > found 2> /dev/null && { echo 'the rules were broken and nothing was said'; exit 1; }
sed -E 's/^([^:]*:[0-9]+: [^:]*): .*/\1/' found | LC_ALL=C sort > found_places
LC_ALL=C sort expected | diff - found_places || { echo 'expected (<) is not what was found (>)'; exit 1; }
echo "all $(wc -l < expected) offences were found"
