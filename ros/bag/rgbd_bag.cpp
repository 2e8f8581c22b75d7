// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "bag/rgbd_bag.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint_ros1/messages.hpp"

namespace stillpoint_ros {

namespace {

/// A topic and, of an image, its encoding.
struct Topic {
  std::string name, encoding;
};
using Topics = std::vector<Topic>;

std::string listed(const Topics& topics) {
  std::string list;
  for (const Topic& topic : topics)
    list += (list.empty() ? "" : ", ") + topic.name + (topic.encoding.empty() ? "" : " (" + topic.encoding + ")");
  return list.empty() ? "none" : list;
}

template <class Message>
std::set<std::string> topics_of(const rosbag::Bag& bag) {
  std::set<std::string> names;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    if (connection->datatype == ros::message_traits::DataType<Message>::value()) names.insert(connection->topic);
  return names;
}

std::string encoding_of(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0) return "";
  const sensor_msgs::Image::ConstPtr image = view.begin()->instantiate<sensor_msgs::Image>();
  return image ? image->encoding : "";
}

/// The one that is wanted, or the only one.
std::string chosen(const std::string& option, const std::string& what, const std::string& wanted,
                   const Topics& topics) {
  for (const Topic& topic : topics)
    if (topic.name == wanted) return wanted;
  if (!wanted.empty()) throw stillpoint::Error(option + ": found " + wanted + ", expected one of " + listed(topics));
  if (topics.empty()) throw stillpoint::Error("found no topic with " + what);
  if (topics.size() > 1)
    throw stillpoint::Error("found " + what + " on " + listed(topics) + ", expected " + option + " with one of them");
  return topics.front().name;
}

BagTopics chosen(const rosbag::Bag& bag, const BagTopics& wanted, bool needs_camera_info) {
  Topics images, depths, cameras;
  for (const std::string& name : topics_of<sensor_msgs::Image>(bag)) {
    const std::string encoding = encoding_of(bag, name);
    (is_depth_encoding(encoding) ? depths : images).push_back({name, encoding});
  }
  for (const std::string& name : topics_of<sensor_msgs::CameraInfo>(bag)) cameras.push_back({name, ""});
  BagTopics topics;
  topics.image = chosen("--image-topic", "images (sensor_msgs/Image)", wanted.image, images);
  topics.depth = chosen("--depth-topic", "depth (sensor_msgs/Image of 16UC1 or 32FC1)", wanted.depth, depths);
  if (!needs_camera_info) return topics;
  topics.camera_info = wanted.camera_info;
  const std::string beside = topics.image.substr(0, topics.image.rfind('/') + 1) + "camera_info";
  for (const Topic& camera : cameras)
    if (topics.camera_info.empty() && camera.name == beside) topics.camera_info = beside;
  topics.camera_info = chosen("--camera-info-topic", "cameras (sensor_msgs/CameraInfo)", topics.camera_info, cameras);
  return topics;
}

}  // namespace

struct RgbdBag::Reader {
  Reader(const std::filesystem::path& file, const BagTopics& wanted, bool needs_camera_info)
      : name(file.string()), has_camera_info(needs_camera_info) {
    guarded([&] {
      bag.open(name, rosbag::bagmode::Read);
      topics = chosen(bag, wanted, needs_camera_info);
      std::vector<std::string> names = {topics.image, topics.depth};
      if (needs_camera_info) names.push_back(topics.camera_info);
      view.addQuery(bag, rosbag::TopicQuery(names));
      message = view.begin();
    });
  }

  /// Errors of rosbag are those of the file.
  template <class Read>
  void guarded(Read&& read) const {
    try {
      read();
    } catch (const rosbag::BagUnindexedException&) {
      throw stillpoint::Error(name + ": found a bag without index, expected one that was closed (rosbag reindex)");
    } catch (const ros::Exception& error) {
      throw stillpoint::Error(name + ": " + error.what());
    } catch (const stillpoint::Error& error) {
      throw stillpoint::Error(name + ": " + error.what());
    }
  }

  void take(const rosbag::MessageInstance& instance) {
    if (instance.getTopic() == topics.camera_info) {
      const auto info = instance.instantiate<sensor_msgs::CameraInfo>();
      if (info) pairing.add_camera_info(stillpoint_ros1::raw(*info));
      return;
    }
    const auto image = instance.instantiate<sensor_msgs::Image>();
    if (!image) return;
    RawImage raw = stillpoint_ros1::raw(image);
    if (instance.getTopic() == topics.depth) return pairing.add_depth(std::move(raw));
    if (!has_camera_info) {
      CameraInfo size;
      size.width = raw.width;
      size.height = raw.height;
      pairing.add_camera_info(size);
    }
    pairing.add_image(std::move(raw));
  }

  std::string name;
  bool has_camera_info;
  BagTopics topics;
  rosbag::Bag bag;
  rosbag::View view;
  rosbag::View::iterator message;
  FramePairing pairing;
  bool is_at_end = false;  ///< what waits now waits in vain
};

RgbdBag::RgbdBag(const std::filesystem::path& file, const BagTopics& wanted, bool needs_camera_info)
    : reader_(std::make_unique<Reader>(file, wanted, needs_camera_info)) {}
RgbdBag::~RgbdBag() = default;

std::optional<PairedFrame> RgbdBag::next() {
  std::optional<PairedFrame> frame;
  reader_->guarded([&] {
    while (!(frame = reader_->pairing.take()) && reader_->message != reader_->view.end()) {
      reader_->take(*reader_->message);
      ++reader_->message;
    }
    reader_->is_at_end = !frame;
  });
  return frame;
}

const BagTopics& RgbdBag::topics() const noexcept { return reader_->topics; }
std::size_t RgbdBag::unpaired_images() const noexcept {
  const FramePairing& pairing = reader_->pairing;
  return pairing.unpaired_images() + (reader_->is_at_end ? pairing.waiting_images() : 0);
}

std::string RgbdBag::why_nothing_pairs() {
  FramePairing& pairing = reader_->pairing;
  if (const RawImage* const image = pairing.image_without_camera())
    return "no camera_info on " + reader_->topics.camera_info + " is of " + std::to_string(image->width) + "x" +
           std::to_string(image->height) + " pixels, the size of the images";
  const double apart_s = pairing.nearest_difference_s();
  if (!std::isfinite(apart_s)) return "images and depth are not of the same time";
  return "the last image and the depth nearest to it are " + stillpoint::format_fixed(apart_s, 3) +
         " s apart, expected " + stillpoint::format_fixed(pairing.options.tolerance_s, 3) + " s at most";
}

}  // namespace stillpoint_ros
