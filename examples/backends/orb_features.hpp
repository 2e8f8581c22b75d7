// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// ORB corners with their descriptors and weights, as they go through the filter.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include <cstdint>
#include <vector>

#include "feature_weights.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

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

}  // namespace examples
