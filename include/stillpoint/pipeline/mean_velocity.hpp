// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How fast has the camera moved of late?

#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/statistics.hpp"

namespace stillpoint {

/// The velocity of the last tenth of a second: a recording that drops frames, or repeats them, makes each single step
/// longer or shorter than it was.
class MeanVelocity {
 public:
  static constexpr double kMemory_s = 0.1;
  /// A single step is carried on for at most so many times its own time: stamps next to each other give no velocity.
  static constexpr double kMostStretch = 10.0;

  /// @param elapsed_s  within which the camera moved so, positive
  void add(const Pose& current_from_reference, double elapsed_s) {
    const double share = known_ ? exponential_share(elapsed_s, kMemory_s) : 1.0;
    angular_rad_s_ += share * (vector_from_rotation(rotation_of(current_from_reference)) / elapsed_s - angular_rad_s_);
    linear_m_s_ += share * (translation_of(current_from_reference) / elapsed_s - linear_m_s_);
    known_ = is_finite(angular_rad_s_) && is_finite(linear_m_s_);
    if (!known_) forget();  // time stamps a rounding apart: what was known would not come back
  }

  /// current_from_reference after so long; nothing where nothing is known.
  std::optional<Pose> during(double elapsed_s) const {
    if (!known_) return std::nullopt;
    return at_constant_velocity(angular_rad_s_, linear_m_s_, elapsed_s);
  }

  void forget() noexcept { *this = MeanVelocity(); }

 private:
  Vector3d angular_rad_s_ = Vector3d::Zero(), linear_m_s_ = Vector3d::Zero();
  bool known_ = false;
};

}  // namespace stillpoint
