// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A camera, where it may stand, and points that it sees, drawn at random.

#include "backends/pose_refinement.hpp"
#include "stillpoint/core/random.hpp"

inline stillpoint::Camera camera() { return stillpoint::Camera(525, 525, 319.5, 239.5, 640, 480); }

/// A point that `camera_from_world` sees somewhere in its picture, one to four metres away, with its exact depth.
inline examples::PointObservation observation(stillpoint::Random& random, const stillpoint::Pose& camera_from_world) {
  const stillpoint::Vector3d p =
      camera().back_project({640 * random.uniform(), 480 * random.uniform()}, 1 + 3 * random.uniform());
  examples::PointObservation result{camera_from_world.inverse() * p, camera().project(p)};
  result.depth_m = p.z();
  result.depth_sigma_m = 0.01;
  return result;
}

/// A pose to the side of the identity.
inline stillpoint::Pose aside(double x_m) {
  stillpoint::Pose pose = stillpoint::Pose::Identity();
  pose.translation().x() = x_m;
  return pose;
}

inline double error_m(const stillpoint::Pose& found, const stillpoint::Pose& truth) {
  return (found.inverse() * truth).translation().norm();
}
