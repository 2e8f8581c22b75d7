// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which depth has a feature that the sensor gave none now?   If it stands still, the one that an older frame measured.

#include <cmath>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/depth/guarded_depth.hpp"

namespace stillpoint {

/// The depth that an older frame measured where a static feature would be: from a supposed depth to the pixel there,
/// from the depth measured there back, until both agree.
/// @param pixel      in the current image, undistorted
/// @param start_m    supposed depth
/// @return           depth in the current camera, metres; 0 where nothing was measured or nothing agrees
template <class Camera, class Noise>
double borrowed_depth_m(const Vector2d& pixel, double start_m, const FrameView& older,
                        const Pose& reference_from_current, const Camera& camera, const GuardedDepth& guard,
                        const Noise& noise, const DepthTolerance& same_surface) {
  constexpr int kRounds = 3;
  constexpr double kNearest_m = 0.1;
  constexpr double kAgreed = 0.1;  // of what depths differ by on one surface
  const Eigen::Matrix4d& motion = reference_from_current.matrix();
  const Vector3d along(motion(0, 2), motion(1, 2), motion(2, 2));  // this camera's axis, in the older one
  double depth_m = start_m;
  for (int round = 0; round < kRounds; ++round) {
    const Vector3d there = reference_from_current * camera.back_project(pixel, depth_m);
    if (!(there.z() > kNearest_m)) return 0.0;
    const Vector2d seen_at = camera.project(there);
    const double measured_m = guard.at(older, to_float(camera.distort(seen_at)), noise);
    if (!(measured_m > 0)) return 0.0;
    const Vector3d measured = camera.back_project(seen_at, measured_m) - translation_of(reference_from_current);
    const double now_m = measured.dot(along);
    if (std::abs(now_m - depth_m) < kAgreed * same_surface.at(noise.sigma(depth_m))) return now_m;
    depth_m = now_m;
  }
  return 0.0;
}

}  // namespace stillpoint
