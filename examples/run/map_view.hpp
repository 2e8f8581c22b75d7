// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The axes in which trajectories are drawn: to the right and ahead of where the camera looked first, and up.

#include <Eigen/Core>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/evaluation/trajectory.hpp"

namespace stillpoint_run {

class MapView {
 public:
  /// The way up is the axis of the world nearest to the cameras' own: handheld cameras look down a little.
  explicit MapView(const stillpoint::Trajectory& path) {
    using stillpoint::Vector3d;
    if (path.empty()) return;
    Vector3d up = Vector3d::Zero();
    for (const auto& pose : path) up -= pose.world_from_camera.linear().col(1);
    Eigen::Index axis = 1;
    up.cwiseAbs().maxCoeff(&axis);
    up_ = Vector3d::Unit(axis) * (up[axis] < 0 ? -1.0 : 1.0);
    const Vector3d sight = path.front().world_from_camera.linear().col(2);
    ahead_ = sight - sight.dot(up_) * up_;
    // Looking straight up or down, the image's up is ahead.
    if (!(ahead_.norm() > 0.1)) ahead_ = -path.front().world_from_camera.linear().col(1);
    ahead_.normalize();
    right_ = ahead_.cross(up_);
    origin_ = path.front().world_from_camera.translation();
  }

  /// Metres to the right, ahead, up.
  stillpoint::Vector3d operator()(const stillpoint::Vector3d& position) const {
    const stillpoint::Vector3d from_start = position - origin_;
    return {right_.dot(from_start), ahead_.dot(from_start), up_.dot(from_start)};
  }

 private:
  stillpoint::Vector3d right_ = stillpoint::Vector3d::UnitX(), ahead_ = stillpoint::Vector3d::UnitZ(),
                       up_ = -stillpoint::Vector3d::UnitY(), origin_ = stillpoint::Vector3d::Zero();
};

}  // namespace stillpoint_run
