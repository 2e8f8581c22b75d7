// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames of two cameras: the left image, with depth from both.

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "frame_source.hpp"
#include "image_sources.hpp"
#include "options.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/euroc_sequence.hpp"
#include "stillpoint/io/image_folder.hpp"
#include "stillpoint/io/stereo_images.hpp"
#include "stillpoint/stereo/rectification.hpp"
#include "stillpoint/stereo/stereo_depth.hpp"

namespace stillpoint_run {

/// What the two sources below share. The camera is that of the rectified left image.
class StereoSource : public FrameSource {
 public:
  StereoSource(stillpoint::Camera camera, double baseline_m)
      : camera_(std::move(camera)), depth_(camera_, baseline_m, depth_options(camera_, baseline_m)) {}

  const stillpoint::Camera& camera() const override { return camera_; }
  std::optional<stillpoint::StereoNoise> stereo_noise() const override { return depth_.noise(); }
  std::vector<std::string> assumptions() const override {
    const double nearest_m = depth_.options().nearest_m, usual_m = stillpoint::StereoDepth::Options{}.nearest_m;
    if (nearest_m == usual_m) return {};
    return {"Nothing is nearer than " + stillpoint::option_text(std::round(nearest_m * 100) / 100) +
            " m: at that depth the disparity is as wide as the image."};
  }

 protected:
  /// @param images  rectified
  SourceFrame frame_of(double timestamp_s, const stillpoint::StereoImages& images) {
    SourceFrame frame;
    frame.timestamp_s = timestamp_s;
    frame.colour = images.left;
    cv::cvtColor(images.left, frame.gray, cv::COLOR_BGR2GRAY);
    cv::cvtColor(images.right, right_gray_, cv::COLOR_BGR2GRAY);
    depth_.compute(frame.gray, right_gray_, frame.depth);
    return frame;
  }

 private:
  /// A pair that is far apart with a narrow view cannot see as near as is usual: the nearest depth that it can.
  static stillpoint::StereoDepth::Options depth_options(const stillpoint::Camera& camera, double baseline_m) {
    stillpoint::StereoDepth::Options options;
    options.nearest_m = std::max(options.nearest_m, stillpoint::StereoDepth::least_nearest_m(camera, baseline_m));
    return options;
  }

  stillpoint::Camera camera_;
  stillpoint::StereoDepth depth_;
  cv::Mat right_gray_;
};

/// A folder in the layout of the EuRoC datasets.
class EurocSource : public StereoSource {
 public:
  explicit EurocSource(const Options& options) : EurocSource(stillpoint::EurocSequence(options.euroc)) {}

  std::string name() const override { return last_name(sequence_.folder()); }
  std::optional<std::size_t> size() const override { return sequence_.frames().size(); }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return ground_truth_; }
  std::size_t missing_files() const override { return sequence_.missing_files(); }
  std::size_t images_without_depth() const override { return sequence_.images_without_partner(); }

  std::optional<SourceFrame> load(std::size_t index) override {
    if (index >= sequence_.frames().size()) return std::nullopt;
    const stillpoint::StereoImages images = sequence_.load(index);
    stillpoint::StereoImages rectified;
    rectification_.rectify(images.left, images.right, rectified.left, rectified.right);
    return frame_of(sequence_.frames()[index].timestamp_s, rectified);
  }

 private:
  explicit EurocSource(stillpoint::EurocSequence sequence)
      : EurocSource(sequence, stillpoint::StereoRectification(sequence.left_camera(), sequence.right_camera(),
                                                              sequence.right_from_left())) {}
  EurocSource(const stillpoint::EurocSequence& sequence, const stillpoint::StereoRectification& rectification)
      : StereoSource(rectification.camera(), rectification.baseline_m()),
        sequence_(sequence),
        rectification_(rectification),
        ground_truth_(sequence.ground_truth()) {
    if (!ground_truth_) return;
    for (stillpoint::StampedPose& pose : *ground_truth_)
      pose.world_from_camera = pose.world_from_camera * rectification.rectified_from_left().inverse();
  }

  stillpoint::EurocSequence sequence_;
  stillpoint::StereoRectification rectification_;
  std::optional<stillpoint::Trajectory> ground_truth_;
};

/// Two folders with the images of a rectified pair.
class StereoFolderSource : public StereoSource {
 public:
  explicit StereoFolderSource(const Options& options) : StereoFolderSource(options, camera_of(options)) {}

  std::string name() const override { return last_name(folder_); }
  std::optional<std::size_t> size() const override { return frames_.size(); }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return kNoGroundTruth; }
  std::vector<std::string> assumptions() const override {
    std::vector<std::string> assumed = StereoSource::assumptions();
    if (list_.rate_is_assumed) assumed.push_back(rate_words());
    return assumed;
  }

  std::optional<SourceFrame> load(std::size_t index) override {
    if (index >= frames_.size()) return std::nullopt;
    return frame_of(frames_[index].timestamp_s, stillpoint::load_stereo_images(frames_[index], camera(), camera()));
  }

 private:
  StereoFolderSource(const Options& options, const stillpoint::ImageCamera& pair)
      : StereoSource(pair.camera, *pair.baseline_m),
        folder_(options.images),
        list_(stillpoint::read_image_folder(folder_, given_rate(options))),
        frames_(stillpoint::pair_with_right_folder(list_, options.right)) {}

  static stillpoint::ImageCamera camera_of(const Options& options) {
    const std::filesystem::path file = camera_file(options);
    if (file.empty())
      throw stillpoint::Error("--right: found no camera, expected --camera FILE, or camera.yaml in " +
                              options.images.string() + ", with fx fy cx cy width height baseline_m in it");
    const stillpoint::ImageCamera pair = stillpoint::read_image_camera(file);
    if (!pair.baseline_m)
      throw stillpoint::Error(file.string() +
                              ": baseline_m is missing, expected the distance of the two cameras in metres");
    if (!std::holds_alternative<stillpoint::NoDistortion>(pair.camera.distortion().model))
      throw stillpoint::Error(file.string() +
                              ": found lens distortion, expected a pinhole: --right takes rectified images");
    return pair;
  }

  std::filesystem::path folder_;
  stillpoint::ImageList list_;
  std::vector<stillpoint::StereoFrame> frames_;
};

}  // namespace stillpoint_run
