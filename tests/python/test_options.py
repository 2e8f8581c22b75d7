# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""Options as attributes: all that docs/tuning.md lists, and nothing else."""

import re

import numpy as np
import pytest

import stillpoint
from conftest import PROJECT


@pytest.fixture
def options():
    return stillpoint.FrameFilter(stillpoint.Camera(525, 525, 320, 240, 640, 480)).options


def option(options, name):
    *groups, last = name.split(".")
    for group in groups:
        options = getattr(options, group)
    return options, last


def table():
    """Rows of docs/tuning.md: name, range, default."""
    page = (PROJECT / "docs/tuning.md").read_text().split("All options of")[1]
    return [[cell.strip(" `") for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("| `")]


def test_each_option_of_the_document(options):
    documented = {}
    for name, _, allowed, default, _ in table():
        group, last = option(options, name)
        if name.startswith("depth_noise.") and last not in ("model", "scale"):
            options.depth_noise.model = "tof" if last in ("constant_m", "per_metre") else "stereo"
        value = getattr(group, last)
        documented[name] = value
        assert str(value) == default or value == float(default), name
        setattr(group, last, value)
        assert getattr(group, last) == value
        options.depth_noise.model = "kinect"
        if " to " not in allowed:
            continue
        least, most = (float(number) for number in allowed.split(" to "))
        for wrong in (type(value)(least) - 1, type(value)(most) + 1):
            if last in ("constant_m", "per_metre"):
                options.depth_noise.model = "tof"
            elif last in ("focal_px", "baseline_m", "disparity_sigma_px"):
                options.depth_noise.model = "stereo"
            with pytest.raises(stillpoint.Error, match=rf"^{re.escape(name)} is .*, expected a (whole )?number from"):
                setattr(group, last, wrong)
            assert getattr(group, last) == value
            options.depth_noise.model = "kinect"
    missing = {"depth_noise." + name for name in ("focal_px", "baseline_m", "disparity_sigma_px", "constant_m", "per_metre")}
    assert list(options.as_dict()) == [name for name in documented if name not in missing]


@pytest.mark.parametrize("name, value, words", [
    ("gate.false_positive_rate", 5, "gate.false_positive_rate is 5, expected a number from 0.000001 to 0.5"),
    ("gate.false_positive_rate", float("nan"), "gate.false_positive_rate is nan, expected a number"),
    ("gate.false_positive_rate", "0.01", "gate.false_positive_rate is '0.01', expected a number"),
    ("gate.false_positive_rate", True, "gate.false_positive_rate is True, expected a number"),
    ("matcher.corners.cell_px", 24.0, "matcher.corners.cell_px is 24, expected a whole number from 8 to 512"),
    ("matcher.corners.cell_px", -1, "matcher.corners.cell_px is -1, expected a whole number from 8 to 512"),
    ("keep_floor.fewest_features", 2**80, "keep_floor.fewest_features is .*, expected a whole number from 0 to 1000000"),
    ("keep_floor.fewest_features", -1, "keep_floor.fewest_features is -1, expected a whole number"),
    ("ego_motion.seed", -1, "ego_motion.seed is -1, expected a whole number from 0 to 18446744073709551615"),
    ("ego_motion.seed", 2**64, "ego_motion.seed is .*, expected a whole number"),
    ("classifier.dynamic_shift", 10**400, "classifier.dynamic_shift is inf, expected a number"),
    ("classifier.dynamic_shift", -10**400, "classifier.dynamic_shift is -inf, expected a number"),
    ("depth_noise.model", "lidar", "depth_noise.model is 'lidar', expected kinect or stereo or tof"),
    ("depth_noise.model", 1, "depth_noise.model is 1, expected kinect or stereo or tof"),
])
def test_wrong_values_change_nothing(options, name, value, words):
    before = options.as_dict()
    group, last = option(options, name)
    with pytest.raises(stillpoint.Error, match="^" + words):
        setattr(group, last, value)
    assert options.as_dict() == before


def test_names(options):
    for call in (lambda: options.gatte, lambda: setattr(options, "gatte", 1), lambda: setattr(options, "gate", 1),
                 lambda: setattr(options.gate, "rate", 1), lambda: options.gate.false_positive_rate_):
        with pytest.raises(AttributeError, match="is unknown, expected one of|is a group"):
            call()
    with pytest.raises(TypeError, match="gate.false_positive_rate is NoneType, expected a number"):
        options.gate.false_positive_rate = None
    assert not hasattr(options, "gatte") and hasattr(options, "gate")
    assert dir(options.matcher) == ["corners", "older"]
    assert "matcher.corners.cell_px = 24\n" in repr(options)
    options.ego_motion.seed = 2**64 - 1
    assert options.ego_motion.seed == 2**64 - 1
    options.matcher.corners.cell_px = np.int32(32)
    options.gate.false_positive_rate = np.float32(0.25)
    assert options.matcher.corners.cell_px == 32 and options.gate.false_positive_rate == 0.25
    options.depth_noise.model = "stereo"
    options.depth_noise.baseline_m = 0.05
    assert options.depth_noise.baseline_m == 0.05 and "constant_m" not in dir(options.depth_noise)


def test_options_outlive_nothing():
    """The options of a filter that nobody holds any more are still its own."""
    options = stillpoint.FrameFilter(stillpoint.Camera(525, 525, 320, 240, 640, 480)).options.gate
    options.false_positive_rate = 0.125
    assert options.false_positive_rate == 0.125


def test_movers(tmp_path):
    """Their options are there where movers are, and in no file of a filter without, which skips them in a file."""
    camera = stillpoint.Camera(525, 525, 320, 240, 640, 480)
    without, with_movers = stillpoint.FrameFilter(camera), stillpoint.FrameFilter(camera, movers=True)
    assert not hasattr(without.options, "movers")
    with_movers.options.movers.least_path_m = 0.05
    assert with_movers.options.as_dict()["movers.least_path_m"] == 0.05
    with pytest.raises(stillpoint.Error, match="^movers.remembered_s is -1, expected a number from 0 to 3600"):
        with_movers.options.movers.remembered_s = -1
    without.write_options(tmp_path / "without.yaml")
    with_movers.read_options(tmp_path / "without.yaml")
    assert with_movers.options.movers.least_path_m == 0.05
    with_movers.write_options(tmp_path / "with.yaml")
    with_movers.options.gate.false_positive_rate = 0.005
    with_movers.write_options(tmp_path / "with.yaml")
    without.read_options(tmp_path / "with.yaml")
    assert without.options.gate.false_positive_rate == 0.005


def test_files(tmp_path):
    camera = stillpoint.Camera(525, 525, 320, 240, 640, 480)
    one, other = stillpoint.FrameFilter(camera), stillpoint.FrameFilter(camera)
    one.options.gate.false_positive_rate = 0.005
    one.options.depth_noise.model = "tof"
    one.write_options(str(tmp_path / "options.yaml"))
    other.read_options(str(tmp_path / "options.yaml"))
    assert other.options.as_dict() == one.options.as_dict()
    (tmp_path / "wrong.yaml").write_text("gate:\n  false_positive_rate: 5\n")
    with pytest.raises(stillpoint.Error, match="wrong.yaml.*gate.false_positive_rate is 5, expected a number"):
        other.read_options(str(tmp_path / "wrong.yaml"))
    assert other.options.as_dict() == one.options.as_dict()
