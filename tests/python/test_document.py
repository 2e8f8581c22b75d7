# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The Python of docs/python.md runs as it stands, block after block."""

import re
import shutil

import cv2
import numpy as np

from conftest import PROJECT


PAGE = PROJECT / "docs/python.md"


def test_blocks_run(reference, frames, tmp_path, monkeypatch):
    for name in ("groundtruth.txt", "estimate.txt"):
        shutil.copy(reference / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    frame = frames[0]
    gray, depth = (cv2.resize(image, (640, 480), interpolation=cv2.INTER_NEAREST) for image in (frame.gray, frame.depth))
    keypoints, descriptors = cv2.ORB_create(200).detectAndCompute(gray, None)
    names = dict(gray=gray, depth=depth, keypoints=keypoints, descriptors=descriptors, time_s=0.0, labels=np.zeros_like(gray),
                 current_from_reference=np.eye(4), world_from_camera=np.eye(4), x=10, y=20, width=100, height=200,
                 stillpoint=__import__("stillpoint"))
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    assert blocks
    for block in blocks:
        names["time_s"] += 0.1
        exec(compile(block, PAGE, "exec"), names)
