// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// ORB corners spread over the image.

#include <opencv2/core/mat.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "orb_features.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/opencv.hpp"

namespace examples {

/// Detects ORB corners and takes the best of each place.
class SpreadOrb {
 public:
  static constexpr double kScale = 1.2;  ///< of a level of the pyramid to the next
  static constexpr int kLevels = 8;

  struct Options {
    int features = 1000;
    int candidates = 4;      ///< times as many corners are detected, of which the best of each place are taken
    int fast_threshold = 7;  ///< gray values by which a corner differs from what surrounds it
    int cell_px = 32;        ///< side of a place
    int thinning = 4;        ///< times fewer corners are taken where the last frame's were dropped: see `look_past`
  };
  Options options;

  explicit SpreadOrb(const Options& settings)
      : options(settings),
        orb_(cv::ORB::create(settings.features * settings.candidates, static_cast<float>(kScale), kLevels, 31, 0, 2,
                             cv::ORB::HARRIS_SCORE, 31, settings.fast_threshold)) {}

  OrbFeatures extract(const stillpoint::FrameView& frame) {
    const cv::Mat gray = stillpoint::as_mat(stillpoint::with_gray(frame, gray_).gray);
    OrbFeatures features;
    orb_->detect(gray, features.keypoints);
    spread(gray.size(), features.keypoints);
    size_ = gray.size();
    orb_->compute(gray, features.keypoints, features.descriptors);
    return features;
  }

  /// Moving objects soon cover most of an image, and most corners would be found on them only to be dropped. So where
  /// the filter dropped more of this frame's corners than it kept, the next frame has fewer: the rest has more.
  /// @param extracted  of the last frame, all of them
  /// @param kept       those that the filter kept
  void look_past(const std::vector<cv::KeyPoint>& extracted, const std::vector<cv::KeyPoint>& kept) {
    is_covered_ = cv::Mat();
    if (kept.size() >= extracted.size() || options.thinning == 1) return;
    cv::Mat balance(size_.height / kCovered_px + 1, size_.width / kCovered_px + 1, CV_32F, cv::Scalar(0));
    for (const cv::KeyPoint& corner : extracted) balance.at<float>(covered_cell(corner)) += 1.0F;  // dropped
    for (const cv::KeyPoint& corner : kept) balance.at<float>(covered_cell(corner)) -= 2.0F;       // less kept
    cv::boxFilter(balance, balance, -1, cv::Size(3, 3), cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
    is_covered_ = balance > 0;
  }

 private:
  static constexpr int kCovered_px = 32;

  static cv::Point covered_cell(const cv::KeyPoint& corner) {
    return {static_cast<int>(corner.pt.x) / kCovered_px, static_cast<int>(corner.pt.y) / kCovered_px};
  }

  /// The strongest corner of each place first, then the second of each, until there are enough: where the texture is
  /// richest, on a poster or a shirt, there are no more of them than elsewhere.
  void spread(const cv::Size& size, std::vector<cv::KeyPoint>& keypoints) const {
    std::stable_sort(keypoints.begin(), keypoints.end(),
                     [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
    const int columns = size.width / options.cell_px + 1, rows = size.height / options.cell_px + 1;
    std::vector<int> count(static_cast<std::size_t>(columns * rows), 0);
    std::vector<std::pair<int, std::size_t>> rank;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const int column = static_cast<int>(keypoints[i].pt.x) / options.cell_px;
      const int row = static_cast<int>(keypoints[i].pt.y) / options.cell_px;
      const int place = count[static_cast<std::size_t>(row * columns + column)]++;
      const bool is_covered = !is_covered_.empty() && is_covered_.at<std::uint8_t>(covered_cell(keypoints[i])) != 0;
      rank.emplace_back(is_covered ? options.thinning * place : place, i);
    }
    std::sort(rank.begin(), rank.end());
    rank.resize(std::min(rank.size(), static_cast<std::size_t>(options.features)));
    std::vector<cv::KeyPoint> taken;
    for (const auto& entry : rank) taken.push_back(keypoints[entry.second]);
    std::stable_sort(taken.begin(), taken.end(),
                     [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.octave < b.octave; });
    keypoints = std::move(taken);
  }

  cv::Ptr<cv::ORB> orb_;
  cv::Size size_;
  cv::Mat is_covered_;  ///< by cells; empty: nothing is
  stillpoint::ImageBuffer gray_;
};

}  // namespace examples
