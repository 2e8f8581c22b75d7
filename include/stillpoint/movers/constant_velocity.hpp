// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A constant-velocity filter of one vector: measured each frame, carried on where nothing is measured.

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"

namespace stillpoint {

/// Kalman filter of a velocity that changes by white acceleration. Unit-free: m/s for translations, rad/s for turns.
/// Source: Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, ch. 6.
class ConstantVelocity {
 public:
  /// @param spread  standard deviation of a velocity of which nothing is known
  explicit ConstantVelocity(double spread = 1.0) : covariance_(spread * spread * Matrix3d::Identity()) {}

  const Vector3d& velocity() const noexcept { return velocity_; }
  const Matrix3d& covariance() const noexcept { return covariance_; }

  /// Time passes, and the camera in whose axes the velocity is given turns.
  /// @param acceleration_sigma  of each axis, per second
  void predict(const Matrix3d& current_from_reference, double elapsed_s, double acceleration_sigma) {
    velocity_ = current_from_reference * velocity_;
    covariance_ = current_from_reference * covariance_ * current_from_reference.transpose();
    constexpr double kChangesEvery_s = 1.0 / 30.0;  // for so long an acceleration holds
    covariance_ += acceleration_sigma * acceleration_sigma * kChangesEvery_s * elapsed_s * Matrix3d::Identity();
  }

  /// Nothing is measured: what moved comes to rest some time.
  void fade(double factor) { velocity_ *= factor; }

  /// Something else knows better; the uncertainty stays.
  void set_velocity(const Vector3d& velocity) { velocity_ = velocity; }

  /// @param noise  covariance of the measured velocity; one that is not positive definite is no measurement
  void correct(const Vector3d& measured, const Matrix3d& noise) {
    const Cholesky<3> innovation(covariance_ + noise);
    if (!innovation.positive_definite() || !measured.allFinite()) return;
    const Matrix3d gain = covariance_ * innovation.inverse();
    velocity_ += gain * (measured - velocity_);
    const Matrix3d left = Matrix3d::Identity() - gain;  // Joseph's form: stays symmetric
    covariance_ = left * covariance_ * left.transpose() + gain * noise * gain.transpose();
  }

 private:
  Vector3d velocity_ = Vector3d::Zero();
  Matrix3d covariance_;
};

}  // namespace stillpoint
