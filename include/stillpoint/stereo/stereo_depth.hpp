// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A rectified pair of images → depth of the left one, with holes where the two do not agree.
//
// Source: Hirschmüller, "Stereo Processing by Semiglobal Matching and Mutual Information", PAMI 2008, as
// cv::StereoSGBM has it.

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/stereo/image_pair.hpp"

namespace stillpoint {

/// Depth by block matching. One object, one thread: it holds scratch memory.
class StereoDepth {
 public:
  struct Options {
    double nearest_m = 0.5;           ///< what is nearer has no depth; half of it takes twice the time
    double least_disparity_px = 2.0;  ///< what is farther has none: a pixel more or less would be half of its depth
    int block_px = 5;                 ///< odd, 1 to 11
    double disparity_sigma_px = 0.3;  ///< standard deviation where there is texture, see `noise()`
    int left_right_px = 1;            ///< disparities found from the right image may differ by so much
    int uniqueness_percent = 10;      ///< by which the best disparity must beat the others
    int speckle_pixels = 100;         ///< smaller patches of like disparity are taken for mistakes
    int speckle_step_px = 1;          ///< alike: so much from pixel to pixel
  };

  /// @param camera      of the rectified left image
  /// @param baseline_m  from the left camera to the right one
  /// @throws Error if the baseline or an option makes no sense, or the nearest depth asks for disparities beyond the
  ///         image's width.
  StereoDepth(const Camera& camera, double baseline_m) : StereoDepth(camera, baseline_m, Options{}) {}
  StereoDepth(const Camera& camera, double baseline_m, const Options& options)
      : options_(options),
        size_(camera.width(), camera.height()),
        noise_{camera.fx(), baseline_m, options.disparity_sigma_px} {
    require(baseline_m > 0 && std::isfinite(baseline_m), "baseline_m", baseline_m, "a positive number of metres");
    require(options.nearest_m > 0 && std::isfinite(options.nearest_m), "nearest_m", options.nearest_m,
            "a positive number of metres");
    require(options.least_disparity_px > 0 && std::isfinite(options.least_disparity_px), "least_disparity_px",
            options.least_disparity_px, "a positive number of pixels");
    require(options.disparity_sigma_px > 0 && std::isfinite(options.disparity_sigma_px), "disparity_sigma_px",
            options.disparity_sigma_px, "a positive number of pixels");
    require(options.block_px >= 1 && options.block_px <= kLargestBlock_px && options.block_px % 2 == 1, "block_px",
            options.block_px, "an odd number of pixels from 1 to " + std::to_string(kLargestBlock_px));
    require(options.left_right_px >= 0, "left_right_px", options.left_right_px, "0 or more pixels");
    require(options.uniqueness_percent >= 0 && options.uniqueness_percent <= 100, "uniqueness_percent",
            options.uniqueness_percent, "0 to 100");
    require(options.speckle_pixels >= 0, "speckle_pixels", options.speckle_pixels, "0 or more pixels");
    require(options.speckle_step_px >= 0, "speckle_step_px", options.speckle_step_px, "0 or more pixels");
    const double most_px = kStep_px * std::ceil(camera.fx() * baseline_m / options.nearest_m / kStep_px);
    require(most_px < camera.width(), "nearest_m", options.nearest_m,
            "a depth at which the disparity, " + option_text(most_px) + " px, is within the image");
    constexpr int kSmallStep = 8,
                  kLargeStep = 32;  // penalties per pixel of a block, as OpenCV's documentation has them
    const int block_area = options.block_px * options.block_px;
    matcher_ = cv::StereoSGBM::create(0, static_cast<int>(most_px), options.block_px, kSmallStep * block_area,
                                      kLargeStep * block_area, options.left_right_px, kPrefilterCap,
                                      options.uniqueness_percent, options.speckle_pixels, options.speckle_step_px,
                                      cv::StereoSGBM::MODE_SGBM_3WAY);
  }

  /// The least depth in metres that a pair can be asked for: there the disparity is as wide as the image. Infinity
  /// where an image is too narrow for any.
  static double least_nearest_m(const Camera& camera, double baseline_m) {
    const double widest_px = kStep_px * (std::ceil(camera.width() / kStep_px) - 1.0);  // below the width
    constexpr double kRoundedUp = 1.0 + 1e-9;  // else the quotient may be a step more
    return camera.fx() * baseline_m / widest_px * kRoundedUp;
  }

