// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Two views of random points, with a known motion, noise and outliers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/motion/epipolar/essential.hpp"

namespace stillpoint::bench {

struct TwoViewOptions {
  std::size_t points = 1000;
  double outlier_share = 0.4;
  double noise_px = 0.5;  ///< of each coordinate in either view
  std::uint64_t seed = 1;
};

/// Points 1 to 5 m away; the camera turns by up to 5 degrees and moves by 15 cm. Outliers are found up
/// to 40 px from their place in the reference image, with a depth that is off by up to 0.5 m. Depth has a Kinect's
/// noise.
struct TwoViews {
  Camera camera{525, 525, 319.5, 239.5, 640, 480};
  Pose current_from_reference = Pose::Identity();
  Observations observations;  ///< nothing is known to move
  std::vector<std::uint8_t> outlier;

  explicit TwoViews(const TwoViewOptions& options) {
    Random random(options.seed);
    const auto vector = [&random](double x, double y, double z) {
      return Vector3d(random.uniform(-x, x), random.uniform(-y, y), random.uniform(-z, z));
    };
    current_from_reference.linear() = rotation_from_vector(vector(0.05, 0.05, 0.05));
    current_from_reference.translation() = 0.15 * vector(1.0, 1.0, 0.5).normalized();
    const auto noisy = [&](const Vector2d& pixel) -> Vector2d {
      return pixel + options.noise_px * Vector2d(random.gaussian(), random.gaussian());
    };
    const auto add = [&](FrameFeatures& side, const Vector2d& pixel, double depth_m) {
      const std::size_t i = side.size();
      const double sigma_m = KinectNoise().sigma(depth_m);
      side.resize(i + 1);
      side.undistorted[i] = noisy(pixel);
      side.pixel[i] = side.undistorted[i].cast<float>();
      side.set_depth(i, depth_m + sigma_m * random.gaussian(), sigma_m, camera);
    };
    Matches& matches = observations.matches;
    while (outlier.size() < options.points) {
      const Vector2d pixel(random.uniform(0, 640), random.uniform(0, 480));
      const Vector3d point = camera.back_project(pixel, random.uniform(1, 5));
      const Vector3d moved = current_from_reference * point;
      const bool wrong = random.uniform() < options.outlier_share;
      const Vector2d jump(random.uniform(-40, 40), random.uniform(-40, 40));
      const Vector2d found = wrong ? Vector2d(pixel + jump) : camera.project(moved);
      const double depth_m = moved.z() + (wrong ? random.uniform(-0.5, 0.5) : 0.0);
      if (found.x() < 0 || found.y() < 0 || found.x() > 640 || found.y() > 480) continue;
      add(matches.reference, pixel, point.z());
      add(matches.current, found, depth_m);
      outlier.push_back(wrong ? 1 : 0);
    }
    matches.resize(options.points);
    matches.host_count = options.points;
    std::fill(matches.state.begin(), matches.state.end(), MatchState::matched);
    observations.regions.locate(matches.current.pixel);
    observations.remembered.begin(matches);
  }
};

/// The same scene in many instances, so that one lucky draw does not decide.
inline std::vector<TwoViews> make_two_views(TwoViewOptions options, std::size_t count) {
  std::vector<TwoViews> scenes;
  for (std::size_t i = 0; i < count; ++i, ++options.seed) scenes.emplace_back(options);
  return scenes;
}

/// How far off a motion is.
struct PoseError {
  double rotation_deg = 180.0;
  double direction_deg = 90.0;  ///< of the translation, its sign left open
  double translation_m = std::numeric_limits<double>::infinity();

  PoseError() = default;
  PoseError(const Pose& found, const Pose& truth)
      : rotation_deg(kDegreesPerRadian * rotation_angle(found.linear() * truth.linear().transpose())),
        direction_deg(kDegreesPerRadian * line_angle(found.translation(), truth.translation())),
        translation_m((found.translation() - truth.translation()).norm()) {}

  static double line_angle(const Vector3d& a, const Vector3d& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
  }
};

/// Of the nearest of the motions that a fundamental matrix of pixels stands for.
inline PoseError fundamental_error(const Matrix3d& fundamental, const TwoViews& scene) {
  PoseError best;
  if (!fundamental.allFinite() || !(fundamental.norm() > 0)) return best;
  for (const Pose& pose : decompose_essential(essential_from_fundamental(fundamental, scene.camera.matrix()))) {
    const PoseError error(pose, scene.current_from_reference);
    if (error.rotation_deg + error.direction_deg < best.rotation_deg + best.direction_deg) best = error;
  }
  return best;
}

}  // namespace stillpoint::bench
