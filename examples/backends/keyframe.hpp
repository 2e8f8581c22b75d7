// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What an RGB-D odometry remembers of a frame.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feature_weights.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

using stillpoint::Pose;
using stillpoint::span;

/// ORB corners, one descriptor a row.
struct OrbFeatures {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  FeatureWeights weights;

  void compact(span<const std::uint8_t> keep) {
    stillpoint::compact(keep, keypoints, descriptors);
    weights.compact(keep);
  }
  void weigh(span<const float> some) { weights.assign(some); }
};

/// A frame with its images. Where its camera stands is known once it is a keyframe.
struct Keyframe {
  OrbFeatures features;
  std::vector<double> depth_m;   ///< of the features, 0 where there is none
  std::vector<cv::Mat> pyramid;  ///< of the gray image
  stillpoint::ImageBuffer depth;
  double depth_factor = 1.0;
  Pose world_from_camera = Pose::Identity();
};

/// Which depths a feature may have.
struct DepthLimits {
  double step = 0.03;       ///< neighbours that differ by this share of the depth are an edge: no depth
  double farthest_m = 6.0;  ///< depth beyond says little
};

/// Mean depth of the 3x3 pixels, 0 where one of them has none or lies on another surface.
inline double depth_at(const stillpoint::DepthView& depth, const cv::Point2f& pixel, const DepthLimits& limits) {
  const int u = cvRound(pixel.x), v = cvRound(pixel.y);
  if (!depth.image.contains(u - 1, v - 1) || !depth.image.contains(u + 1, v + 1)) return 0.0;
  const double centre_m = depth.metres(u, v);
  if (!(centre_m > 0) || centre_m > limits.farthest_m) return 0.0;
  double sum_m = 0.0;
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const double depth_m = depth.metres(u + du, v + dv);
      if (!(depth_m > 0) || std::abs(depth_m - centre_m) > limits.step * centre_m) return 0.0;
      sum_m += depth_m;
    }
  return sum_m / 9.0;
}

inline double depth_at(const Keyframe& frame, const cv::Point2f& pixel, const DepthLimits& limits) {
  return depth_at(stillpoint::DepthView(frame.depth.view(), frame.depth_factor), pixel, limits);
}

/// How many of a frame's features have a depth.
template <class Frame>
std::size_t count_depths(const Frame& frame) {
  return static_cast<std::size_t>(
      std::count_if(frame.depth_m.begin(), frame.depth_m.end(), [](double depth_m) { return depth_m > 0; }));
}

/// Metres plus radians: how far two views are apart.
inline double distance(const Pose& world_from_a, const Pose& world_from_b) {
  const Pose a_from_b = world_from_a.inverse() * world_from_b;
  return a_from_b.translation().norm() + stillpoint::rotation_angle(a_from_b.linear());
}

}  // namespace examples
