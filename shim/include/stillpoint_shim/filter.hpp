// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Filter: the filter with its default policies, for a host in C++11. All of this is compiled by the host; behind it,
// plain data crosses into the library (types.hpp).

#include <opencv2/core/core.hpp>

#include <memory>
#include <stdexcept>
#include <vector>

#include "stillpoint_shim/types.hpp"

namespace stillpoint_shim {

/// Tells which of a frame's features stand still. One filter for one camera; one is not for two threads.
class Filter {
 public:
  /// @throws std::invalid_argument that names the field, the value found and what was expected
  explicit Filter(const Camera& camera, const Settings& settings = Settings())
      : width_(camera.width), height_(camera.height), settings_(settings) {
    char message[512] = "";
    engine_.reset(detail::create(camera, settings, message, sizeof(message)));
    if (!engine_) throw std::invalid_argument(message);
  }

  /// What the filter works with.
  const Settings& settings() const { return settings_; }

  /// Changes them between two frames; nothing that was seen is forgotten. As an example, a host lowers
  /// `fewest_features` once its map has begun.
  /// @throws std::invalid_argument as the constructor; then none of them has changed
  void change_settings(const Settings& settings) {
    char message[512] = "";
    if (!detail::change_settings(*engine_, settings, message, sizeof(message))) throw std::invalid_argument(message);
    settings_ = settings;
  }

  /// Judges the keypoints of a frame. Call it before the tracker, with frames in the order of time. Throws nothing but
  /// std::bad_alloc.
  /// @param image        CV_8UC1, or CV_8UC3 (BGR); as the camera gives it, that is distorted
  /// @param depth        CV_16UC1 in units of `Settings::depth_factor`, or CV_32FC1 in metres; empty where there is
  /// none
  /// @param timestamp_s  seconds
  /// @param keypoints    pixels of the image as it is
  /// @return             valid until the next call. A frame that can't be judged keeps everything, its status says why.
  const Result& filter_frame(const cv::Mat& image, const cv::Mat& depth, double timestamp_s,
                             const std::vector<cv::KeyPoint>& keypoints) {
    const float* const first = keypoints.empty() ? nullptr : &keypoints.front().pt.x;
    return filter(image, depth, timestamp_s, {first, sizeof(cv::KeyPoint), keypoints.size()});
  }
  /// The same for plain points.
  const Result& filter_frame(const cv::Mat& image, const cv::Mat& depth, double timestamp_s,
                             const std::vector<cv::Point2f>& points) {
    return filter(image, depth, timestamp_s, {points.data(), sizeof(cv::Point2f), points.size()});
  }

  /// The answer for the last frame.
  const Result& result() const { return result_; }

  /// How much each feature of the last frame may say in an estimate, 0 to 1: the probability
  /// that it is static, and less where something moved before (`stillpoint::weights`).
  void weights(std::vector<float>& weights) const {
    weights.resize(result_.keep.size());
    detail::copy_weights(*engine_, weights.data(), weights.size());
  }

  /// Paints the last answer as CV_8UC1 of the camera's size: 255 keeps, 0 within `radius_px` of a dropped feature.
  /// Before the first frame all of it is 255.
  void mask(cv::Mat& mask, int radius_px = 12) const { detail::paint_mask(*engine_, radius_px, pixels_of(mask)); }

  /// Paints where the coming frame should be looked at, as CV_8UC1 of the camera's size: 255 keeps, 0 drops. For a host
  /// that extracts features under a mask, so that its budget goes to static features; all of it is 255 where the last
  /// frame was not judged. It knows no keep-floor.
  /// @param timestamp_s  of the coming frame
  /// @param margin_px    more is dropped around moving objects; 8 in all measured figures (docs/adopting.md)
  void predicted_keep_mask(double timestamp_s, cv::Mat& mask, int margin_px = 8) const {
    detail::paint_predicted_keep_mask(*engine_, timestamp_s, margin_px, pixels_of(mask));
  }

  /// Boxes of a detector in the coming frame. None: no new answer.
  void set_boxes(const std::vector<Box>& boxes) { detail::set_boxes(*engine_, boxes.data(), boxes.size(), nullptr); }
  /// Boxes in the frame of that time, the coming one or one that is gone: an answer may be late. None: nothing was
  /// seen.
  void set_boxes(const std::vector<Box>& boxes, double timestamp_s) {
    detail::set_boxes(*engine_, boxes.data(), boxes.size(), &timestamp_s);
  }

  /// The host's own pose of the frame that was filtered last, after its tracking: those of two frames in a row predict
  /// the next motion. Optional, and of use only where the host's poses are better than the filter's.
  /// @param world_from_camera  4 x 4, row by row, metres; ORB-SLAM's Tcw is its inverse
  /// @return                   false if it is no rigid motion; then it is not taken
  bool feedback(const double (&world_from_camera)[16]) { return detail::feedback(*engine_, world_from_camera); }

  /// What an IMU or wheels say of the coming motion; holds for the next frame.
  /// @param current_from_reference  4 x 4, row by row, metres: from the camera of the last frame to that of the next
  /// @return                        false if it is no rigid motion, or is longer than 100 m; then it is not taken
  bool expect_motion(const double (&current_from_reference)[16]) {
    return detail::expect_motion(*engine_, current_from_reference);
  }

  /// Forgets all frames: where the images jump to another place, as when a recording begins again. Not for a
  /// relocalisation or a new map of the host: the images go on. Settings stay.
  void reset() {
    detail::reset(*engine_);
    result_ = Result();
  }

 private:
  struct Destroy {
    void operator()(detail::Engine* engine) const { detail::destroy(engine); }
  };

  static detail::Image view(const cv::Mat& image) {
    if (image.empty() || image.dims != 2) return {nullptr, 0, 0, 0, 0};
    return {image.data, image.cols, image.rows, image.step[0], image.type()};
  }

  /// The mask, made a gray image of the camera's size.
  detail::Pixels pixels_of(cv::Mat& mask) const {
    mask.create(height_, width_, CV_8UC1);
    return {mask.data, mask.step[0]};
  }

  const Result& filter(const cv::Mat& image, const cv::Mat& depth, double timestamp_s, const detail::Points& points) {
    result_.keep.assign(points.count, 1);
    const detail::Answer answer =
        detail::filter_frame(*engine_, view(image), view(depth), timestamp_s, points, result_.keep.data());
    result_.status = answer.status;
    result_.hint = answer.hint;
    result_.judged = answer.judged;
    result_.keep_floor = answer.keep_floor;
    result_.kept_count = 0;
    for (const unsigned char flag : result_.keep) result_.kept_count += flag;
    return result_;
  }

  int width_, height_;
  Settings settings_;
  std::unique_ptr<detail::Engine, Destroy> engine_;
  Result result_;
};

/// What a detector's class is known for: "person" is dynamic, "chair" movable, "sofa" fixed (names of COCO and VOC).
inline Mobility mobility_of(const char* class_name) { return detail::mobility_of(class_name); }

}  // namespace stillpoint_shim