  const Options& options() const { return options_; }

  /// What the filter should expect of these depths: `filter.depth_noise = stereo.noise()`.
  const StereoNoise& noise() const { return noise_; }

  /// Computes the depth of the left image.
  /// @param left, right  CV_8UC1, rectified, of the camera's size
  /// @param depth_m      gets CV_32FC1, metres along the optical axis, 0 where there is none
  /// @throws Error if an image is of another type or size.
  void compute(const cv::Mat& left, const cv::Mat& right, cv::Mat& depth_m) {
    detail::require_pair(left, right, std::to_string(size_.width) + " x " + std::to_string(size_.height) + ", gray",
                         [&](const cv::Mat& image) { return image.type() == CV_8UC1 && image.size() == size_; });
    match(left, right, left_disparity_);
    // The right image's disparities are those of the mirrored pair: what is left in it becomes right.
    cv::flip(left, mirrored_left_, kSideways);
    cv::flip(right, mirrored_right_, kSideways);
    match(mirrored_right_, mirrored_left_, right_disparity_);

    depth_m.create(size_, CV_32FC1);
    const auto least = static_cast<float>(options_.least_disparity_px);
    const auto focal_times_baseline = static_cast<float>(noise_.focal_px * noise_.baseline_m);
    for (int v = 0; v < size_.height; ++v) {
      auto* const to = depth_m.ptr<float>(v);
      for (int u = 0; u < size_.width; ++u) {
        const float disparity_px = in_pixels(left_disparity_, u, v);
        const bool is_seen_twice = disparity_px >= least && agrees(disparity_px, u, v);
        to[u] = is_seen_twice ? focal_times_baseline / disparity_px : 0.0f;
      }
    }
  }

 private:
  // SGBM counts costs in 16 bit: of an ideal pair it measures 99.9 % with 11, 97 % with 21, 0.4 % with 31.
  static constexpr int kLargestBlock_px = 11;
  static constexpr double kStep_px = 16.0;  ///< SGBM counts disparities in these
  static constexpr int kPrefilterCap = 31;  ///< of the horizontal gradient that SGBM compares beside the grey levels

  template <class Value>
  static void require(bool holds, const char* name, Value found, const std::string& expected) {
    if (!holds) throw Error(std::string("stereo: ") + name + " is " + option_text(found) + ", expected " + expected);
  }

  static constexpr int kSideways = 1;  ///< for cv::flip

  /// Disparities of `image`, whose partner shows everything further left, with `disparity_columns()` more at the left.
  void match(const cv::Mat& image, const cv::Mat& partner, cv::Mat& disparity) {
    // SGBM leaves out as many columns at the left border as it tries disparities: they are given to it.
    cv::copyMakeBorder(image, padded_, 0, 0, disparity_columns(), 0, cv::BORDER_REPLICATE);
    cv::copyMakeBorder(partner, padded_partner_, 0, 0, disparity_columns(), 0, cv::BORDER_REPLICATE);
    matcher_->compute(padded_, padded_partner_, disparity);
  }
  int disparity_columns() const { return matcher_->getNumDisparities(); }

  float in_pixels(const cv::Mat& disparity, int u, int v) const {
    constexpr float kUnits = cv::StereoMatcher::DISP_SCALE;
    return static_cast<float>(disparity.ptr<std::int16_t>(v)[u + disparity_columns()]) / kUnits;
  }

  /// Whether the right image leads back to where the left one led from: not so where one camera alone sees something.
  bool agrees(float disparity_px, int u, int v) const {
    const int there = cvRound(static_cast<float>(u) - disparity_px);
    if (there < 0) return false;
    const float back_px = in_pixels(right_disparity_, size_.width - 1 - there, v);
    return std::abs(back_px - disparity_px) <= static_cast<float>(options_.left_right_px);
  }

  Options options_;
  cv::Size size_;
  StereoNoise noise_;
  cv::Ptr<cv::StereoSGBM> matcher_;
  cv::Mat padded_, padded_partner_, mirrored_left_, mirrored_right_, left_disparity_, right_disparity_;
};

}  // namespace stillpoint
