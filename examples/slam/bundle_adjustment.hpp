// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Bundle adjustment (Triggs, McLauchlan, Hartley, Fitzgibbon, "Bundle Adjustment - A Modern Synthesis", 1999): the
// poses and points that explain pixels and depths best. This header is free of Ceres, which takes long to compile.

#include <vector>

#include "frame.hpp"
#include "stillpoint/core/camera.hpp"

namespace examples::slam {

using stillpoint::Camera;

/// Poses, points and what was measured of them, as plain data: the map may change while it is adjusted.
struct BundleProblem {
  struct View {
    KeyframeId keyframe = kNone;
    Pose camera_from_world = Pose::Identity();
    bool is_fixed = false;
  };
  struct Point {
    PointId point = kNone;
    Vector3d p_world = Vector3d::Zero();
  };
  struct Measurement {
    int view = 0, point = 0;  ///< indices
    Vector2d pixel = Vector2d::Zero();
    double pixel_sigma = 1.0;
    double depth_m = 0.0;  ///< 0 where there is none
    double depth_sigma_m = 0.0;
    double weight = 1.0;
    bool fits = true;  ///< those that do not are left out
  };
  std::vector<View> views;
  std::vector<Point> points;
  std::vector<Measurement> measurements;
};

/// Squared error in standard deviations, of pixel and depth; infinite behind the camera.
double squared_error(const BundleProblem& problem, const BundleProblem::Measurement& measurement, const Camera& camera);
/// 95 % of right measurements have a squared error below this: χ² of three degrees of freedom, or two without depth.
inline double chi_squared_limit(bool has_depth) { return has_depth ? 7.815 : 5.991; }

struct BundleOptions {
  int iterations = 10;
  bool is_robust = true;  ///< Huber's loss, from the limit of a right measurement on
};

/// Levenberg-Marquardt on all that is not fixed.
void adjust(BundleProblem& problem, const Camera& camera, const BundleOptions& options);

}  // namespace examples::slam
