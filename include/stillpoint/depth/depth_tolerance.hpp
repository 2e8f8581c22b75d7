// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which depths belong to one surface?

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// How much depth may differ on one surface: what the surface is rough by, and the sensor's noise. For a Kinect five
/// standard deviations are within 5 % of what was chosen with one, 0.0076 metres per square metre of depth, from 1 m to
/// 4 m.
struct DepthTolerance {
  double roughness_m = 0.05;
  double sigmas = 5.0;

  /// @param depth_sigma_m  of one depth, metres
  constexpr double at(double depth_sigma_m) const noexcept { return roughness_m + sigmas * depth_sigma_m; }
};

}  // namespace stillpoint
