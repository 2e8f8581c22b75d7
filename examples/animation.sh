#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# animation.sh OUT.webp: makes docs/demo.webp, README's first picture, from the demo's video. After examples/demo.sh;
# takes python3-opencv and webp (Debian).
set -euo pipefail
(($# == 1)) || { echo 'usage: animation.sh OUT.webp' >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${STILLPOINT_RUN:-$root/build/demo/examples/stillpoint_run}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

bash "$root/tests/install_packages.sh" python3-opencv webp
"$program" --demo --quiet --features 500 --out "$work/run" --save-video "$work/demo.avi" > /dev/null

# Every third frame, as wide as a page of GitHub.
/usr/bin/python3 - "$work" << 'END'
import sys

import cv2

video, number = cv2.VideoCapture(f"{sys.argv[1]}/demo.avi"), 0
while True:
    is_there, frame = video.read()
    if not is_there:
        break
    if number % 3 == 0:
        height, width = 384, round(384 * frame.shape[1] / frame.shape[0])
        cv2.imwrite(f"{sys.argv[1]}/{number:04}.png", cv2.resize(frame, (width, height), interpolation=cv2.INTER_AREA))
    number += 1
END

frames=("$work"/[0-9]*.png)
last=${frames[-1]}
unset 'frames[-1]'
img2webp -loop 0 -lossy -q 60 -m 6 -mixed -d 100 "${frames[@]}" -d 2000 "$last" -o "$work/out.webp" > /dev/null
mv "$work/out.webp" "$1"
ls -l "$1"
