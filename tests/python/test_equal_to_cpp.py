# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""What Python says is what C++ says, bit for bit: on a rendered sequence, and on a recorded one."""

import platform
import subprocess
import sys

import cv2
import numpy as np
import pytest

import stillpoint
from conftest import read_frames

# tests/python/reference.cpp does the same at these frames.
EXPECTED_AT, DETECTED_AT, OPTION_AT, RESET_AT = 5, 9, 8, 11
FEATURE = np.dtype([("depth_m", "f8"), ("x", "f4"), ("y", "f4"), ("score", "f4"), ("probability", "f4"), ("weight", "f4"),
                    ("cluster", "i4"), ("keep", "u1"), ("verdict", "u1"), ("reason", "u1"), ("padding", "u1", 5)])

FIELDS = (("verdicts", "verdict"), ("reasons", "reason"), ("scores", "score"), ("clusters", "cluster"),
          ("probabilities", "probability"), ("weights", "weight"), ("depths_m", "depth_m"))


def assert_same_bits(found, expected, what):
    found, expected = np.ascontiguousarray(found), np.ascontiguousarray(expected)
    assert found.dtype == expected.dtype and found.shape == expected.shape, what
    assert found.tobytes() == expected.tobytes(), what


def numbers_of(mover):
    """All of a mover but its mask, in the order of reference.cpp."""
    return np.concatenate([np.ravel(value).astype(np.float64) for value in (
        mover.id, mover.state, mover.box, mover.centroid, mover.extent_m, mover.velocity, mover.velocity_covariance,
        mover.current_from_reference, mover.covariance, mover.has_rotation, mover.class_index, mover.confidence,
        mover.first_seen_s, mover.last_seen_s)])


def assert_same_movers(result, file, i):
    """@return what C++ says that there is in the frame"""
    content = file.read_bytes()
    count = int(np.frombuffer(content, np.float64, 1)[0])
    assert len(result.movers) == count, f"movers, frame {i}"
    numbers = np.frombuffer(content, np.float64, 81 * count, 8).reshape(count, 81)
    mover_of = np.frombuffer(content, np.float64, len(result), 8 + 8 * numbers.size).astype(np.int32)
    masks = np.frombuffer(content, np.uint8, -1, 8 + 8 * numbers.size + 8 * len(result))
    assert_same_bits(result.mover_of, mover_of, f"mover_of, frame {i}")
    for k, (mover, mask) in enumerate(zip(result.movers, masks.reshape(count, *result.mask().shape))):
        assert_same_bits(numbers_of(mover), numbers[k], f"mover {k}, frame {i}")
        assert_same_bits(mover.features, np.flatnonzero(mover_of == k), f"features of mover {k}, frame {i}")
        assert_same_bits(mover.mask(), mask, f"mask of mover {k}, frame {i}")
    return result.movers


@pytest.mark.parametrize("as_keypoints", [False, True], ids=["array", "cv2.KeyPoint"])
@pytest.mark.parametrize("in_metres", [False, True], ids=["uint16", "float32"])
@pytest.mark.parametrize("with_movers", [False, True], ids=["features", "movers"])
def test_each_feature_of_each_frame(reference, frames, camera, depth_factor, as_keypoints, in_metres, with_movers):
    frame_filter = stillpoint.FrameFilter(camera, movers=with_movers)
    if with_movers:
        reference = reference / "movers"
        frame_filter.options.movers.least_path_m = 0.003
        frame_filter.options.movers.least_path_sigmas = 1
    keypoints_of = cv2.ORB_create(400)
    statuses, movers = [], []
    for i, frame in enumerate(frames):
        features = np.fromfile(reference / f"features_{i:02}.bin", FEATURE)
        masks = np.fromfile(reference / f"masks_{i:02}.bin", np.uint8).reshape(2, *frame.gray.shape)
        numbers = np.fromfile(reference / f"poses_{i:02}.bin", np.float64)
        world_from_camera, true_motion, motion = numbers[:48].reshape(3, 4, 4)
        pixels = np.stack([features["x"], features["y"]], axis=1)
        assert_same_bits(frame.pixels, pixels, "cv2 finds other corners in Python than in C++")

        if i == OPTION_AT:
            frame_filter.options.gate.false_positive_rate = 0.02
        if i == RESET_AT:
            frame_filter.reset()
        if i == EXPECTED_AT:
            frame_filter.expect_motion(true_motion)
        if i == DETECTED_AT:
            frame_filter.detected(frame.timestamp_s, [stillpoint.Detection(0, 40, 100, 150, confidence=0.9, class_index=7)])
        predicted = frame_filter.predicted_keep_mask(frame.timestamp_s, 8)
        keypoints = keypoints_of.detect(frame.gray) if as_keypoints else frame.pixels
        if in_metres:
            depth, factor = (frame.depth / depth_factor).astype(np.float32), None
        else:
            depth, factor = frame.depth, depth_factor
        result = frame_filter.filter_frame(frame.gray, depth, frame.timestamp_s, keypoints, factor)
        frame_filter.feedback(world_from_camera)

        assert_same_bits(result.keep, features["keep"].astype(bool), f"keep, frame {i}")
        for name, field in FIELDS:
            assert_same_bits(getattr(result, name), features[field], f"{name}, frame {i}")
        assert_same_bits(predicted, masks[0], f"predicted_keep_mask, frame {i}")
        assert_same_bits(result.mask(), masks[1], f"mask, frame {i}")
        assert_same_bits(result.motion.current_from_reference, motion, f"motion, frame {i}")
        assert result.status == numbers[48]
        statuses.append(result.status)
        if with_movers:
            movers += assert_same_movers(result, reference / f"movers_{i:02}.bin", i)
        else:
            assert not result.movers and (result.mover_of == -1).all()
    assert statuses.count(stillpoint.Status.first_frame) == 2 and statuses.count(stillpoint.Status.ok) == len(frames) - 2
    if with_movers:
        assert len(movers) > 1 and movers[0].id == 1 and any(mover.class_index == 7 for mover in movers)


