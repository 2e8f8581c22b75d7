// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A second camera beside the first: scenes as a stereo pair sees them.

#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/synthetic/scene.hpp"

namespace stillpoint::synthetic {

/// What a second camera of the same kind sees of the scene at the same moments, with noise of its own.
/// @param left_from_right  where it sits in the axes of the scene's camera; (baseline, 0, 0) and no turn is a pair that
///                         needs no rectification
inline Scene seen_from(const Scene& left, const Pose& left_from_right) {
  Scene right = left;
  right.camera_path.hand_from_camera = left.camera_path.hand_from_camera * left_from_right;
  right.seed = left.seed + 0x5eed;  // of pixel noise alone: textures are made
  return right;
}

/// The right camera of a rectified pair.
/// @throws Error unless the baseline is positive.
inline Scene right_of(const Scene& left, double baseline_m) {
  if (!(baseline_m > 0))
    throw Error("scene: baseline is " + std::to_string(baseline_m) + " m, expected a positive number");
  Pose left_from_right = Pose::Identity();
  left_from_right.translation().x() = baseline_m;
  return seen_from(left, left_from_right);
}

}  // namespace stillpoint::synthetic
