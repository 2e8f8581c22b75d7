# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""Dynamic feature rejection for visual SLAM: which of a frame's features stand still?"""

import enum
import os
from typing import Any, Iterable, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str

class Error(ValueError):
    """A wrong value: the message names it, what was found and what was expected."""

class Status(enum.IntEnum):
    """What can be said of a frame as a whole. Every status but `ok` means: not judged, all features are kept."""

    ok = 0
    first_frame = 1
    no_image = 2
    unsupported_image = 3
    depth_unit_missing = 4
    implausible_depth = 5
    size_changed = 6
    invalid_time = 7
    invalid_options = 8
    duplicate_frame = 9
    out_of_order = 10
    time_gap = 11
    no_keypoints = 12
    no_depth = 13
    too_few_matches = 14
    degenerate_geometry = 15
    no_consensus = 16

class FrameWarning(enum.IntEnum):
    """What is worth knowing of a frame beside its status. No warning changes a verdict."""

    rotation_only = 0
    consensus_inverted = 1
    keep_floor = 2
    depth_turned_over = 3
    depth_too_near = 4
    motion_too_fast = 5
    scale_differs = 6
    keypoints_in_one_quarter = 7
    keypoints_outside = 8
    times_far_apart = 9
    nothing_fits = 10
    depth_unsynchronised = 11
    depth_shape_differs = 12
    principal_point_aside = 13
    depth_shifted = 14

class Verdict(enum.IntEnum):
    """What a feature is, as far as can be told."""

    kept = 0
    dynamic = 1
    unknown = 2

class Reason(enum.IntEnum):
    """Why a feature was kept or dropped."""

    not_judged = 0
    outside_regions = 1
    static_cluster = 2
    moving_cluster = 3
    consistent = 4
    inconsistent = 5
    neighbours = 6
    remembered = 7
    no_match = 8
    no_depth = 9
    outside_image = 10
    keep_floor = 11
    object_motion = 12

class Mobility(enum.IntEnum):
    """What is known of an object's class: a wall is fixed, a chair is movable, a person is dynamic."""

    unknown = 0
    fixed = 1
    movable = 2
    dynamic = 3

class MoverState(enum.IntEnum):
    """What an object that was seen to move does now."""

    moving = 0
    parked = 1
    lost = 2

class Camera:
    """A camera with focal lengths and principal point in pixels."""

    def __init__(self, fx: float, fy: float, cx: float, cy: float, width: int, height: int, model: str = "pinhole",
                 distortion: Union[Sequence[float], npt.NDArray[np.float64]] = ()) -> None:
        """model is pinhole, brown_conrady (k1 k2 p1 p2 and optionally k3) or equidistant (k1 k2 k3 k4)."""
    @property
    def fx(self) -> float: ...
    @property
    def fy(self) -> float: ...
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...

class Motion:
    """How the camera moved between the reference frame and the current one."""

    @property
    def status(self) -> Status: ...
    @property
    def current_from_reference(self) -> npt.NDArray[np.float64]:
        """4 x 4, metres: p_current = current_from_reference @ p_reference."""
    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """6 x 6, of a small rotation (radians, first three) and translation (metres) after the pose."""
    @property
    def reference_timestamp_s(self) -> float: ...
    @property
    def metric(self) -> bool:
        """False: the translation has no scale."""
    @property
    def stationary(self) -> bool:
        """The camera did not move at all."""
    @property
    def standing(self) -> bool:
        """Deprecated: `stationary`."""
    @property
    def candidates(self) -> int:
        """Matches that took part."""
    @property
    def inliers(self) -> int:
        """Of them, those that the motion explains."""

class Mover:
    """An object that moves, or moved and is parked. Vectors are in the axes of the current camera: x right, y down, z
    forward."""

    @property
    def id(self) -> int:
        """From 1 on; kept while the object is seen and for two seconds after."""
    @property
    def state(self) -> MoverState:
        """Moving, parked, or lost: not seen in this frame, all else is predicted."""
    @property
    def box(self) -> Tuple[float, float, float, float]:
        """x, y, width and height around its features, pixels."""
    @property
    def centroid(self) -> npt.NDArray[np.float64]:
        """Of its points, in the current camera, metres."""
    @property
    def extent_m(self) -> npt.NDArray[np.float64]:
        """Of its points along the camera's axes."""
    @property
    def velocity(self) -> npt.NDArray[np.float64]:
        """Of the centroid relative to the world, m/s, by the filter's own motion."""
    @property
    def velocity_covariance(self) -> npt.NDArray[np.float64]:
        """3 x 3, (m/s)²."""
    @property
    def current_from_reference(self) -> npt.NDArray[np.float64]:
        """4 x 4, metres: where a point of the object in the last frame's camera is in the current one."""
    @property
    def covariance(self) -> npt.NDArray[np.float64]:
        """6 x 6, of a small rotation (radians, first three) and translation (metres) after that pose."""
    @property
    def has_rotation(self) -> bool:
        """Its points move rigidly and determine a rotation; otherwise it keeps its orientation in the world."""
    @property
    def class_index(self) -> int:
        """That of the detection that holds most of its features; -1 where none does."""
    @property
    def confidence(self) -> float:
        """Of that detection, 0 to 1."""
    @property
    def first_seen_s(self) -> float: ...
    @property
    def last_seen_s(self) -> float: ...
    @property
    def features(self) -> npt.NDArray[np.int64]:
        """Indices of its keypoints."""
    def mask(self, radius_px: int = 12) -> npt.NDArray[np.uint8]:
        """Of the image's size: 0 within radius_px of its features and of the filter's own corners on it, 255 elsewhere."""

