// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// ros1_client FOLDER FRAMES [HZ]: sends frames of a TUM folder to the ROS 1 node. Without HZ one by one, the next when
// the answers have come, each of which must be what the library says of the same frame, byte for byte. With HZ at that
// rate, and prints how long the answers took.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/verdict/masked_depth.hpp"

namespace {

using stillpoint::as_mat;

sensor_msgs::Image message(const cv::Mat& image, const std::string& encoding, const ros::Time& stamp) {
  sensor_msgs::Image message;
  message.header.stamp = stamp;
  message.header.frame_id = "camera_" + encoding;
  message.width = static_cast<std::uint32_t>(image.cols);
  message.height = static_cast<std::uint32_t>(image.rows);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.cols * static_cast<int>(image.elemSize()));
  message.data.assign(image.data, image.data + image.total() * image.elemSize());
  return message;
}

sensor_msgs::CameraInfo message(const stillpoint::Camera& camera, const ros::Time& stamp) {
  sensor_msgs::CameraInfo info;
  info.header.stamp = stamp;
  info.width = static_cast<std::uint32_t>(camera.width());
  info.height = static_cast<std::uint32_t>(camera.height());
  info.K = {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  return info;
}

/// Everything that the node publishes of frames, by topic and stamp.
class Answers {
 public:
  explicit Answers(ros::NodeHandle& node) {
    for (const char* topic : {"mask", "mask_inverse", "depth"})
      subscribers_.push_back(node.subscribe<sensor_msgs::Image>(
          std::string("/stillpoint/") + topic, 100,
          [this, topic](const sensor_msgs::Image::ConstPtr& image) {
            came_[topic][image->header.stamp] = ros::WallTime::now();
            images_[topic][image->header.stamp] = image;
          },
          {}, ros::TransportHints().tcpNoDelay()));
    subscribers_.push_back(node.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          for (const auto& status : array->status)
            if (status.name == "/stillpoint: filter") levels_.push_back(status.level);
        }));
  }

  bool is_connected() const {
    for (const ros::Subscriber& subscriber : subscribers_)
      if (subscriber.getNumPublishers() == 0) return false;
    return true;
  }
  bool has_all(const ros::Time& stamp) {
    return images_["mask"].count(stamp) + images_["mask_inverse"].count(stamp) + images_["depth"].count(stamp) == 3;
  }
  const sensor_msgs::Image& of(const std::string& topic, const ros::Time& stamp) { return *images_[topic][stamp]; }
  const std::map<ros::Time, ros::WallTime>& times_of(const std::string& topic) { return came_[topic]; }
  bool has_good_diagnostics() const {
    return std::count(levels_.begin(), levels_.end(), diagnostic_msgs::DiagnosticStatus::OK) > 0;
  }

 private:
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::string, std::map<ros::Time, sensor_msgs::Image::ConstPtr>> images_;
  std::map<std::string, std::map<ros::Time, ros::WallTime>> came_;
  std::vector<int> levels_;
};

template <class Condition>
bool wait_for(double seconds, Condition&& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.002));
    if (condition()) return true;
  }
  return false;
}

/// What the library says of the same frames, by its own calls.
class Expected {
 public:
  explicit Expected(const stillpoint::Camera& camera) : filter_(camera) {}

  cv::Mat mask, depth;
  std::size_t dropped = 0, judged = 0;

  void filter(const stillpoint::RgbdImages& images, double depth_factor, double timestamp_s) {
    cv::Mat gray;
    cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
    orb_->detect(gray, keypoints_);
    const stillpoint::DepthView depth_view(images.depth, depth_factor);
    const stillpoint::FrameResult& result = filter_.filter_frame({gray, depth_view, timestamp_s}, keypoints_);
    judged += stillpoint::judged(result.status()) ? 1 : 0;
    filter_.predicted_keep_mask(timestamp_s + 1e-4, 8, mask_);
    stillpoint::masked_depth(depth_view, mask_.view(), depth_);
    mask = as_mat(mask_.view());
    depth = as_mat(depth_.view());
    dropped += mask.total() - static_cast<std::size_t>(cv::countNonZero(mask));
  }

 private:
  stillpoint::FrameFilter<> filter_;
  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(1000);
  std::vector<cv::KeyPoint> keypoints_;
  stillpoint::ImageBuffer mask_, depth_;
};

