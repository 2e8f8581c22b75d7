// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What somebody else, such as the filter, says of the camera's motion, added up since the last pose.

#include <optional>

#include "stillpoint/core/geometry.hpp"

namespace examples {

class ToldMotion {
 public:
  /// Of the motion to the coming frame; holds for that one.
  void tell(const stillpoint::Pose& current_from_last) { told_ = current_from_last; }

  /// The frame has come: nothing is known any more where nothing was told of one.
  void next_frame() {
    if (!told_)
      since_pose_.reset();
    else if (since_pose_)
      since_pose_ = stillpoint::orthonormalized(*told_ * *since_pose_);
    told_.reset();
  }

  /// The frame has a pose.
  void restart() {
    since_pose_ = stillpoint::Pose::Identity();
    told_.reset();
  }

  /// current_from_last_with_pose; empty where a frame since then was told nothing.
  const std::optional<stillpoint::Pose>& since_pose() const { return since_pose_; }

 private:
  std::optional<stillpoint::Pose> told_;
  std::optional<stillpoint::Pose> since_pose_ = stillpoint::Pose::Identity();
};

}  // namespace examples