class FrameResult:
    """The answer for one frame: arrays with one entry per keypoint, in their order. It owns them."""

    @property
    def keep(self) -> npt.NDArray[np.bool_]:
        """True keeps the feature."""
    @property
    def verdicts(self) -> npt.NDArray[np.uint8]:
        """Values of Verdict."""
    @property
    def reasons(self) -> npt.NDArray[np.uint8]:
        """Values of Reason."""
    @property
    def scores(self) -> npt.NDArray[np.float32]:
        """Disagreement with the camera's motion; NaN where the feature was not scored."""
    @property
    def probabilities(self) -> npt.NDArray[np.float32]:
        """That the feature moves, 0 to 1; NaN if unknown."""
    @property
    def weights(self) -> npt.NDArray[np.float32]:
        """Its weight in an estimate of the pose, 0 to 1."""
    @property
    def clusters(self) -> npt.NDArray[np.int32]:
        """Index of its cluster, -1 for none."""
    @property
    def depths_m(self) -> npt.NDArray[np.float64]:
        """Its depth in metres, 0 for none."""
    @property
    def movers(self) -> Tuple[Mover, ...]:
        """The objects that move, or moved and are parked; empty without FrameFilter(camera, movers=True)."""
    @property
    def mover_of(self) -> npt.NDArray[np.int32]:
        """Index in movers of the object that the feature is on, -1 for none."""
    @property
    def status(self) -> Status: ...
    @property
    def warnings(self) -> Tuple[FrameWarning, ...]:
        """What is worth knowing beside the status."""
    @property
    def hint(self) -> str:
        """What is probably wrong with the way the filter is used, one sentence; empty where nothing is."""
    @property
    def motion(self) -> Motion:
        """The camera's motion that the verdicts assumed."""
    @property
    def timings_ms(self) -> dict[str, float]:
        """Milliseconds that each stage took."""
    @property
    def kept_count(self) -> int: ...
    @property
    def keep_floor_kept(self) -> int:
        """How many dynamic features the keep-floor kept."""
    def mask(self, radius_px: int = 12) -> npt.NDArray[np.uint8]:
        """Of the image's size: 255 keeps, 0 within radius_px of a dropped feature."""
    def __len__(self) -> int: ...

class Detection:
    """What a detector saw: a box in pixels, corner (x, y) at the top left, and perhaps a mask that is stretched over it."""

    def __init__(self, x: float, y: float, width: float, height: float, mobility: int = Mobility.dynamic,
                 confidence: float = 1.0,
                 mask: Optional[Union[npt.NDArray[np.bool_], npt.NDArray[np.uint8]]] = None, class_index: int = -1) -> None: ...

class Options:
    """The options of a filter's stages, by the names in docs/tuning.md: filter.options.gate.false_positive_rate = 0.005.
    A value out of its range is an Error, and changes nothing."""

    def __getattr__(self, name: str) -> Any: ...
    def __setattr__(self, name: str, value: Union[bool, int, float, str]) -> None: ...
    def __dir__(self) -> list[str]: ...
    def as_dict(self) -> dict[str, Union[bool, int, float, str]]:
        """All of them by their full names, in the order of the table."""