bool is_equal(const sensor_msgs::Image& found, const cv::Mat& expected, const sensor_msgs::Image& sent,
              const std::string& encoding) {
  return found.encoding == encoding && found.header.frame_id == sent.header.frame_id &&
         found.height == static_cast<std::uint32_t>(expected.rows) &&
         found.width == static_cast<std::uint32_t>(expected.cols) &&
         found.step == found.width * static_cast<std::uint32_t>(expected.elemSize()) &&
         found.data.size() == expected.total() * expected.elemSize() &&
         std::memcmp(found.data.data(), expected.data, found.data.size()) == 0;
}

int run(const std::string& folder, std::size_t frames, double rate_hz) {
  const stillpoint::TumSequence sequence(folder);
  ros::NodeHandle node;
  Answers answers(node);
  ros::Publisher image_out = node.advertise<sensor_msgs::Image>("image", 10);
  ros::Publisher depth_out = node.advertise<sensor_msgs::Image>("depth", 10);
  ros::Publisher camera_out = node.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  const bool is_connected = wait_for(20, [&] {
    return answers.is_connected() && image_out.getNumSubscribers() > 0 && depth_out.getNumSubscribers() > 0 &&
           camera_out.getNumSubscribers() > 0;
  });
  if (!is_connected) return std::fprintf(stderr, "the node does not answer\n"), EXIT_FAILURE;

  Expected expected(sequence.camera());
  std::map<ros::Time, ros::WallTime> sent_at;
  std::size_t different = 0;
  frames = std::min(frames, sequence.frames().size());
  ros::WallTime due = ros::WallTime::now();
  for (std::size_t i = 0; i < frames; ++i) {
    const stillpoint::RgbdImages images = sequence.load(i);
    ros::Time stamp;
    stamp.fromSec(1.7e9 + sequence.frames()[i].timestamp_s);
    const sensor_msgs::Image image = message(images.colour, "bgr8", stamp),
                             depth = message(images.depth, "16UC1", stamp);
    if (rate_hz > 0) {
      wait_for((due - ros::WallTime::now()).toSec(), [] { return false; });
      due += ros::WallDuration(1 / rate_hz);
    }
    sent_at[stamp] = ros::WallTime::now();
    image_out.publish(image);
    depth_out.publish(depth);
    camera_out.publish(message(sequence.camera(), stamp));
    if (rate_hz > 0) continue;

    if (!wait_for(20, [&] { return answers.has_all(stamp); }))
      return std::fprintf(stderr, "frame %zu: no answer\n", i), EXIT_FAILURE;
    expected.filter(images, sequence.depth_factor(), stamp.toSec());
    const bool is_same = is_equal(answers.of("mask", stamp), expected.mask, image, "mono8") &&
                         is_equal(answers.of("mask_inverse", stamp), 255 - expected.mask, image, "mono8") &&
                         is_equal(answers.of("depth", stamp), expected.depth, depth, "16UC1");
    if (!is_same) {
      std::fprintf(stderr, "frame %zu: the node's answer differs from the library's\n", i);
      ++different;
    }
  }
  if (rate_hz > 0) {
    wait_for(1, [] { return false; });
    std::vector<double> latency_ms;
    for (const auto& [stamp, time] : answers.times_of("mask"))
      latency_ms.push_back(1e3 * (time - sent_at[stamp]).toSec());
    std::sort(latency_ms.begin(), latency_ms.end());
    if (latency_ms.empty()) return EXIT_FAILURE;
    const std::size_t n = latency_ms.size();
    std::printf("%zu of %zu frames answered at %g Hz; latency median %.1f ms, p95 %.1f ms, longest %.1f ms\n", n,
                frames, rate_hz, latency_ms[n / 2], latency_ms[n * 95 / 100], latency_ms.back());
    return EXIT_SUCCESS;
  }
  if (!wait_for(5, [&] { return answers.has_good_diagnostics(); }))
    return std::fprintf(stderr, "no diagnostics of level OK\n"), EXIT_FAILURE;
  std::printf("%zu frames, %zu judged, %zu pixels dropped, %zu answers differ\n", frames, expected.judged,
              expected.dropped, different);
  return different == 0 && expected.judged + 1 == frames && expected.dropped > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argument_count, char** arguments) {
  ros::init(argument_count, arguments, "client");
  if (argument_count < 3) return std::fprintf(stderr, "ros1_client FOLDER FRAMES [HZ]\n"), EXIT_FAILURE;
  try {
    return run(arguments[1], std::strtoul(arguments[2], nullptr, 10),
               argument_count > 3 ? std::strtod(arguments[3], nullptr) : 0.0);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "ros1_client: %s\n", error.what()), EXIT_FAILURE;
  }
}
