// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is counted of a method over a sequence whose pixels are labelled and whose poses are known.

#include <opencv2/core/types.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "accuracy_sequence.hpp"
#include "quantiles.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/feature_score.hpp"

namespace stillpoint::bench {

/// What a method did to a sequence; empty where there is nothing to count.
struct Outcome {
  std::optional<double> recall_percent, false_positives_percent;
  std::optional<double> p95_mm, p95_deg;  ///< of the motions that were claimed
};

/// Counts one method over one sequence.
class Tally {
 public:
  /// Takes the flags of a frame, and the motion from the last frame where the method claims one.
  void add(const LabelledFrame& frame, const LabelledFrame* last, span<const std::uint8_t> keep,
           const std::optional<Pose>& current_from_last) {
    pixels_.clear();
    for (const cv::KeyPoint& keypoint : frame.keypoints) pixels_.emplace_back(keypoint.pt.x, keypoint.pt.y);
    if (!frame.labels.empty()) score_.add_frame(frame.labels, pixels_, keep);
    if (!current_from_last || last == nullptr || !frame.world_from_camera || !last->world_from_camera) return;
    const Pose truth = frame.world_from_camera->inverse() * *last->world_from_camera;
    const Pose error = truth.inverse() * *current_from_last;
    error_mm_.push_back(1e3 * error.translation().norm());
    error_deg_.push_back(kDegreesPerRadian * Eigen::AngleAxisd(orthonormalized(error).linear()).angle());
  }

  Outcome outcome() {
    const auto percent = [](const std::optional<double>& share) {
      return share ? std::optional(100 * *share) : std::nullopt;
    };
    return {percent(score_.recall()), percent(score_.false_positive_rate()), percentile_95(error_mm_),
            percentile_95(error_deg_)};
  }

 private:
  FilterScore score_;
  std::vector<Vector2f> pixels_;
  std::vector<double> error_mm_, error_deg_;
};

}  // namespace stillpoint::bench
