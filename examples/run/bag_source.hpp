// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames with depth from a bag of ROS 1, where the program was built with it.

#include <memory>

#include "frame_source.hpp"
#include "options.hpp"
#include "stillpoint/core/error.hpp"

#ifdef STILLPOINT_RUN_WITH_BAG

#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bag/rgbd_bag.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint_ros/camera_info.hpp"
#include "stillpoint_ros/raw_image.hpp"

namespace stillpoint_run {

/// One image topic and one depth topic of a bag.
class BagSource : public FrameSource {
 public:
  explicit BagSource(const Options& options)
      : file_(options.bag),
        bag_(options.bag, {options.image_topic, options.depth_topic, options.camera_info_topic},
             options.camera.empty()),
        is_rectified_(options.rectified),
        has_camera_info_(options.camera.empty()),
        first_(first_frame()),
        camera_(camera_of(options)) {}

  std::string name() const override { return last_name(file_); }
  std::optional<std::size_t> size() const override { return std::nullopt; }
  const stillpoint::Camera& camera() const override { return camera_.camera; }
  const std::optional<stillpoint::Trajectory>& ground_truth() const override { return kNoGroundTruth; }
  std::size_t images_without_depth() const override { return bag_.unpaired_images(); }
  std::vector<std::string> assumptions() const override {
    const stillpoint_ros::BagTopics& topics = bag_.topics();
    return {"Of the bag, images are those of " + topics.image + ", depth is that of " + topics.depth +
            (topics.camera_info.empty()
                 ? "."
                 : ", the camera that of " + topics.camera_info + (is_rectified_ ? ", rectified." : "."))};
  }

  std::optional<SourceFrame> load(std::size_t index) override {
    std::optional<stillpoint_ros::PairedFrame> paired;
    for (; next_ <= index; ++next_) {
      paired = first_ ? std::exchange(first_, std::nullopt) : bag_.next();
      if (!paired) return std::nullopt;
    }
    return source_frame(*paired);
  }

 private:
  std::optional<stillpoint_ros::PairedFrame> first_frame() {
    std::optional<stillpoint_ros::PairedFrame> frame = bag_.next();
    if (!frame) throw stillpoint::Error(file_.string() + ": found no frame: " + bag_.why_nothing_pairs());
    return frame;
  }

  stillpoint::RgbdCamera camera_of(const Options& options) const {
    constexpr double kMillimetres = 1000.0;  // what 16UC1 is in ROS (REP 118)
    if (options.camera.empty())
      return in_file([&] {
        return stillpoint::RgbdCamera{stillpoint_ros::camera_of(first_->camera, is_rectified_), kMillimetres};
      });
    return stillpoint::read_camera(options.camera);
  }

  SourceFrame source_frame(const stillpoint_ros::PairedFrame& paired) const {
    return in_file([&] {
      SourceFrame frame;
      frame.timestamp_s = paired.image.stamp_s;
      const cv::Mat image = stillpoint_ros::image_of(paired.image);
      require_camera_size(image, frame.timestamp_s);
      require_one_camera(paired);
      if (image.channels() == 3) {
        frame.colour = image.clone();
        cv::cvtColor(image, frame.gray, cv::COLOR_BGR2GRAY);
      } else {
        frame.gray = image.clone();
        cv::cvtColor(image, frame.colour, cv::COLOR_GRAY2BGR);
      }
      frame.depth = stillpoint_ros::depth_of(paired.depth).clone();
      frame.depth_factor = camera_.depth_factor;
      return frame;
    });
  }

  /// A recording may change its resolution, and `--camera` may be another's.
  void require_camera_size(const cv::Mat& image, double timestamp_s) const {
    const stillpoint::Camera& expected = camera_.camera;
    if (image.cols == expected.width() && image.rows == expected.height()) return;
    const auto size = [](int width, int height) { return std::to_string(width) + " x " + std::to_string(height); };
    throw stillpoint::Error("image at " + stillpoint::format_timestamp(timestamp_s) + " s: found " +
                            size(image.cols, image.rows) + " pixels, expected the camera's " +
                            size(expected.width(), expected.height()));
  }

  void require_one_camera(const stillpoint_ros::PairedFrame& paired) const {
    if (!has_camera_info_) return;
    if (stillpoint_ros::show_alike(camera_.camera, stillpoint_ros::camera_of(paired.camera, is_rectified_))) return;
    throw stillpoint::Error("camera_info at " + stillpoint::format_timestamp(paired.camera.stamp_s) +
                            " s: found other intrinsics than the first ones, expected one camera for all frames");
  }

  template <class Read>
  auto in_file(Read&& read) const -> decltype(read()) {
    try {
      return read();
    } catch (const stillpoint::Error& error) {
      throw stillpoint::Error(file_.string() + ": " + error.what());
    }
  }

  std::filesystem::path file_;
  stillpoint_ros::RgbdBag bag_;
  bool is_rectified_;
  bool has_camera_info_;  // else --camera says what the camera is
  std::optional<stillpoint_ros::PairedFrame> first_;
  stillpoint::RgbdCamera camera_;
  std::size_t next_ = 0;
};

inline std::unique_ptr<FrameSource> open_bag(const Options& options) { return std::make_unique<BagSource>(options); }

}  // namespace stillpoint_run

#else

namespace stillpoint_run {

[[noreturn]] inline std::unique_ptr<FrameSource> open_bag(const Options&) {
  throw stillpoint::Error(
      "--bag: found a program that was built without ROS 1; expected librosbag-storage-dev and libsensor-msgs-dev "
      "(Debian) when CMake ran");
}

}  // namespace stillpoint_run

#endif
