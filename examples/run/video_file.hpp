// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A video that is whole or not there.

#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/image_folder.hpp"

namespace stillpoint_run {

/// Writes MPEG-4 into .mp4 and Motion JPEG into .avi: to a temporary file beside the target ("out.partial.mp4"), which
/// gets the target's name on `commit()`. Without it the destructor removes what was written.
class VideoFile {
 public:
  explicit VideoFile(std::filesystem::path target) : target_(std::move(target)) {
    temporary_ = target_;
    temporary_.replace_extension(".partial" + target_.extension().string());
  }
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;
  ~VideoFile() {
    writer_.release();
    std::error_code ignored;
    if (!is_committed_) std::filesystem::remove(temporary_, ignored);
  }

  /// Appends a frame. The first two tell the rate: videos have one.
  /// @param image  CV_8UC3, of the same size each time
  /// @throws stillpoint::Error where there is no encoder or no place to write
  void write(const cv::Mat& image, double time_s) {
    if (writer_.isOpened()) return writer_.write(image);
    if (first_.empty()) {
      first_ = image.clone();
      first_s_ = time_s;
      return;
    }
    open(rate_of(time_s - first_s_));
    writer_.write(first_);
    writer_.write(image);
  }

  /// Gives the video its name.
  void commit() {
    if (!writer_.isOpened() && !first_.empty()) {
      open(stillpoint::kAssumedFrameRate_hz);
      writer_.write(first_);
    }
    writer_.release();
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw stillpoint::Error(target_.string() + ": cannot write the video: " + error.message());
    is_committed_ = true;
  }

 private:
  static double rate_of(double step_s) {
    constexpr double kLeast_hz = 1.0, kMost_hz = 120.0;
    return step_s > 0 ? std::clamp(1.0 / step_s, kLeast_hz, kMost_hz) : stillpoint::kAssumedFrameRate_hz;
  }

  void open(double rate_hz) {
    const bool is_mp4 = target_.extension() == ".mp4";
    const int codec =
        is_mp4 ? cv::VideoWriter::fourcc('m', 'p', '4', 'v') : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (writer_.open(temporary_.string(), codec, rate_hz, first_.size())) return;
    std::error_code ignored;
    const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, ignored))
      throw stillpoint::Error("--save-video: found " + target_.string() + ", expected a folder that is there");
    throw stillpoint::Error("--save-video: cannot write " + target_.string() + ": OpenCV has no encoder for " +
                            (is_mp4 ? "MPEG-4 here (it takes FFmpeg for that); expected a name that ends in .avi"
                                    : "Motion JPEG here, or the folder cannot be written to"));
  }

  std::filesystem::path target_, temporary_;
  cv::VideoWriter writer_;
  cv::Mat first_;
  double first_s_ = 0.0;
  bool is_committed_ = false;
};

}  // namespace stillpoint_run
