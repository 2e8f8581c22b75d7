// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Lucas-Kanade between two pyramids, from a first guess.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <opencv2/video/tracking.hpp>

#include <cstdint>
#include <vector>

namespace examples {

/// @param from            pixels of the first image
/// @param to              where they may be in the second one; improved
/// @param window_px       as the pyramids were made
/// @param pyramid_levels  above the image itself, as the pyramids were made
/// @return                one flag a pixel: whether it was found
inline std::vector<std::uint8_t> flow(const std::vector<cv::Mat>& from_image, const std::vector<cv::Mat>& to_image,
                                      const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>& to, int window_px,
                                      int pyramid_levels, int iterations) {
  std::vector<std::uint8_t> found;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, iterations, 0.01);
  cv::calcOpticalFlowPyrLK(from_image, to_image, from, to, found, cv::noArray(), cv::Size(window_px, window_px),
                           pyramid_levels, until, cv::OPTFLOW_USE_INITIAL_FLOW);
  return found;
}

}  // namespace examples
