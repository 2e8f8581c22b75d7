# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""Dynamic feature rejection for visual SLAM: which of a frame's features stand still?

    frame_filter = stillpoint.FrameFilter(stillpoint.Camera(fx, fy, cx, cy, width, height))
    result = frame_filter.filter_frame(gray, depth, timestamp_s, keypoints, depth_factor=1000)
    keypoints = keypoints[result.keep]
"""

from ._core import (Camera, Detection, Error, ErrorStatistics, FilterScore, FrameFilter, FrameResult, FrameWarning, Mobility,
                    Motion, Mover, MoverState, Options, Reason, Status, TrajectoryError, Verdict, __version__, ate, read_camera, recall, rpe)

__all__ = ["Camera", "Detection", "Error", "ErrorStatistics", "FilterScore", "FrameFilter", "FrameResult", "FrameWarning",
           "Mobility", "Motion", "Mover", "MoverState", "Options", "Reason", "Status", "TrajectoryError", "Verdict",
           "__version__", "ate", "read_camera", "recall", "rpe"]
