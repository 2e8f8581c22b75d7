// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// ros1_client FOLDER FRAMES [HZ]: sends frames of a TUM folder to the ROS 1 node. Without HZ one by one, the next when
// the answers have come, each of which must be what the library says of the same frame, byte for byte. With HZ at that
// rate, and prints how long the answers took and which frames have none. It ends in any case: the node leaves frames
// out.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/verdict/masked_depth.hpp"
#include "stillpoint_ros/mover_messages.hpp"

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

using Clock = std::chrono::steady_clock;  // nobody sets it

/// Everything that the node publishes of frames, by topic and stamp. Received in a thread of its own: the time of an
/// answer is when it came, whatever the sender does.
class Answers {
 public:
  Answers(ros::NodeHandle& node, bool has_movers) : has_movers_(has_movers) {
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    for (const char* topic : {"mask", "mask_inverse", "depth"})
      subscribers_.push_back(node.subscribe<sensor_msgs::Image>(
          std::string("/stillpoint/") + topic, 100,
          [this, topic](const sensor_msgs::Image::ConstPtr& image) {
            const std::lock_guard<std::mutex> lock(mutex_);
            came_[topic][image->header.stamp] = Clock::now();
            images_[topic][image->header.stamp] = image;
          },
          {}, hints));
    if (has_movers)
      subscribers_.push_back(node.subscribe<visualization_msgs::MarkerArray>(
          "/stillpoint/movers", 100,
          [this](const visualization_msgs::MarkerArray::ConstPtr& markers) {
            const std::lock_guard<std::mutex> lock(mutex_);
            movers_[markers->markers.front().header.stamp] = markers;
          },
          {}, hints));
    subscribers_.push_back(node.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          const std::lock_guard<std::mutex> lock(mutex_);
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
    const std::lock_guard<std::mutex> lock(mutex_);
    return images_["mask"].count(stamp) + images_["mask_inverse"].count(stamp) + images_["depth"].count(stamp) == 3 &&
           (!has_movers_ || movers_.count(stamp) == 1);
  }
  sensor_msgs::Image::ConstPtr of(const std::string& topic, const ros::Time& stamp) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return images_[topic][stamp];
  }
  visualization_msgs::MarkerArray::ConstPtr movers_of(const ros::Time& stamp) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return movers_[stamp];
  }
  std::map<ros::Time, Clock::time_point> times_of(const std::string& topic) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return came_[topic];
  }
  bool has_good_diagnostics() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::count(levels_.begin(), levels_.end(), diagnostic_msgs::DiagnosticStatus::OK) > 0;
  }

 private:
  bool has_movers_;
  std::mutex mutex_;  // of what follows
  std::map<std::string, std::map<ros::Time, sensor_msgs::Image::ConstPtr>> images_;
  std::map<std::string, std::map<ros::Time, Clock::time_point>> came_;
  std::map<ros::Time, visualization_msgs::MarkerArray::ConstPtr> movers_;
  std::vector<int> levels_;
  std::vector<ros::Subscriber> subscribers_;  // the last: their callbacks use the others
};

