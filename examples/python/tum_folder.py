# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""tum_folder.py FOLDER: ORB features of an RGB-D recording, in the layout of the TUM benchmark, behind the filter."""

import pathlib
import sys

import cv2
import stillpoint

folder = pathlib.Path(sys.argv[1])
camera, depth_factor = stillpoint.read_camera(folder / "camera.yaml")
frame_filter = stillpoint.FrameFilter(camera)
orb = cv2.ORB_create(1000)
matcher = cv2.BFMatcher(cv2.NORM_HAMMING, crossCheck=True)
last = None  # descriptors of the frame before


def rows(name):
    return [row.split() for row in (folder / name).read_text().splitlines() if row and not row.startswith("#")]


depths = rows("depth.txt")
for time_s, image_file in rows("rgb.txt"):
    depth_time_s, depth_file = min(depths, key=lambda row: abs(float(row[0]) - float(time_s)))
    if abs(float(depth_time_s) - float(time_s)) > 0.02:
        continue  # an image without depth
    image = cv2.imread(str(folder / image_file))
    depth = cv2.imread(str(folder / depth_file), cv2.IMREAD_UNCHANGED)  # uint16
    keypoints, descriptors = orb.detectAndCompute(image, None)
    if descriptors is None:
        print(f"{time_s}: no features")  # a dark image, for example
        continue
    result = frame_filter.filter_frame(image, depth, float(time_s), keypoints, depth_factor)
    descriptors = descriptors[result.keep]
    matches = matcher.match(descriptors, last) if last is not None else []
    last = descriptors
    print(f"{time_s}: {result.kept_count} of {len(result)} features are static, {len(matches)} matches "
          f"({result.status.name}) {result.hint}")
