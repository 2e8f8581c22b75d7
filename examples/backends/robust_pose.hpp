// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pose of a camera from observations some of which are wrong: from the pose that is expected, or by RANSAC.

#include <opencv2/calib3d.hpp>
#include <opencv2/core/mat.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "pose_refinement.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace examples {

/// The pose that most observations agree with within `reprojection_px`.
/// @param camera_from_world  changed only where there is one
/// @return                   whether there is one
inline bool pose_by_ransac(span<const PointObservation> observations, const Camera& camera, double reprojection_px,
                           int iterations, double confidence, Pose& camera_from_world) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const PointObservation& observation : observations) {
    points.emplace_back(observation.p_world.x(), observation.p_world.y(), observation.p_world.z());
    pixels.emplace_back(observation.pixel.x(), observation.pixel.y());
  }
  const cv::Matx33d k(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
  cv::Vec3d rotation, translation;
  if (!cv::solvePnPRansac(points, pixels, k, cv::noArray(), rotation, translation, false, iterations,
                          static_cast<float>(reprojection_px), confidence, cv::noArray(), cv::SOLVEPNP_AP3P))
    return false;
  camera_from_world = stillpoint::make_pose(stillpoint::rotation_from_vector({rotation[0], rotation[1], rotation[2]}),
                                            {translation[0], translation[1], translation[2]});
  return true;
}

/// Metres plus radians: how far two views are apart.
inline double distance(const Pose& world_from_a, const Pose& world_from_b) {
  const Pose a_from_b = world_from_a.inverse() * world_from_b;
  return a_from_b.translation().norm() + stillpoint::rotation_angle(a_from_b.linear());
}

/// The world and a mover may both explain many features: near the expected pose lies the world. So the pose that the
/// search finds from there is taken as long as it stays near and a fair share of the features fits it; if not, the
/// likelier of it and RANSAC's. Equal observations give equal bytes: solvePnPRansac seeds its own generator on every
/// call.
class RobustPose {
 public:
  struct Options {
    double reach = 0.1;            ///< metres plus radians: twice what a hand leaves a constant velocity by at 30 Hz
    double reprojection_px = 3.0;  ///< inlier limit of RANSAC
    int iterations = 200;          ///< of RANSAC, at most
    double confidence = 0.999;     ///< that RANSAC has drawn right observations alone once
    std::size_t fewest = 12;       ///< fewer features that fit are no pose
    double fewest_share = 0.3;     ///< of the features that were found again must fit: fewer are no pose
  };
  Options options;
  PoseRefinement refine;

  /// @param camera_from_world  the expected pose, and the result; changed only where there is one
  /// @param inlier             one flag per observation: whether it fits the result
  /// @return                   whether there is a pose
  bool operator()(span<const PointObservation> observations, const Camera& camera, Pose& camera_from_world,
                  std::vector<std::uint8_t>& inlier) {
    inlier.assign(observations.size(), 1);
    const std::size_t found = count_features(observations, inlier);
    const auto is_enough = [&] {
      fitting_ = count_features(observations, inlier);
      return fitting_ >= options.fewest &&
             static_cast<double>(fitting_) >= options.fewest_share * static_cast<double>(found);
    };
    if (found < options.fewest) return false;
    Pose pose = camera_from_world;
    refine(observations, camera, pose, inlier);
    const bool is_near = distance(pose.inverse(), camera_from_world.inverse()) < options.reach;
    if (!is_near || !is_enough()) {
      prefer_ransac(observations, camera, pose, inlier);
      if (!is_enough()) return false;
    }
    camera_from_world = pose;
    return true;
  }

  /// Features that fit the pose that was found last.
  std::size_t fitting() const { return fitting_; }

 private:
  /// Takes RANSAC's pose if it is the likelier.
  void prefer_ransac(span<const PointObservation> observations, const Camera& camera, Pose& pose,
                     std::vector<std::uint8_t>& inlier) {
    Pose sampled;
    if (!pose_by_ransac(observations, camera, options.reprojection_px, options.iterations, options.confidence, sampled))
      return;
    refine(observations, camera, sampled, inlier_of_sampled_);
    if (!(refine.misfit(observations, camera, sampled) < refine.misfit(observations, camera, pose))) return;
    pose = sampled;
    std::swap(inlier, inlier_of_sampled_);
  }

  /// To how many features the flagged observations belong.
  std::size_t count_features(span<const PointObservation> observations, const std::vector<std::uint8_t>& flags) {
    feature_.clear();
    for (std::size_t i = 0; i < observations.size(); ++i)
      if (flags[i] != 0) feature_.push_back(observations[i].feature);
    std::sort(feature_.begin(), feature_.end());
    return static_cast<std::size_t>(std::unique(feature_.begin(), feature_.end()) - feature_.begin());
  }

  std::size_t fitting_ = 0;
  std::vector<std::uint8_t> inlier_of_sampled_;
  std::vector<std::size_t> feature_;
};

}  // namespace examples
