// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How the camera moved between the reference frame and the current one.

#include <limits>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/status.hpp"
#include "stillpoint/core/warnings.hpp"

namespace stillpoint {

/// The answer of an ego-motion policy.
struct Motion {
  Status status = Status::first_frame;
  Warnings warnings;                               ///< rotation_only, consensus_inverted
  Pose current_from_reference = Pose::Identity();  ///< metres
  /// Of a small rotation (radians, first three) and translation (metres, last three) applied after the pose, in the
  /// current camera's frame: p_current = Exp(ω) (R p_reference + t) + v. Units: rad², rad m, m².
  Matrix6d covariance = Matrix6d::Zero();
  /// What the covariance is over that of constraints that are wrong independently of each other; 1 where nobody says.
  /// Neighbouring corners share errors of depth, of blur, of a rolling shutter.
  double correlation = 1;
  double reference_timestamp_s = std::numeric_limits<double>::quiet_NaN();
  bool metric = true;       ///< false: nobody knows the scale; the translation is a direction of length 1, or zero
  bool stationary = false;  ///< the camera did not move at all: the pose is the identity, not an estimate
  bool doubtful = false;    ///< few matches support it, and their depths differ by more than noise explains
  double pixel_sigma = 0;   ///< of the matches that support it, measured; pixels, 0 where nobody says
  double depth_noise = 1;  ///< of depths that support it, measured, over what the noise model says; 1 where nobody says
  int candidates = 0;      ///< matches that took part
  int inliers = 0;         ///< of them, those that the motion explains

  bool usable() const noexcept { return judged(status); }

  /// It is not known after all: what it was measured from stays.
  void refuse(Status why) noexcept {
    status = why;
    warnings = {};
    current_from_reference = Pose::Identity();
    covariance.setZero();
    correlation = 1;
    inliers = 0;
  }
};

/// What the host, an IMU or the last frame expects of the motion.
struct MotionPrior {
  std::optional<Pose> current_from_reference;
  bool stationary = true;  ///< the camera was at rest when it was seen last; robots are switched on at rest
  std::optional<Pose> predicted = std::nullopt;  ///< by the host, else by the mean velocity
  double elapsed_s = 0;                          ///< since the reference frame; positive with a prediction
  bool is_told = false;                          ///< `current_from_reference` is what the host says of this very motion
};

}  // namespace stillpoint
