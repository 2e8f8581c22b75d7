// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is expected of the coming motion?   What the host says of it, else that the velocity holds.

#include <limits>
#include <optional>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/plausible_motion.hpp"
#include "stillpoint/pipeline/mean_velocity.hpp"

namespace stillpoint {

/// Keeps the last velocity, and what the host says. Poses that are not rigid, and motions that no camera makes, say
/// nothing.
class MotionExpectation {
 public:
  /// The host's own pose of the frame that came last. Those of two frames in a row give the velocity.
  /// @return  what the host says of the motion to that frame, current_from_reference, plausible or not
  std::optional<Pose> feedback(const Pose& world_from_camera) {
    if (!is_rigid(world_from_camera)) return std::nullopt;
    world_from_last_ = world_from_camera;
    if (!world_from_second_last_) return std::nullopt;
    const Pose moved = composed(inverted(world_from_camera), *world_from_second_last_);
    if (is_plausible_motion(moved)) last_motion_ = orthonormalized(moved);
    return moved;
  }

  /// What an IMU or wheels say of the motion to the coming frame; holds for that one, in place of what was said before.
  void expect(const Pose& current_from_reference) {
    said_.reset();
    if (is_plausible_motion(current_from_reference)) said_ = orthonormalized(current_from_reference);
  }

  /// @param timestamp_s  of the coming frame: the velocity is scaled to the time that has passed
  MotionPrior at(double timestamp_s) const {
    MotionPrior prior;
    prior.stationary = stationary_;
    if (last_timestamp_s_) prior.elapsed_s = timestamp_s - *last_timestamp_s_;
    prior.is_told = said_.has_value();
    if (said_)
      prior.current_from_reference = said_;
    else if (last_motion_ && prior.elapsed_s < MeanVelocity::kMostStretch * last_interval_s_)
      prior.current_from_reference = scaled(*last_motion_, prior.elapsed_s / last_interval_s_);
    else if (prior.elapsed_s > 0)
      prior.current_from_reference = mean_velocity_.during(prior.elapsed_s);
    if (prior.elapsed_s > 0) prior.predicted = said_ ? said_ : mean_velocity_.during(prior.elapsed_s);
    // A velocity over a tiny interval, that of two time stamps a rounding apart, is none.
    for (std::optional<Pose>* pose : {&prior.current_from_reference, &prior.predicted})
      if (*pose && !is_plausible_motion(**pose)) pose->reset();
    return prior;
  }

  /// A frame has come, and the camera moved so.
  void advance(double timestamp_s, const Motion& motion) {
    if (last_timestamp_s_) last_interval_s_ = timestamp_s - *last_timestamp_s_;
    last_timestamp_s_ = timestamp_s;
    world_from_second_last_ = world_from_last_;
    world_from_last_.reset();
    said_.reset();
    last_motion_.reset();
    if (!motion.usable()) {
      if (!(timestamp_s - last_usable_s_ <= kVelocityLasts_s)) mean_velocity_.forget();
      return;
    }
    last_usable_s_ = timestamp_s;
    if (last_interval_s_ > 0) mean_velocity_.add(motion.current_from_reference, last_interval_s_);
    last_motion_ = motion.current_from_reference;
    stationary_ = motion.stationary;
  }

  const std::optional<double>& last_timestamp_s() const noexcept { return last_timestamp_s_; }

 private:
  static constexpr double kVelocityLasts_s = 0.5;  // over frames without a motion: a camera that turns goes on to

  std::optional<Pose> said_;
  MeanVelocity mean_velocity_;       // of the motions that were found; the host's own poses do not change it
  std::optional<Pose> last_motion_;  // what was done within last_interval_s_
  double last_interval_s_ = 0.0;
  double last_usable_s_ = -std::numeric_limits<double>::infinity();  // the frame whose motion was known last
  bool stationary_ = true;
  std::optional<double> last_timestamp_s_;
  std::optional<Pose> world_from_last_, world_from_second_last_;  // the host's poses of the last two frames
};

}  // namespace stillpoint
