// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames of points that are known: cameras on a line, each of which sees all points with their exact depths.

#include <cstdint>
#include <vector>

#include "slam/frame.hpp"
#include "slam/map.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"

namespace slam_test {

namespace slam = examples::slam;
using stillpoint::Pose;
using stillpoint::Vector2d;
using stillpoint::Vector3d;

inline stillpoint::Camera camera() { return stillpoint::Camera(525, 525, 319.5, 239.5, 640, 480); }

/// Points two to four metres before the first camera, in the middle of its picture.
inline std::vector<Vector3d> made_points(int count, std::uint64_t seed = 1) {
  stillpoint::Random random(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back(
        camera().back_project({160 + 320 * random.uniform(), 120 + 240 * random.uniform()}, 2 + 2 * random.uniform()));
  return points;
}

inline Pose camera_at(double x_m) {
  Pose camera_from_world = Pose::Identity();
  camera_from_world.translation().x() = -x_m;
  return camera_from_world;
}

/// A frame that sees each point as the feature of its index. Descriptors are random bits, the same for the same point.
inline slam::Frame made_frame(const std::vector<Vector3d>& points, const Pose& camera_from_world,
                              std::uint64_t descriptor_seed = 7) {
  stillpoint::Random random(descriptor_seed);
  slam::Frame frame;
  frame.camera_from_world = camera_from_world;
  frame.features.descriptors.create(static_cast<int>(points.size()), examples::kDescriptorBytes, CV_8U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d p = camera_from_world * points[i];
    const Vector2d pixel = camera().project(p);
    frame.features.keypoints.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), 31.0f);
    frame.features.keypoints.back().octave = 0;
    frame.pixel.push_back(pixel);
    frame.depth_m.push_back(p.z());
    frame.point.push_back(slam::kNone);
    frame.colour.emplace_back(1, 2, 3);
    for (int byte = 0; byte < examples::kDescriptorBytes; ++byte)
      frame.features.descriptors.at<std::uint8_t>(static_cast<int>(i), byte) =
          static_cast<std::uint8_t>(random.index(256));
  }
  frame.grid = slam::FeatureGrid(frame.pixel, 640, 480);
  return frame;
}

/// Keyframes every `step_m` along x, which see all points.
inline slam::Map made_map(const std::vector<Vector3d>& points, int keyframes, double step_m = 0.05) {
  slam::Map map;
  for (int k = 0; k < keyframes; ++k) {
    const slam::KeyframeId id = map.add(made_frame(points, camera_at(step_m * k)));
    for (std::size_t i = 0; i < points.size(); ++i)
      if (k == 0)
        map.add_point(id, static_cast<int>(i), points[i], Vector3d(0, 0, 0.01));
      else
        map.add_observation(static_cast<slam::PointId>(i), id, static_cast<int>(i));
  }
  return map;
}

}  // namespace slam_test
