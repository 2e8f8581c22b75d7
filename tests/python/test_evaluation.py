# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""Figures that are known by hand, evo's for recorded trajectories, and what is no trajectory."""

import csv

import numpy as np
import pytest

import stillpoint


def straight(count=5, step=1.0):
    """Along x, one pose per second, without rotation."""
    rows = np.zeros((count, 8))
    rows[:, 0] = np.arange(count)
    rows[:, 1] = step * np.arange(count)
    rows[:, 2] = [0.1 * (i % 2) for i in range(count)]  # not on a line: the alignment is known
    rows[:, 7] = 1
    return rows


def test_errors_by_hand():
    truth = straight()
    assert stillpoint.ate(truth, truth).translation.rmse == pytest.approx(0, abs=1e-12)
    moved = truth.copy()
    moved[:, 3] += 2  # another origin is no error
    assert stillpoint.ate(truth, moved).translation.max == pytest.approx(0, abs=1e-9)
    assert stillpoint.ate(truth, moved, alignment="none").translation.mean == pytest.approx(2)
    longer = truth.copy()
    longer[:, 1:4] *= 1.5
    scaled = stillpoint.ate(truth, longer, alignment="sim3")
    assert scaled.translation.rmse == pytest.approx(0, abs=1e-9)
    assert np.linalg.det(scaled.reference_from_estimate[:3, :3]) == pytest.approx(1.5**-3)
    step = stillpoint.rpe(straight(step=1.0), straight(step=1.25))
    assert step.translation.count == 4 and step.translation.rmse == pytest.approx(0.25)
    assert list(step.timestamps_s) == [1, 2, 3, 4] and step.rotation_deg.max() == 0
    assert stillpoint.rpe(truth, truth, delta=2, unit="metres", pairs="all").translation.count > 0


def test_nothing_to_compare():
    apart = straight()
    apart[:, 0] += 100
    error = stillpoint.ate(straight(), apart)
    assert error.status == "too_few_points" and error.translation.count == 0 and np.isnan(error.translation.rmse)
    assert stillpoint.ate(np.empty((0, 8)), straight()).status == "too_few_points"


def test_figures_of_evo(recorded):
    folder = recorded / "trajectories"
    with open(folder / "expected.csv", newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    for row in rows:
        pair = folder / row["reference"], folder / row["estimate"]
        if row["metric"] == "ape":
            error = stillpoint.ate(*pair, alignment=row["alignment"])
        else:
            delta, unit = row["delta"].split()
            error = stillpoint.rpe(*pair, float(delta), "metres" if unit == "m" else unit, row["pairs"])
        found = error.translation if row["quantity"] == "translation_m" else error.rotation
        assert found.count == int(row["count"])
        for name in ("rmse", "mean", "median", "std", "min", "max"):
            assert getattr(found, name) == pytest.approx(float(row[name]), abs=1e-8), (row, name)  # it has nine decimals
    assert rows


@pytest.mark.parametrize("wrong, error, words", [
    (np.zeros((3, 7)), stillpoint.Error, r"estimate has shape \(3, 7\), expected \(N, 8\): timestamp tx ty tz"),
    (np.zeros((3, 8)), stillpoint.Error, "estimate, row 0 has a quaternion of length zero"),
    (np.full((3, 8), np.nan), stillpoint.Error, "estimate, row 0 is not finite"),
    (straight()[::-1], stillpoint.Error, "estimated trajectory: timestamp of pose 1 is 3.0*, expected a finite time"),
    ([1, 2], TypeError, "estimate is list, expected a file, or a NumPy array"),
    ("/none.txt", stillpoint.Error, "/none.txt"),
])
def test_wrong_trajectories(wrong, error, words):
    for figure in (stillpoint.ate, stillpoint.rpe):
        with pytest.raises(error, match=words):
            figure(straight(), wrong)


def test_wrong_words():
    with pytest.raises(stillpoint.Error, match="alignment is 'se2', expected none or se3 or sim3"):
        stillpoint.ate(straight(), straight(), alignment="se2")
    with pytest.raises(stillpoint.Error, match="unit is 'm', expected frames or metres"):
        stillpoint.rpe(straight(), straight(), unit="m")
    with pytest.raises(stillpoint.Error, match="delta is 0.5.*, expected a whole number of frames"):
        stillpoint.rpe(straight(), straight(), delta=0.5)


def test_recall_by_hand():
    labels = np.zeros((10, 20), np.uint8)
    labels[:, 10:] = 255
    labels[:, 18:] = 128
    pixels = np.array([[1, 1], [2, 2], [11, 3], [12, 4], [13, 5], [14, 6], [19, 1], [40, 1]], np.float32)
    keep = np.array([True, False, False, False, False, True, False, False])
    score = stillpoint.recall([(labels, pixels, ~keep), (labels, pixels, keep)])  # the first is left out
    assert (score.recall, score.false_positive_rate, score.parked_dropped) == (0.75, 0.5, 1.0)
    assert (score.moving, score.background, score.frames) == (4, 2, 2)
    assert stillpoint.recall([]).recall is None
    for wrong, error, words in (
            ((labels, pixels, keep[:3]), stillpoint.Error, "8 features and 3 verdicts, expected as many of each"),
            ((labels, pixels, keep.astype(np.uint8)), TypeError, "keep has dtype uint8, expected bool"),
            ((labels + 1, pixels, keep), stillpoint.Error, "label 1, expected 0, 64, 128 or 255"),
            ((labels, pixels), TypeError, r"frame 1 is tuple, expected \(labels, keypoints, keep\)")):
        with pytest.raises(error, match=words):
            stillpoint.recall([(labels, pixels, keep), wrong])
