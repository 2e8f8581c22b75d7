// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The plainest host that has tracks: corners that OpenCV's Lucas-Kanade follows, topped up where some are lost.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"

namespace examples {

/// The corners of the newest frame, and what `ProvidedMatches` asks for.
class FollowedCorners {
 public:
  explicit FollowedCorners(int most) : most_(most) {}

  std::vector<stillpoint::Vector2f> pixels;
  std::vector<stillpoint::Vector2f> reference_pixels;  ///< where each was in the last frame; NaN: it is new

  /// @param gray  8 bits
  void next(const cv::Mat& gray) {
    std::vector<cv::Point2f> followed, back;
    std::vector<unsigned char> found, found_back;
    if (!corners_.empty()) {
      cv::calcOpticalFlowPyrLK(last_, gray, corners_, followed, found, cv::noArray());
      cv::calcOpticalFlowPyrLK(gray, last_, followed, back, found_back, cv::noArray());
    }
    const std::vector<cv::Point2f> before = std::exchange(corners_, {});
    pixels.clear();
    reference_pixels.clear();
    cv::Mat is_free(gray.size(), CV_8UC1, cv::Scalar(255));
    const cv::Rect2f inside(0, 0, static_cast<float>(gray.cols - 1), static_cast<float>(gray.rows - 1));
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] == 0 || found_back[i] == 0 || !inside.contains(followed[i])) continue;
      if (cv::norm(back[i] - before[i]) > kForwardBackward_px) continue;
      add(followed[i], {before[i].x, before[i].y});
      cv::circle(is_free, followed[i], kSpacing_px, cv::Scalar(0), cv::FILLED);
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (const cv::Point2f& corner : strongest(gray, is_free)) add(corner, {kNaN, kNaN});
    gray.copyTo(last_);
  }

 private:
  static constexpr int kSpacing_px = 5;
  static constexpr double kForwardBackward_px = 0.7;  // a corner that does not come back this near has slid

  std::vector<cv::Point2f> strongest(const cv::Mat& gray, const cv::Mat& is_free) const {
    constexpr double kQuality = 0.01;
    std::vector<cv::Point2f> corners;
    const int missing = most_ - static_cast<int>(pixels.size());
    if (missing > 0) cv::goodFeaturesToTrack(gray, corners, missing, kQuality, kSpacing_px, is_free);
    return corners;
  }

  void add(const cv::Point2f& corner, const stillpoint::Vector2f& before) {
    corners_.push_back(corner);
    pixels.emplace_back(corner.x, corner.y);
    reference_pixels.push_back(before);
  }

  int most_;
  cv::Mat last_;
  std::vector<cv::Point2f> corners_;
};

}  // namespace examples
