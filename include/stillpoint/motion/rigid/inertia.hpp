// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A camera has mass: where little is seen that stands still, its velocity says more of the motion than what is seen.

#include <algorithm>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"

namespace stillpoint {

/// Fuses a motion that was found with the one that the mean velocity predicts, as a Kalman filter does. Directions that
/// the constraints hold stay as they were found; those that they leave open, such as a turn against a shift where all
/// that stands still is in one corner of the image, go with the velocity.
struct Inertia {
  double acceleration_m_s2 = 3.0;            ///< standard deviation along each axis, of a camera held by hand; 0: none
  double angular_acceleration_rad_s2 = 3.0;  ///< the same about each axis

  /// Constraints that say no more than one independent one would (`Motion::correlation`): the median of error² over
  /// variance on recordings; 1 in synthetic scenes.
  static constexpr double kCorrelated = 12.0;

  bool applies(const MotionPrior& prior) const noexcept {
    return prior.predicted.has_value() && prior.elapsed_s >= kLeastStep_s && acceleration_m_s2 > 0 &&
           angular_acceleration_rad_s2 > 0;
  }

  /// @param current_from_reference  as found, the best explanation of what was seen
  /// @param information             of it, in the coordinates of `Motion::covariance`, as if constraints were
  ///                                independent; what the velocity knows is added
  /// @param prior                   one to which this `applies`
  /// @return                        the likelier motion in between
  Pose fuse(const Pose& current_from_reference, Matrix6d& information, const MotionPrior& prior) const {
    const Pose off = composed(*prior.predicted, inverted(current_from_reference));
    const Vector6d expected =
        joined(vector_from_rotation(rotation_of(off)), translation_of(off));  // after what was found
    Matrix6d velocity = information_of(prior.elapsed_s);
    if (!is_finite(velocity)) return current_from_reference;  // no time has passed
    velocity *= weight(expected, velocity, information);
    information += velocity;
    const Vector6d step = Cholesky<6>(information).solve(velocity * expected);
    const Pose fused = make_pose(rotation_from_vector(rotation_part(step)), translation_part(step));
    return orthonormalized(composed(fused, current_from_reference));
  }

 private:
  static constexpr double kDegreesOfFreedom = 10.0;  // of Student's t: jolts are rare and then large
  static constexpr double kLeastStep_s = 0.004;      // stamps that are nearer do not say when the images were taken
  static constexpr double kVelocityAge_s = 0.03;     // at 30 Hz, where both accelerations were measured

  /// Of Student's t, for what lies between the two: e² = xᵀ (found⁻¹ + velocity⁻¹)⁻¹ x, by the matrix inversion lemma.
  double weight(const Vector6d& expected, const Matrix6d& velocity, const Matrix6d& found) const {
    const Vector6d pull = velocity * expected;
    const Vector6d step = Cholesky<6>(found + velocity).solve(pull);
    double squared = 0;
    for (int i = 0; i < 6; ++i) squared += pull(i) * (expected(i) - step(i));
    return std::min(1.0, (kDegreesOfFreedom + 6.0) / (kDegreesOfFreedom + squared / kCorrelated));
  }

  /// Of the predicted motion, in the same measure as that of correlated constraints. The velocity is that of the past,
  /// so that it is not known better because the next frame is near.
  Matrix6d information_of(double elapsed_s) const {
    const double squared_s = elapsed_s * std::max(elapsed_s, kVelocityAge_s);
    const double angle = angular_acceleration_rad_s2 * squared_s;
    const double length_m = acceleration_m_s2 * squared_s;
    Matrix6d information = Matrix6d::Zero();
    for (int i = 0; i < 3; ++i) {
      information(i, i) = kCorrelated / (angle * angle);
      information(3 + i, 3 + i) = kCorrelated / (length_m * length_m);
    }
    return information;
  }
};

template <class Visit>
void each_option(Inertia& inertia, Visit& visit) {
  visit("acceleration_m_s2", inertia.acceleration_m_s2, OptionRange{0, 1000});
  visit("angular_acceleration_rad_s2", inertia.angular_acceleration_rad_s2, OptionRange{0, 1000});
}

}  // namespace stillpoint
