// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A video that is whole or not there.

#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/image_folder.hpp"
#include "stillpoint/io/target_file.hpp"
#include "stillpoint/io/whole_video.hpp"

namespace stillpoint_run {

/// How many frames can be read of a video; 0 where it cannot be opened. A last frame that breaks off may be counted.
inline std::size_t count_frames(const std::filesystem::path& file) {
  std::error_code missing;
  if (std::filesystem::file_size(file, missing) == 0 || missing)
    return 0;  // OpenCV would ask its cameras' readers, too
  std::size_t frames = 0;
  try {
    cv::VideoCapture video(file.string());
    while (video.isOpened() && video.grab()) ++frames;
  } catch (const cv::Exception&) {  // some of OpenCV's readers throw, others say no
  }
  return frames;
}

/// Whether the file states its size and has as many bytes. An encoder writes the size last, so it is missing after a
/// failed write.
inline bool states_its_size(const std::filesystem::path& file) {
  const stillpoint::detail::VideoSize size = stillpoint::detail::size_of_video(file);
  return size.stated > 0 && size.stated <= size.found;
}

/// Writes MPEG-4 into .mp4 and Motion JPEG into .avi: to a temporary file beside the target ("out.partial0.mp4"), which
/// gets the target's name on `commit()`. Without it the destructor removes what was written. Of a symbolic link, the
/// file that it names is written.
class VideoFile {
 public:
  /// @throws stillpoint::Error if no file can be made in the target's folder, or the target is no regular file
  explicit VideoFile(std::filesystem::path target) : target_(std::move(target)), extension_(target_.extension()) {
    check_target();
    make_temporary();
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
    ++frames_;
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

  /// Writes what is left. cv::VideoWriter reports no failed write: the file is read back.
  /// @throws stillpoint::Error where it has fewer frames than were written
  void finish() {
    if (!writer_.isOpened() && !first_.empty()) {
      open(stillpoint::kAssumedFrameRate_hz);
      writer_.write(first_);
    }
    writer_.release();
    const std::size_t readable = count_frames(temporary_);
    is_finished_ = states_its_size(temporary_);
    if (readable < frames_ || !is_finished_)
      throw stillpoint::Error(target_.string() + ": cannot write the video: found " + std::to_string(readable) +
                              " frames in the file" + (is_finished_ ? "" : ", which breaks off") + "; expected the " +
                              std::to_string(frames_) + " that were written (is the disk full?)");
  }

  /// Gives the video its name.
  /// @throws stillpoint::Error where it cannot be finished or renamed
  void commit() {
    if (!is_finished_) finish();
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw stillpoint::Error(target_.string() + ": cannot write the video: " + error.message());
    is_committed_ = true;
  }

 private:
  void check_target() {
    std::error_code ignored;
    if (std::filesystem::exists(target_, ignored) && !std::filesystem::is_regular_file(target_, ignored))
      throw stillpoint::Error("--save-video: found " + target_.string() + ", which is " +
                              (std::filesystem::is_directory(target_, ignored) ? "a folder" : "a device or a pipe") +
                              ", expected a file to write");
    target_ = stillpoint::detail::follow_links(target_);
  }

  void make_temporary() {
    std::error_code ignored;
    const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, ignored))
      throw stillpoint::Error("--save-video: found " + target_.string() + ", expected a folder that is there");
    stillpoint::detail::NewFile made = stillpoint::detail::make_new_file([this](std::size_t number) {
      std::filesystem::path name = target_;
      return name.replace_extension(".partial" + std::to_string(number) + extension_.string());
    });
    temporary_ = std::move(made.path);
    if (made.file == nullptr)
      throw stillpoint::Error("--save-video: cannot make " + temporary_.string() + ": " +
                              std::generic_category().message(made.error));
    std::fclose(made.file);
  }

  static double rate_of(double step_s) {
    constexpr double kLeast_hz = 1.0, kMost_hz = 120.0;
    return step_s > 0 ? std::clamp(1.0 / step_s, kLeast_hz, kMost_hz) : stillpoint::kAssumedFrameRate_hz;
  }

  void open(double rate_hz) {
    const bool is_mp4 = extension_ == ".mp4";
    const int codec =
        is_mp4 ? cv::VideoWriter::fourcc('m', 'p', '4', 'v') : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (writer_.open(temporary_.string(), codec, rate_hz, first_.size())) return;
    throw stillpoint::Error(
        "--save-video: cannot write " + target_.string() + ": OpenCV has no encoder for " +
        (is_mp4 ? "MPEG-4 here (it takes FFmpeg for that); expected a name that ends in .avi" : "Motion JPEG here"));
  }

  std::filesystem::path target_, extension_, temporary_;
  cv::VideoWriter writer_;
  cv::Mat first_;
  double first_s_ = 0.0;
  std::size_t frames_ = 0;
  bool is_finished_ = false, is_committed_ = false;
};

}  // namespace stillpoint_run
