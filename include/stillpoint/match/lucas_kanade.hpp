// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where was each feature in the last frame?   OpenCV's pyramidal Lucas-Kanade, from the current frame back.

#include <opencv2/core/mat.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {

/// The paper's matching (3.3): Lucas-Kanade from the current frame's keypoints to the last frame gives S_L, S_C.
/// Source: Lucas and Kanade, "An Iterative Image Registration Technique", IJCAI 1981; pyramids after Bouguet, 2001.
class LucasKanade {
 public:
  using Needs = Capabilities<>;
  using Provides = Capabilities<capability::matches, capability::feature_matches>;

  struct Options {
    int window_px = 21;                ///< side of the window (OpenCV's default; the paper names none)
    int pyramid_levels = 3;            ///< levels above the image itself (OpenCV's default)
    int iterations = 30;               ///< at most, on each level (OpenCV's default)
    float precision_px = 0.01f;        ///< smaller steps end the iteration (OpenCV's default)
    float forward_backward_px = 1.0f;  ///< a match that does not come back this near is lost; 0: not checked
    float border_px = 10.0f;           ///< nearer to either image's border a feature stays out of ego-motion
  };
  Options options;

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    if (!remembers(reference)) build_pyramid(reference, reference_pyramid_);
    build_pyramid(current, current_pyramid_);
    gather(current, matches);
    if (!from_.empty()) {
      track(current_pyramid_, reference_pyramid_, from_, to_, found_);
      if (options.forward_backward_px > 0) track(reference_pyramid_, current_pyramid_, to_, back_, found_back_);
      scatter(reference, current, matches);
    }
    std::swap(reference_pyramid_, current_pyramid_);
    reference_time_s_ = current.timestamp_s;
    reference_window_px_ = options.window_px;
    reference_levels_ = options.pyramid_levels;
  }

  void reset() noexcept { reference_time_s_ = std::numeric_limits<double>::quiet_NaN(); }

 private:
  using Pyramid = std::vector<cv::Mat>;

  /// The last frame's pyramid is the reference's, made with the options of now.
  bool remembers(const FrameView& reference) const noexcept {
    return reference_time_s_ == reference.timestamp_s && reference_window_px_ == options.window_px &&
           reference_levels_ == options.pyramid_levels;
  }

  cv::Size window() const { return {options.window_px, options.window_px}; }

  void build_pyramid(const FrameView& frame, Pyramid& pyramid) const {
    cv::buildOpticalFlowPyramid(as_mat(frame.gray), pyramid, window(), options.pyramid_levels, true,
                                cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT, false);
  }

  void track(const Pyramid& from_image, const Pyramid& to_image, const std::vector<cv::Point2f>& from,
             std::vector<cv::Point2f>& to, std::vector<unsigned char>& found) const {
    const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, options.iterations,
                                static_cast<double>(options.precision_px));
    cv::calcOpticalFlowPyrLK(from_image, to_image, from, to, found, cv::noArray(), window(), options.pyramid_levels,
                             stop);
  }

  /// Keypoints outside the image or not finite are never handed to OpenCV.
  void gather(const FrameView& current, Matches& matches) {
    from_.clear();
    feature_.clear();
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const Vector2f pixel = matches.current.pixel[i];
      if (!(current.gray.border_distance_px(pixel.x(), pixel.y()) >= 0.0f)) {
        matches.state[i] = MatchState::outside;
        continue;
      }
      feature_.push_back(i);
      from_.emplace_back(pixel.x(), pixel.y());
    }
  }

  void scatter(const FrameView& reference, const FrameView& current, Matches& matches) const {
    for (std::size_t k = 0; k < feature_.size(); ++k) {
      const float there = reference.gray.border_distance_px(to_[k].x, to_[k].y);
      if (found_[k] == 0 || !(there >= 0.0f) || !comes_back(k)) continue;
      matches.reference.pixel[feature_[k]] = {to_[k].x, to_[k].y};
      const float here = current.gray.border_distance_px(from_[k].x, from_[k].y);
      matches.state[feature_[k]] = found_at(std::min(here, there), options.border_px);
    }
  }

  bool comes_back(std::size_t k) const {
    if (!(options.forward_backward_px > 0)) return true;
    return found_back_[k] != 0 &&
           std::hypot(back_[k].x - from_[k].x, back_[k].y - from_[k].y) <= options.forward_backward_px;
  }

  Pyramid reference_pyramid_, current_pyramid_;
  double reference_time_s_ = std::numeric_limits<double>::quiet_NaN();
  int reference_window_px_ = 0;
  int reference_levels_ = 0;
  std::vector<std::size_t> feature_;
  std::vector<cv::Point2f> from_, to_, back_;
  std::vector<unsigned char> found_, found_back_;
};

// OpenCV throws for windows below 3 pixels and for negative levels.
template <class Visit>
void each_option(LucasKanade& stage, Visit& visit) {
  visit("window_px", stage.options.window_px, OptionRange{3, 101});
  visit("pyramid_levels", stage.options.pyramid_levels, OptionRange{0, 16});
  visit("iterations", stage.options.iterations, OptionRange{1, 100});
  visit("precision_px", stage.options.precision_px, OptionRange{0, 10});
  visit("forward_backward_px", stage.options.forward_backward_px, OptionRange{0, 1000});
  visit("border_px", stage.options.border_px, OptionRange{0, 1000});
}

}  // namespace stillpoint