def test_figures(reference, frames):
    """Compiled twice: another processor than x86-64 may round otherwise."""
    lines = (line.split() for line in (reference / "figures.txt").read_text().splitlines())
    figures = {name: pytest.approx(float(value), rel=1e-12) for name, value in lines}
    for load in (str, lambda file: np.loadtxt(file)):
        truth, estimate = load(reference / "groundtruth.txt"), load(reference / "estimate.txt")
        ate, rpe = stillpoint.ate(truth, estimate), stillpoint.rpe(truth, estimate)
        assert ate.translation.rmse == figures["ate_rmse_m"]
        assert ate.rotation.median == figures["ate_rotation_median_deg"]
        assert rpe.translation.rmse == figures["rpe_rmse_m"]
    flags = [np.fromfile(reference / f"features_{i:02}.bin", FEATURE)["keep"].astype(bool) for i in range(len(frames))]
    score = stillpoint.recall((frame.labels, frame.pixels, keep) for frame, keep in zip(frames, flags))
    assert score.recall == figures["recall"]
    assert score.false_positive_rate == figures["false_positive_rate"]


def test_recorded_sequence(recorded, reference):
    """30 frames, bit for bit."""
    folder, count = recorded / "kitchen_walk", 30
    camera, factor = stillpoint.read_camera(str(folder / "camera.yaml"))
    frame_filter = stillpoint.FrameFilter(camera)
    orb = cv2.ORB_create(1000)
    dropped = 0
    for i, (time, gray, depth, _) in enumerate(read_frames(folder, count)):
        expected = np.fromfile(reference / f"recorded_{i:02}.bin", FEATURE)
        keypoints = orb.detect(gray)
        result = frame_filter.filter_frame(gray, depth, time, keypoints, factor)
        assert_same_bits(cv2.KeyPoint_convert(keypoints), np.stack([expected["x"], expected["y"]], axis=1), f"frame {i}")
        for name, field in FIELDS:
            assert_same_bits(getattr(result, name), expected[field], f"{name}, frame {i}")
        dropped += len(result) - result.kept_count
    assert i == count - 1 and dropped > 1000  # a person walks through the view


def test_beside_the_program(recorded, tmp_path):
    """The same frames against features.csv of `python -m stillpoint`. The program has a set of stages of its own: where
    the processor can multiply and add at once, a compiler may round the last digit of that otherwise."""
    folder, count = recorded / "kitchen_walk", 30
    subprocess.run([sys.executable, "-m", "stillpoint", "--tum", folder, "--backend", "none", "--frames", str(count),
                    "--out", tmp_path / "out", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    rows = iter((tmp_path / "out/features.csv").read_text().splitlines()[1:])
    camera, factor = stillpoint.read_camera(str(folder / "camera.yaml"))
    frame_filter = stillpoint.FrameFilter(camera)
    orb = cv2.ORB_create(1000)
    features = other = 0
    for time, gray, depth, _ in read_frames(folder, count):
        keypoints = orb.detect(gray)
        result = frame_filter.filter_frame(gray, depth, time, keypoints, factor)
        for keypoint, keep in zip(keypoints, result.keep):
            cells = next(rows).split(",")
            x, y = keypoint.pt
            assert float(cells[0]) == time and cells[1:3] == [f"{x:.5f}", f"{y:.5f}"]
            other += int(cells[3]) != keep
        features += len(keypoints)
    assert next(rows, None) is None
    assert other <= (0 if platform.machine() == "x86_64" else 0.005 * features)
