// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is expected of the coming motion?   What the host says of it, else that the velocity holds.

#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"

namespace stillpoint {

/// Keeps the last velocity, and what the host says. Poses that are not finite say nothing.
class MotionExpectation {
 public:
  /// The host's own pose of the frame that came last. Those of two frames in a row give the velocity.
  void feedback(const Pose& world_from_camera) {
    if (!world_from_camera.matrix().allFinite()) return;
    world_from_last_ = world_from_camera;
    if (world_from_second_last_) last_motion_ = orthonormalized(inverted(world_from_camera) * *world_from_second_last_);
  }

  /// What an IMU or wheels say of the motion to the coming frame; holds for that one.
  void expect(const Pose& current_from_reference) {
    if (current_from_reference.matrix().allFinite()) said_ = current_from_reference;
  }

  /// @param timestamp_s  of the coming frame: the velocity is scaled to the time that has passed
  MotionPrior at(double timestamp_s) const {
    if (said_) return {said_, standing_};
    if (!last_motion_ || !last_timestamp_s_) return {std::nullopt, standing_};
    return {scaled(*last_motion_, (timestamp_s - *last_timestamp_s_) / last_interval_s_), standing_};
  }

  /// A frame has come, and the camera moved so.
  void advance(double timestamp_s, const Motion& motion) {
    if (last_timestamp_s_) last_interval_s_ = timestamp_s - *last_timestamp_s_;
    last_timestamp_s_ = timestamp_s;
    world_from_second_last_ = world_from_last_;
    world_from_last_.reset();
    said_.reset();
    last_motion_.reset();
    if (!motion.usable()) return;
    last_motion_ = motion.current_from_reference;
    standing_ = motion.standing;
  }

  const std::optional<double>& last_timestamp_s() const noexcept { return last_timestamp_s_; }

 private:
  std::optional<Pose> said_;
  std::optional<Pose> last_motion_;  // what was done within last_interval_s_
  double last_interval_s_ = 0.0;
  bool standing_ = true;
  std::optional<double> last_timestamp_s_;
  std::optional<Pose> world_from_last_, world_from_second_last_;  // the host's poses of the last two frames
};

}  // namespace stillpoint
