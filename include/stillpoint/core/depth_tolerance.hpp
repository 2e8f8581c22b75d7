// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which depths belong to one surface?

namespace stillpoint {

/// How much depth may differ on one surface: a constant and a part that grows as depth noise does.
struct DepthTolerance {
  double constant_m = 0.05;
  double per_square_m = 0.0076;  ///< metres per square metre of depth: four Kinect sigmas

  double at(double depth_m) const noexcept { return constant_m + per_square_m * depth_m * depth_m; }
};

}  // namespace stillpoint
