// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One object as it is remembered from frame to frame.

#include <algorithm>
#include <array>
#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/movers/appearance.hpp"
#include "stillpoint/movers/constant_velocity.hpp"

namespace stillpoint {

/// Points on an object's surface, metres. No heap.
class ObjectPoints {
 public:
  static constexpr std::size_t kMost = 320;

  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  bool full() const noexcept { return size_ == kMost; }
  Vector3d& operator[](std::size_t k) noexcept { return points_[k]; }
  const Vector3d& operator[](std::size_t k) const noexcept { return points_[k]; }
  Vector3d* begin() noexcept { return points_.data(); }
  Vector3d* end() noexcept { return points_.data() + size_; }
  const Vector3d* begin() const noexcept { return points_.data(); }
  const Vector3d* end() const noexcept { return points_.data() + size_; }

  /// Nothing happens where it is full.
  void add(const Vector3d& point) noexcept {
    if (!full()) points_[size_++] = point;
  }
  void shrink(std::size_t size) noexcept { size_ = std::min(size, size_); }

 private:
  std::array<Vector3d, kMost> points_;
  std::size_t size_ = 0;
};

/// An object that is followed. Vectors are in the axes of the last frame's camera.
struct TrackedObject {
  static constexpr double kAcceleration_m_s2 = 4.0,
                          kAngular_rad_s2 = 4.0;  // standard deviations: people start and stop

  Mover mover;
  ObjectPoints points;
  ConstantVelocity linear{1.0}, angular{1.0};
  Appearance appearance;
  Vector3d mean_velocity = Vector3d::Zero();  ///< of the last third of a second: limbs swing about it, m/s
  Vector3d long_velocity = Vector3d::Zero();  ///< of the last 0.6 s
  Vector3d mean_turn = Vector3d::Zero();      ///< of the last third of a second, rad/s
  Matrix3d mean_turn_covariance = Matrix3d::Identity();
  Vector3d path = Vector3d::Zero();  ///< the way gone since it was seen first, metres
  Matrix3d path_covariance = Matrix3d::Zero();
  Vector3d size_m = Vector3d::Zero();  ///< its extent as it is remembered: parts at rest or covered count
  int seen_frames = 0;
  std::size_t members = 0;          ///< features in the last frame in which it was seen
  double slow_s = 0;                ///< for how long it has hardly moved
  double rigid_share = 0.5;         ///< mean over time of the share of its points that move as one rigid body
  double fit_share = 0.5;           ///< the same, the plain mean as long as it has been seen in few frames
  double bending_sq = 0;            ///< mean square of its parts' velocities against each other, less noise, (m/s)²
  double bending_with_turn_sq = 0;  ///< the same before its turn is taken out
  bool turns = false;               ///< `mean_turn` is more than noise
  bool surely_turns = false;        ///< so much more that its features are expected to turn with it
  bool is_confirmed = false;        ///< it is reported
  bool is_seen = true;              ///< in the last frame

  double mean_speed() const { return mean_velocity.norm(); }

  /// Its parts move against each other: limbs that swing look like a turn of the body.
  bool bends() const {
    constexpr double kLeast_m_s = 0.01, kShare = 0.15;
    return bending_sq > std::max(kLeast_m_s * kLeast_m_s, kShare * bending_with_turn_sq);
  }

  /// Of a point of the object, relative to the world: with its turn where that is known.
  Vector3d velocity_at(const Vector3d& point) const {
    Vector3d velocity = linear.velocity();
    if (surely_turns) velocity += angular.velocity().cross(point - mover.centroid);
    return velocity;
  }

  /// How much faster or slower than the object a point of it may be: limbs of what does not move rigidly.
  double limbs_m_s() const {
    const double speed = linear.velocity().norm();
    return 0.15 + 0.2 * speed + (1.0 - rigid_share) * (0.3 + 0.6 * speed);
  }

  /// Its motion in the world within a time, in the current camera's axes, at constant velocity: about its centroid.
  Pose step(double elapsed_s) const {
    const Vector3d turn = surely_turns ? angular.velocity() : Vector3d(Vector3d::Zero());
    Pose step = at_constant_velocity(turn, linear.velocity(), elapsed_s);
    step.translation() += mover.centroid - step.linear() * mover.centroid;
    return step;
  }

  /// Where it is in the coming frame at constant velocity.
  void predict(const Pose& current_from_reference, double elapsed_s) {
    const Matrix3d& turn = current_from_reference.linear();
    linear.predict(turn, elapsed_s, kAcceleration_m_s2);
    angular.predict(turn, elapsed_s, kAngular_rad_s2);
    mean_velocity = turn * mean_velocity;
    long_velocity = turn * long_velocity;
    mean_turn = turn * mean_turn;
    mean_turn_covariance = turn * mean_turn_covariance * turn.transpose();
    path = turn * path;
    path_covariance = turn * path_covariance * turn.transpose();
    mover.centroid = current_from_reference * mover.centroid;
    const Pose current_from_last = step(elapsed_s) * current_from_reference;
    mover.centroid = step(elapsed_s) * mover.centroid;
    mover.current_from_reference = current_from_last;
    mover.has_rotation = mover.has_rotation && surely_turns;
    mover.covariance.setZero();
    mover.covariance.bottomRightCorner<3, 3>() = elapsed_s * elapsed_s * linear.covariance();
    if (mover.has_rotation) {  // it turns about its centroid, the covariance is of a turn about the camera
      const Matrix3d turned = elapsed_s * elapsed_s * angular.covariance();
      const Matrix3d shifted = skew(mover.centroid) * turned;
      mover.covariance.topLeftCorner<3, 3>() = turned;
      mover.covariance.bottomLeftCorner<3, 3>() = shifted;
      mover.covariance.topRightCorner<3, 3>() = shifted.transpose();
      mover.covariance.bottomRightCorner<3, 3>() += shifted * skew(mover.centroid).transpose();
    }
    for (Vector3d& point : points) point = current_from_last * point;
  }

  /// The two hang together: some points of the one are near points of the other. A sample of the points is compared.
  static bool touch(const TrackedObject& a, const TrackedObject& b, double reach_m) {
    constexpr std::size_t kSample = 64, kFewest = 3;
    constexpr double kShare = 0.1;
    const std::size_t every_a = a.points.size() / kSample + 1, every_b = b.points.size() / kSample + 1;
    std::size_t near = 0, compared = 0;
    for (std::size_t i = 0; i < b.points.size(); i += every_b, ++compared)
      for (std::size_t j = 0; j < a.points.size(); j += every_a)
        if ((a.points[j] - b.points[i]).squaredNorm() <= reach_m * reach_m) {
          ++near;
          break;
        }
    return near >= kFewest && static_cast<double>(near) >= kShare * static_cast<double>(compared);
  }
};

}  // namespace stillpoint
