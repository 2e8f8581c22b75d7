// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Matches of a random scene with a known motion.

#include <algorithm>
#include <cstddef>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::test {

using TestCamera = PinholeCamera<NoDistortion>;

/// Every intrinsic differs from the others, so that a formula that mixes them up is wrong.
inline TestCamera test_camera() { return {525.0, 480.0, 330.0, 220.0, 640, 480, {}}; }

struct SceneOptions {
  std::size_t count = 200;
  double pixel_noise_px = 0.0;
  double depth_noise_share = 0.0;  ///< of depth; also the sigma that the matches claim (at least 1 mm)
  double mover_share = 0.0;        ///< moved by `mover` on top of the camera's motion
  Pose mover = Pose::Identity();   ///< in the current camera's frame
  bool plane = false;
  bool line = false;
  double near_m = 1.0, far_m = 4.0;
};

inline Pose pose_of(const Vector3d& omega, const Vector3d& t) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_vector(omega);
  pose.translation() = t;
  return pose;
}

inline Pose random_motion(Random& random, double turn_rad, double length_m) {
  const Vector3d axis(random.gaussian(), random.gaussian(), random.gaussian());
  const Vector3d direction(random.gaussian(), random.gaussian(), random.gaussian());
  return pose_of(axis.normalized() * turn_rad * random.uniform(), direction.normalized() * length_m);
}

/// The first `mover_share` of the features belong to the mover.
inline Matches make_matches(const Pose& current_from_reference, const SceneOptions& options, Random& random) {
  const TestCamera camera = test_camera();
  Matches matches;
  matches.resize(options.count);
  matches.host_count = options.count;
  const auto noisy = [&](const Vector2d& pixel) -> Vector2d {
    return pixel + options.pixel_noise_px * Vector2d(random.gaussian(), random.gaussian());
  };
  const auto write = [&](FrameFeatures& side, std::size_t i, const Vector3d& point) {
    side.undistorted[i] = noisy(camera.project(point));
    side.pixel[i] = side.undistorted[i].cast<float>();
    const double depth = point.z() * (1.0 + options.depth_noise_share * random.gaussian());
    side.set_depth(i, depth, std::max(options.depth_noise_share * point.z(), 1e-3), camera);
  };
  const auto movers = static_cast<std::size_t>(options.mover_share * static_cast<double>(options.count) + 0.5);
  for (std::size_t i = 0; i < options.count; ++i) {
    Vector2d pixel(random.uniform(20, 620), random.uniform(20, 460));
    if (options.line) pixel.y() = 100.0 + 0.5 * pixel.x();
    double depth = random.uniform(options.near_m, options.far_m);
    if (options.plane) depth = 2.0 / (1.0 + 0.0005 * pixel.x() - 0.0003 * pixel.y());  // 1/z is linear on a plane
    if (options.line) depth = 2.0 / (1.0 + 0.0005 * pixel.x());
    const Vector3d p = camera.back_project(pixel, depth);
    Vector3d q = current_from_reference * p;
    if (i < movers) q = options.mover * q;
    write(matches.reference, i, p);
    write(matches.current, i, q);
    matches.state[i] = MatchState::matched;
  }
  return matches;
}

inline double rotation_error(const Pose& a, const Pose& b) {
  return rotation_angle(a.linear() * b.linear().transpose());
}
inline double translation_error(const Pose& a, const Pose& b) { return (a.translation() - b.translation()).norm(); }

}  // namespace stillpoint::test
