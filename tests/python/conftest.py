# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The rendered sequence that the program `reference` wrote, and recorded ones where they are."""

import os
import pathlib
from typing import NamedTuple

import cv2
import numpy as np
import pytest

import stillpoint

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class Frame(NamedTuple):
    timestamp_s: float
    gray: np.ndarray
    depth: np.ndarray
    labels: np.ndarray
    pixels: np.ndarray  # float32, N x 2


def read_frames(folder, count=None):
    """Frames of a folder in the layout of the TUM benchmark: time, gray, depth, labels or None."""
    rows = [line.split() for line in (folder / "associations.txt").read_text().splitlines() if not line.startswith("#")]
    for time, rgb, _, depth in rows[:count]:
        # Gray as stillpoint_run makes it: of the decoded colours, not of the luma in a JPEG.
        gray = cv2.cvtColor(cv2.imread(str(folder / rgb)), cv2.COLOR_BGR2GRAY)
        labels = folder / "labels" / pathlib.Path(rgb).name
        yield (float(time), gray, cv2.imread(str(folder / depth), cv2.IMREAD_UNCHANGED),
               cv2.imread(str(labels), cv2.IMREAD_UNCHANGED) if labels.is_file() else None)


@pytest.fixture(scope="session")
def reference():
    """The folder that `reference` wrote."""
    return pathlib.Path(os.environ["STILLPOINT_REFERENCE"])


@pytest.fixture(scope="session")
def frames(reference):
    orb = cv2.ORB_create(400)
    return [Frame(time, gray, depth, labels, cv2.KeyPoint_convert(orb.detect(gray)))
            for time, gray, depth, labels in read_frames(reference)]


@pytest.fixture(scope="session")
def camera(reference):
    return stillpoint.read_camera(str(reference / "camera.yaml"))[0]


@pytest.fixture(scope="session")
def depth_factor(reference):
    return stillpoint.read_camera(str(reference / "camera.yaml"))[1]


@pytest.fixture
def frame_filter(camera):
    return stillpoint.FrameFilter(camera)


@pytest.fixture(scope="session")
def recorded():
    """The folder of recorded sequences."""
    folder = pathlib.Path(os.environ.get("STILLPOINT_SHARED_DATA", PROJECT.parent / "shared/data"))
    if not folder.is_dir():
        pytest.skip(f"no recorded sequences in {folder}")
    return folder