class FrameFilter:
    """Tells which of a frame's features stand still, with DefaultPolicies. One filter for one camera. Threads may share
    it: calls wait for each other, and other threads run meanwhile."""

    def __init__(self, camera: Camera, movers: bool = False) -> None:
        """With movers, results also say which objects move, and how (docs/movers.md)."""
    def filter_frame(self, image: npt.NDArray[np.uint8],
                     depth: Optional[Union[npt.NDArray[np.uint16], npt.NDArray[np.float32]]], timestamp_s: float,
                     keypoints: Union[npt.NDArray[np.float32], npt.NDArray[np.float64], Sequence[Any]],
                     depth_factor: Optional[float] = None) -> FrameResult:
        """Judges the keypoints of a frame. Call it before the tracker, with frames in the order of time.

        image         uint8, (height, width) gray or (height, width, 3) BGR; not copied
        depth         uint16 with depth_factor, or float32 in metres, aligned to the image; or None; not copied
        timestamp_s   seconds, growing
        keypoints     float32 (N, 2) in pixels of the image as it is, or a list of cv2.KeyPoint
        depth_factor  what a depth of uint16 counts per metre: 1000 for millimetres, 5000 for TUM's files

        A frame that can't be judged has a status that says why, and keeps everything."""
    def predicted_keep_mask(self, timestamp_s: float, margin_px: int = 8) -> npt.NDArray[np.uint8]:
        """Where the coming frame should be looked at: of the camera's size, 255 keeps, 0 drops."""
    def feedback(self, world_from_camera: npt.NDArray[np.float64]) -> None:
        """The tracker's own pose of the frame that was filtered last, 4 x 4."""
    def expect_motion(self, current_from_reference: npt.NDArray[np.float64]) -> None:
        """What an IMU or wheels say of the coming motion, 4 x 4; for one frame."""
    def detected(self, timestamp_s: float, detections: Sequence[Detection]) -> None:
        """A detector's answer for the frame of that time, the coming one or one that is past. An empty list says that it
        saw nothing."""
    def reset(self) -> None:
        """Forgets all frames: where the images jump to another place, as when a recording begins again. Not for a
        relocalisation or a new map of the host: the images go on. Options stay."""
    @property
    def options(self) -> Options:
        """The options of all stages, as attributes."""
    def read_options(self, file: Union[str, os.PathLike[str]]) -> None:
        """Sets the options that a YAML file names; the others stay."""
    def write_options(self, file: Union[str, os.PathLike[str]]) -> None:
        """Writes all options as YAML."""

class ErrorStatistics:
    """Summary of a list of errors, in their unit; NaN where it is empty."""

    @property
    def count(self) -> int: ...
    @property
    def rmse(self) -> float: ...
    @property
    def mean(self) -> float: ...
    @property
    def median(self) -> float: ...
    @property
    def std(self) -> float: ...
    @property
    def min(self) -> float: ...
    @property
    def max(self) -> float: ...

class TrajectoryError:
    """Errors of a trajectory, in the order of time."""

    @property
    def timestamps_s(self) -> npt.NDArray[np.float64]: ...
    @property
    def translation_m(self) -> npt.NDArray[np.float64]: ...
    @property
    def rotation_deg(self) -> npt.NDArray[np.float64]: ...
    @property
    def translation(self) -> ErrorStatistics:
        """Statistics in metres."""
    @property
    def rotation(self) -> ErrorStatistics:
        """Statistics in degrees."""
    @property
    def status(self) -> str:
        """Of the alignment: ok, too_few_points, collinear or not_finite; then there are no errors."""
    @property
    def reference_from_estimate(self) -> npt.NDArray[np.float64]:
        """The alignment, 4 x 4, with its scale."""

class FilterScore:
    """How well verdicts agree with labels; None where nothing was counted."""

    @property
    def recall(self) -> Optional[float]:
        """Share of the moving features that were dropped."""
    @property
    def false_positive_rate(self) -> Optional[float]:
        """Share of the background's features that were dropped."""
    @property
    def parked_dropped(self) -> Optional[float]:
        """Share of the features on movers at rest that were dropped."""
    @property
    def moving(self) -> int: ...
    @property
    def background(self) -> int: ...
    @property
    def frames(self) -> int: ...

_Trajectory = Union[str, os.PathLike[str], npt.NDArray[np.float64]]

def read_camera(file: Union[str, os.PathLike[str]]) -> Tuple[Camera, float]:
    """Reads a camera.yaml (docs/your_camera.md): the camera, and what a 16-bit depth image counts per metre."""

def ate(reference: _Trajectory, estimate: _Trajectory, alignment: str = "se3",
        max_time_difference_s: float = 0.01) -> TrajectoryError:
    """Absolute trajectory error, as evo's ape. Trajectories are files or arrays (N, 8) of timestamp tx ty tz qx qy qz qw,
    world_from_camera. alignment is se3, sim3 or none."""

def rpe(reference: _Trajectory, estimate: _Trajectory, delta: float = 1.0, unit: str = "frames", pairs: str = "consecutive",
        max_time_difference_s: float = 0.01) -> TrajectoryError:
    """Relative trajectory error, as evo's rpe. delta is in unit, frames or metres; pairs are consecutive or all."""

def recall(frames: Iterable[Tuple[npt.NDArray[np.uint8], Any, npt.NDArray[np.bool_]]]) -> FilterScore:
    """Recall and false-positive rate over frames, each (labels, keypoints, keep). labels are uint8 (height, width):
    0 background, 255 moving, 128 a mover at rest, 64 not counted. The first frame is left out."""
