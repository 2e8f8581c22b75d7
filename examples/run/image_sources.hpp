// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames of one camera without depth: a folder of images, a video, a camera that is connected.

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "frame_source.hpp"
#include "options.hpp"
#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/image_file.hpp"
#include "stillpoint/io/image_folder.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/video_source.hpp"

namespace stillpoint_run {

/// Where the camera of `--images` and `--video` is written down; empty where nothing says.
inline std::filesystem::path camera_file(const Options& options) {
  if (!options.camera.empty()) return options.camera;
  const std::filesystem::path beside = options.images / "camera.yaml";
  std::error_code ignored;
  return !options.images.empty() && std::filesystem::exists(beside, ignored) ? beside : std::filesystem::path();
}

inline std::optional<double> given_rate(const Options& options) {
  return options.frame_rate_hz > 0 ? std::optional(options.frame_rate_hz) : std::nullopt;
}

inline std::string rate_words() {
  return "The files' names tell no times: " + stillpoint::format_fixed(stillpoint::kAssumedFrameRate_hz, 0) +
         " frames per second are assumed (--fps).";
}

/// What the two sources below share: a camera that may have to be guessed, and no depth.
class ImageSource : public FrameSource {
 public:
  ImageSource(const Options& options, const cv::Size& size) : camera_(camera_of(options, size)) {
    is_assumed_ = camera_file(options).empty();
  }

  const stillpoint::Camera& camera() const override { return camera_; }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return kNoGroundTruth; }
  bool has_depth() const override { return false; }
  std::vector<std::string> assumptions() const override {
    if (!is_assumed_) return {};
    return {"The camera is not known: a pinhole with a horizontal field of view of " +
            stillpoint::format_fixed(kFieldOfView_deg, 0) + " degrees is assumed (--camera)."};
  }

 protected:
  static SourceFrame frame_of(double timestamp_s, cv::Mat colour) {
    SourceFrame frame;
    frame.timestamp_s = timestamp_s;
    frame.colour = std::move(colour);
    cv::cvtColor(frame.colour, frame.gray, cv::COLOR_BGR2GRAY);
    return frame;
  }

 private:
  static constexpr double kFieldOfView_deg = 60.0;  ///< of a usual webcam, and of telephones that film

  static stillpoint::Camera camera_of(const Options& options, const cv::Size& size) {
    const std::filesystem::path file = camera_file(options);
    if (file.empty()) {
      const double focal_px = 0.5 * size.width / std::tan(0.5 * kFieldOfView_deg * 3.141592653589793 / 180.0);
      return {focal_px, focal_px, 0.5 * (size.width - 1), 0.5 * (size.height - 1), size.width, size.height};
    }
    const stillpoint::Camera camera = stillpoint::read_image_camera(file).camera;
    if (camera.width() != size.width || camera.height() != size.height)
      throw stillpoint::Error(file.string() + ": found a camera of " + std::to_string(camera.width()) + " x " +
                              std::to_string(camera.height()) + " pixels, expected that of the images, " +
                              std::to_string(size.width) + " x " + std::to_string(size.height));
    return camera;
  }

  stillpoint::Camera camera_;
  bool is_assumed_ = false;
};

/// All images of a folder.
class ImageFolderSource : public ImageSource {
 public:
  explicit ImageFolderSource(const Options& options)
      : ImageFolderSource(options, stillpoint::read_image_folder(options.images, given_rate(options))) {}

  std::string name() const override { return last_name(folder_); }
  std::optional<std::size_t> size() const override { return list_.images.size(); }
  std::vector<std::string> assumptions() const override {
    std::vector<std::string> all = ImageSource::assumptions();
    if (list_.rate_is_assumed) all.push_back(rate_words());
    return all;
  }

  std::optional<SourceFrame> load(std::size_t index) override {
    if (index >= list_.images.size()) return std::nullopt;
    const stillpoint::TimedImage& image = list_.images[index];
    cv::Mat colour = stillpoint::read_image(image.file, cv::IMREAD_COLOR);
    stillpoint::require_size(image.file, colour, camera());
    return frame_of(image.timestamp_s, std::move(colour));
  }

 private:
  ImageFolderSource(const Options& options, stillpoint::ImageList list)
      : ImageSource(options, stillpoint::read_image(list.images.front().file, cv::IMREAD_COLOR).size()),
        folder_(options.images),
        list_(std::move(list)) {}

  std::filesystem::path folder_;
  stillpoint::ImageList list_;
};

/// A video or a camera.
class VideoFrames : public ImageSource {
 public:
  explicit VideoFrames(const Options& options) : VideoFrames(options, open(options)) {}

  std::string name() const override { return video_->is_live() ? video_->name() : last_name(video_->name()); }
  std::optional<std::size_t> size() const override { return std::nullopt; }

  std::optional<SourceFrame> load(std::size_t index) override {
    cv::Mat colour;
    double timestamp_s = 0.0;
    for (; next_ <= index; ++next_)
      if (!video_->read(colour, timestamp_s)) return std::nullopt;
    return frame_of(timestamp_s, std::move(colour));
  }

 private:
  VideoFrames(const Options& options, std::unique_ptr<stillpoint::VideoSource> video)
      : ImageSource(options, video->size()), video_(std::move(video)) {}

  static std::unique_ptr<stillpoint::VideoSource> open(const Options& options) {
    if (const std::optional<int> device = options.device()) return std::make_unique<stillpoint::VideoSource>(*device);
    return std::make_unique<stillpoint::VideoSource>(std::filesystem::path(options.video), given_rate(options));
  }

  std::unique_ptr<stillpoint::VideoSource> video_;
  std::size_t next_ = 0;
};

}  // namespace stillpoint_run
