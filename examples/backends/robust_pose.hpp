// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The pose of a camera from sightings some of which are wrong: from the pose that is expected, or by RANSAC.

#include <opencv2/calib3d.hpp>
#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pose_refinement.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace examples {

/// The pose that most sightings agree with within `reprojection_px`. Equal sightings give equal bytes: solvePnPRansac
/// seeds its own generator on every call.
/// @param camera_from_world  changed only where there is one
/// @return                   whether there is one
inline bool pose_by_ransac(span<const PointSighting> sightings, const Camera& camera, double reprojection_px,
                           int iterations, double confidence, Pose& camera_from_world) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const PointSighting& sighting : sightings) {
    points.emplace_back(sighting.p_world.x(), sighting.p_world.y(), sighting.p_world.z());
    pixels.emplace_back(sighting.pixel.x(), sighting.pixel.y());
  }
  const cv::Matx33d k(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
  cv::Vec3d rotation, translation;
  if (!cv::solvePnPRansac(points, pixels, k, cv::noArray(), rotation, translation, false, iterations,
                          static_cast<float>(reprojection_px), confidence, cv::noArray(), cv::SOLVEPNP_AP3P))
    return false;
  camera_from_world = Pose::Identity();
  camera_from_world.linear() = stillpoint::rotation_from_vector({rotation[0], rotation[1], rotation[2]});
  camera_from_world.translation() = Vector3d(translation[0], translation[1], translation[2]);
  return true;
}

/// The world and a mover may both explain many sightings: near the expected pose lies the world. So the pose that the
/// search finds from there is taken if a fair share of the sightings fits it; RANSAC is asked only where it does not.
/// Equal sightings give equal bytes: solvePnPRansac seeds its own generator on every call.
class RobustPose {
 public:
  struct Options {
    double reprojection_px = 3.0;  ///< inlier limit of RANSAC
    int iterations = 200;          ///< of RANSAC, at most
    double confidence = 0.999;     ///< that RANSAC has drawn right sightings alone once
    std::size_t fewest = 12;       ///< fewer sightings that fit are no pose
    double expected_share = 0.3;   ///< of the sightings must fit: the expected pose's neighbour, or else RANSAC's pose
  };
  Options options;
  PoseRefinement refine;

  /// @param camera_from_world  the expected pose, and the result; changed only where there is one
  /// @param inlier             one flag a sighting: whether it fits the result
  /// @return                   whether there is a pose
  bool operator()(span<const PointSighting> sightings, const Camera& camera, Pose& camera_from_world,
                  std::vector<std::uint8_t>& inlier) {
    inlier.assign(sightings.size(), 0);
    if (sightings.size() < options.fewest) return false;
    Pose pose = camera_from_world;
    std::size_t fitting = refine(sightings, camera, pose, inlier);
    const double enough = options.expected_share * static_cast<double>(sightings.size());  // even if RANSAC's fits all
    if (!(static_cast<double>(fitting) >= enough)) {
      if (!pose_by_ransac(sightings, camera, options.reprojection_px, options.iterations, options.confidence, pose))
        return false;
      fitting = refine(sightings, camera, pose, inlier);
    }
    if (fitting < options.fewest || static_cast<double>(fitting) < enough) return false;
    camera_from_world = pose;
    return true;
  }
};

}  // namespace examples
