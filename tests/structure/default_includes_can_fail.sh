#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# default_includes_can_fail.sh FOLDER: makes a small tree in FOLDER; default_includes.sh must pass it, then name what is
# drawn in behind two headers, and refuse a tree in which it finds next to nothing.
set -euo pipefail
rules=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/default_includes.sh
headers=$1/include/stillpoint
rm -rf "$1"
mkdir -p "$headers/core"
for i in {1..25}; do
  echo "#include <opencv2/core/mat.hpp>" > "$headers/core/header$i.hpp"
  echo "#include \"stillpoint/core/header$i.hpp\"" >> "$headers/stillpoint.hpp"
done

# expect STATUS TEXT: what the check does with the tree as it is.
expect() {
  local status=0 output
  output=$(bash "$rules" "$folder" 2>&1) || status=$?
  [[ $status == "$1" && $output == "$2" ]] || { echo "expected $1 '$2', found $status '$output'"; exit 1; }
}
folder=$1
expect 0 ''
echo '#include <opencv2/video/tracking.hpp>' >> "$headers/core/header7.hpp"
echo '#include "stillpoint/motion/epipolar/fundamental.hpp"' >> "$headers/core/header9.hpp"
expect 1 'stillpoint/core/header7.hpp: draws opencv2/video/tracking.hpp into stillpoint.hpp
stillpoint/core/header9.hpp: draws stillpoint/motion/epipolar/fundamental.hpp into stillpoint.hpp'
echo '#include "stillpoint/core/header1.hpp"' > "$headers/stillpoint.hpp"
expect 1 'only 2 headers found behind stillpoint.hpp, expected more than 20'