template <class Condition>
bool wait_for(double seconds, Condition&& condition) {
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  do {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (ros::ok() && Clock::now() < end);
  return condition();
}

/// What the library says of the same frames, by its own calls.
class Expected {
 public:
  explicit Expected(const stillpoint::Camera& camera) : filter_(camera) {}

  cv::Mat mask, depth;
  stillpoint::span<const stillpoint::Mover> movers;
  std::size_t dropped = 0, judged = 0, seen_movers = 0;

  void filter(const stillpoint::RgbdImages& images, double depth_factor, double timestamp_s) {
    cv::Mat gray;
    cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
    orb_->detect(gray, keypoints_);
    const stillpoint::DepthView depth_view(images.depth, depth_factor);
    const stillpoint::FrameResult& result = filter_.filter_frame({gray, depth_view, timestamp_s}, keypoints_);
    movers = result.movers();
    seen_movers += movers.size();
    judged += stillpoint::judged(result.status()) ? 1 : 0;
    filter_.predicted_keep_mask(timestamp_s + 1e-4, 8, mask_);
    stillpoint::masked_depth(depth_view, mask_.view(), depth_);
    mask = as_mat(mask_.view());
    depth = as_mat(depth_.view());
    dropped += mask.total() - static_cast<std::size_t>(cv::countNonZero(mask));
  }

 private:
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter_;
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

template <class Message>
std::string bytes_of(const Message& message) {
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(message);
  return {reinterpret_cast<const char*>(bytes.buf.get()), bytes.num_bytes};
}

bool is_equal(const visualization_msgs::MarkerArray& found, stillpoint::span<const stillpoint::Mover> movers,
              std_msgs::Header header) {
  header.seq = found.markers.front().header.seq;  // ROS counts the images that it sends
  return bytes_of(found) == bytes_of(stillpoint_ros::markers<visualization_msgs::MarkerArray>(movers, header));
}

/// What was sent, and when.
class Sender {
 public:
  explicit Sender(ros::NodeHandle& node)
      : image_out_(node.advertise<sensor_msgs::Image>("image", 10)),
        depth_out_(node.advertise<sensor_msgs::Image>("depth", 10)),
        camera_out_(node.advertise<sensor_msgs::CameraInfo>("camera_info", 10)) {}

  bool is_connected() const {
    return image_out_.getNumSubscribers() > 0 && depth_out_.getNumSubscribers() > 0 &&
           camera_out_.getNumSubscribers() > 0;
  }
  void send(const sensor_msgs::Image& image, const sensor_msgs::Image& depth, const stillpoint::Camera& camera) {
    sent_.emplace_back(image.header.stamp, Clock::now());
    image_out_.publish(image);
    depth_out_.publish(depth);
    camera_out_.publish(message(camera, image.header.stamp));
  }
  const std::vector<std::pair<ros::Time, Clock::time_point>>& sent() const { return sent_; }

 private:
  ros::Publisher image_out_, depth_out_, camera_out_;
  std::vector<std::pair<ros::Time, Clock::time_point>> sent_;
};

/// Says how long the answers took, and which frames have none.
int report_latency(const Sender& sender, Answers& answers, double rate_hz) {
  // The last frames may still be worked on; what was left out never comes.
  std::size_t count = 0;
  do count = answers.times_of("mask").size();
  while (count < sender.sent().size() && wait_for(3, [&] { return answers.times_of("mask").size() > count; }));

  const std::map<ros::Time, Clock::time_point> came = answers.times_of("mask");
  std::vector<double> latency_ms;
  std::string lost;
  for (std::size_t i = 0; i < sender.sent().size(); ++i) {
    const auto& [stamp, sent_at] = sender.sent()[i];
    const auto answer = came.find(stamp);
    if (answer == came.end())
      lost += ' ' + std::to_string(i);
    else
      latency_ms.push_back(std::chrono::duration<double, std::milli>(answer->second - sent_at).count());
  }
  std::sort(latency_ms.begin(), latency_ms.end());
  const std::size_t n = latency_ms.size();
  std::printf("%zu of %zu frames answered at %g Hz; frames without an answer:%s\n", n, sender.sent().size(), rate_hz,
              lost.empty() ? " none" : lost.c_str());
  if (n == 0) return EXIT_FAILURE;
  std::printf("latency median %.1f ms, p95 %.1f ms, longest %.1f ms\n", latency_ms[n / 2], latency_ms[n * 95 / 100],
              latency_ms.back());
  return EXIT_SUCCESS;
}

int run(const std::string& folder, std::size_t frames, double rate_hz) {
  const stillpoint::TumSequence sequence(folder);
  ros::NodeHandle node;
  Answers answers(node, rate_hz == 0);
  Sender sender(node);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  if (!wait_for(20, [&] { return answers.is_connected() && sender.is_connected(); }))
    return std::fprintf(stderr, "the node does not answer\n"), EXIT_FAILURE;

  Expected expected(sequence.camera());
  std::size_t different = 0;
  frames = std::min(frames, sequence.frames().size());
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < frames && ros::ok(); ++i) {
    const stillpoint::RgbdImages images = sequence.load(i);
    ros::Time stamp;
    stamp.fromSec(1.7e9 + sequence.frames()[i].timestamp_s);
    const sensor_msgs::Image image = message(images.colour, "bgr8", stamp),
                             depth = message(images.depth, "16UC1", stamp);
    if (rate_hz > 0)
      std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(
                                                std::chrono::duration<double>(static_cast<double>(i) / rate_hz)));
    sender.send(image, depth, sequence.camera());
    if (rate_hz > 0) continue;

    if (!wait_for(20, [&] { return answers.has_all(stamp); }))
      return std::fprintf(stderr, "frame %zu: no answer\n", i), EXIT_FAILURE;
    expected.filter(images, sequence.depth_factor(), stamp.toSec());
    const bool is_same = is_equal(*answers.of("mask", stamp), expected.mask, image, "mono8") &&
                         is_equal(*answers.of("mask_inverse", stamp), 255 - expected.mask, image, "mono8") &&
                         is_equal(*answers.of("depth", stamp), expected.depth, depth, "16UC1") &&
                         is_equal(*answers.movers_of(stamp), expected.movers, image.header);
    if (!is_same) {
      std::fprintf(stderr, "frame %zu: the node's answer differs from the library's\n", i);
      ++different;
    }
  }
  if (rate_hz > 0) return report_latency(sender, answers, rate_hz);
  if (!wait_for(5, [&] { return answers.has_good_diagnostics(); }))
    return std::fprintf(stderr, "no diagnostics of level OK\n"), EXIT_FAILURE;
  std::printf("%zu frames, %zu judged, %zu pixels dropped, %zu movers, %zu answers differ\n", frames, expected.judged,
              expected.dropped, expected.seen_movers, different);
  return different == 0 && expected.judged + 1 == frames && expected.dropped > 0 && expected.seen_movers > 0
             ? EXIT_SUCCESS
             : EXIT_FAILURE;
}

}  // namespace

int main(int argument_count, char** arguments) {
  ros::init(argument_count, arguments, "client");
  if (argument_count < 3) return std::fprintf(stderr, "ros1_client FOLDER FRAMES [HZ]\n"), EXIT_FAILURE;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // what was found is seen, whatever becomes of the end
  try {
    return run(arguments[1], std::strtoul(arguments[2], nullptr, 10),
               argument_count > 3 ? std::strtod(arguments[3], nullptr) : 0.0);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "ros1_client: %s\n", error.what()), EXIT_FAILURE;
  }
}
