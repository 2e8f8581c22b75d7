// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames of a video file or of a camera that is connected, by OpenCV.

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/frame_rate.hpp"
#include "stillpoint/io/whole_video.hpp"

namespace stillpoint {

/// Hands out one frame after the other. How many there will be is not known: a camera goes on, and what video files say
/// of their length is often wrong.
class VideoSource {
 public:
  /// Opens a file.
  /// @param frame_rate_hz  frames per second. Without: each frame's own time, as the file has it.
  /// @throws Error if the file is missing, breaks off (AVI, MP4 and Matroska tell), is no video that OpenCV reads, or
  ///         holds no frame; if the rate is not positive and finite.
  explicit VideoSource(const std::filesystem::path& file, std::optional<double> frame_rate_hz = std::nullopt)
      : name_(file.string()), given_rate_hz_(frame_rate_hz) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) throw Error(name_ + ": no such file, expected a video");
    if (const std::uint64_t missing = detail::missing_bytes(file); missing > 0)
      throw Error(name_ + ": breaks off, " + std::to_string(missing) +
                  " bytes before the end that it states, expected a whole video");
    open([&] { return capture_.open(name_); }, "a video in a format that this OpenCV reads");
    rate_hz_ = frame_rate_hz.value_or(stated_rate_hz());
  }

  /// Opens a camera; the time of its frames is that of this computer's clock.
  /// @param device  its number, counted from 0.
  /// @throws Error if there is none or it gives no frame.
  explicit VideoSource(int device) : name_("camera " + std::to_string(device)), is_live_(true) {
    open([&] { return capture_.open(device); }, "the number of a camera that is connected and not in use");
  }
  VideoSource(const VideoSource&) = delete;  // two would share the position
  VideoSource& operator=(const VideoSource&) = delete;

  const std::string& name() const { return name_; }
  cv::Size size() const { return size_; }
  bool is_live() const { return is_live_; }

  /// Gives the next frame.
  /// @param colour       CV_8UC3, BGR, a new image; unchanged at the end
  /// @param timestamp_s  since the first frame, rising
  /// @return        false at the end of the file, and where a camera gives no more.
  /// @throws Error if a frame is of another size than the first.
  bool read(cv::Mat& colour, double& timestamp_s) {
    cv::Mat image;
    if (!first_.empty()) {
      image = first_;
      first_.release();
    } else if (!grab(image)) {
      return false;
    }
    if (image.size() != size_)
      throw Error(name_ + ": frame " + std::to_string(count_) + ": found " + text(image.size()) + " pixels, expected " +
                  text(size_) + " as in the first");
    colour = image;
    timestamp_s = next_time_s();
    ++count_;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;

  template <class Open>
  void open(Open&& open_capture, const char* expected) {
    if (given_rate_hz_) detail::require_frame_rate(*given_rate_hz_);
    bool is_open = false;
    try {
      is_open = open_capture() && grab(first_);
    } catch (const cv::Exception&) {  // some of OpenCV's readers throw, others say no
    }
    if (!is_open) throw Error(name_ + ": cannot be read, expected " + expected);
    size_ = first_.size();
  }

  /// The next image with memory of its own: OpenCV writes into the last one again.
  bool grab(cv::Mat& image) {
    cv::Mat frame;
    if (!capture_.read(frame) || frame.empty() || frame.depth() != CV_8U) return false;
    if (frame.channels() == 3)
      image = frame.clone();
    else
      cv::cvtColor(frame, image, frame.channels() == 4 ? cv::COLOR_BGRA2BGR : cv::COLOR_GRAY2BGR);
    grabbed_at_ = Clock::now();
    position_s_ = 1e-3 * capture_.get(cv::CAP_PROP_POS_MSEC);
    return true;
  }

  double stated_rate_hz() const {
    constexpr double kUsualRate_hz = 30.0, kHighest_hz = 1000.0;  // files without a rate state 0, NaN or 90000
    const double rate_hz = capture_.get(cv::CAP_PROP_FPS);
    return rate_hz > 0 && rate_hz <= kHighest_hz ? rate_hz : kUsualRate_hz;
  }

  /// Times must rise: a file that does not say when a frame was is taken to keep its rate.
  double next_time_s() {
    if (count_ == 0) {
      start_ = grabbed_at_;
      start_position_s_ = position_s_;
      return time_s_ = 0.0;
    }
    const double by_clock_s = std::chrono::duration<double>(grabbed_at_ - start_).count();
    const double stated_s = is_live_ ? by_clock_s : position_s_ - start_position_s_;
    if (given_rate_hz_) return time_s_ = static_cast<double>(count_) / *given_rate_hz_;
    return time_s_ = stated_s > time_s_ ? stated_s : time_s_ + 1.0 / rate_hz_;
  }

  static std::string text(const cv::Size& size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height);
  }

  std::string name_;
  std::optional<double> given_rate_hz_;
  bool is_live_ = false;
  cv::VideoCapture capture_;
  cv::Mat first_;  ///< read to see whether there is any
  cv::Size size_;
  std::size_t count_ = 0;
  Clock::time_point start_, grabbed_at_;
  double rate_hz_ = 30.0, position_s_ = 0.0, start_position_s_ = 0.0, time_s_ = 0.0;
};

}  // namespace stillpoint
