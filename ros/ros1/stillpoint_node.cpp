// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The ROS 1 node: image, depth and camera_info in; masks, depth with holes, movers and diagnostics out. docs/ros.md
// says how to run it; all that is not ROS is in stillpoint_ros/.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "stillpoint_ros/mover_messages.hpp"
#include "stillpoint_ros/node_core.hpp"
#include "stillpoint_ros1/messages.hpp"

namespace stillpoint_ros1 {

/// Private parameters of the node, with '/' between groups. One of another type than its option's is an Error.
class RosParameters {
 public:
  explicit RosParameters(const ros::NodeHandle& node) : node_(node) {}

  template <class Value>
  Value get(const std::string& name, const Value& value) const {
    Value found = value;
    return given(name, found) ? found : value;
  }
  /// ROS 1 has integers of 32 bit.
  std::int64_t get(const std::string& name, std::int64_t value) const {
    int found = 0;
    return given(name, found) ? found : value;
  }

  /// The whole name of an option on the parameter server.
  std::string server_name(const std::string& name) const { return node_.getNamespace() + '/' + ros_name(name); }

  /// The names that were given, as the options are called.
  std::vector<std::string> given() const {
    std::vector<std::string> all, names;
    node_.getParamNames(all);
    const std::string prefix = node_.getNamespace() + '/';
    for (const std::string& name : all)
      if (name.compare(0, prefix.size(), prefix) == 0) names.push_back(exchanged(name.substr(prefix.size()), '/', '.'));
    return names;
  }

 private:
  template <class Value>
  bool given(const std::string& name, Value& found) const {
    XmlRpc::XmlRpcValue other;
    if (!node_.getParam(ros_name(name), other)) return false;
    // Of a number with a fraction, getParam would make a whole one.
    const bool is_fraction = std::is_same_v<Value, int> && other.getType() == XmlRpc::XmlRpcValue::TypeDouble;
    if (!is_fraction && node_.getParam(ros_name(name), found)) return true;
    std::ostringstream text;
    text << other;
    throw stillpoint::Error("parameter " + name + " is '" + text.str() + "', expected " + type_name(found));
  }
  static const char* type_name(bool) { return "true or false"; }
  static const char* type_name(int) { return "a whole number"; }
  static const char* type_name(double) { return "a number"; }
  static const char* type_name(const std::string&) { return "a word"; }

  static std::string exchanged(std::string text, char from, char to) {
    for (char& c : text)
      if (c == from) c = to;
    return text;
  }
  static std::string ros_name(const std::string& name) { return exchanged(name, '.', '/'); }

  ros::NodeHandle node_;
};

class StillpointNode {
 public:
  StillpointNode()
      : core_({node_.resolveName("image"), node_.resolveName("depth"), node_.resolveName("camera_info")},
              [this](const auto& frame, const auto& answer) { publish(frame, answer); }) {
    constexpr std::uint32_t kQueue = 5;
    mask_ = private_node_.advertise<sensor_msgs::Image>("mask", kQueue);
    mask_inverse_ = private_node_.advertise<sensor_msgs::Image>("mask_inverse", kQueue);
    depth_ = private_node_.advertise<sensor_msgs::Image>("depth", kQueue);
    movers_ = private_node_.advertise<visualization_msgs::MarkerArray>("movers", kQueue);
    diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", kQueue);

    RosParameters parameters(private_node_);
    const std::vector<std::string> known = core_.start(parameters);
    const std::string unknown = stillpoint_ros::unknown_parameter(parameters.given(), known);
    if (!unknown.empty())
      throw stillpoint::Error("parameter " + unknown + " is unknown; docs/ros.md lists the parameters. " +
                              "It stays on the parameter server: rosparam delete " + parameters.server_name(unknown));

    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    image_in_ = node_.subscribe<sensor_msgs::Image>(
        "image", kQueue, [this](const auto& image) { core_.add_image(raw(image)); }, {}, hints);
    depth_in_ = node_.subscribe<sensor_msgs::Image>(
        "depth", kQueue, [this](const auto& depth) { core_.add_depth(raw(depth)); }, {}, hints);
    camera_info_in_ = node_.subscribe<sensor_msgs::CameraInfo>(
        "camera_info", kQueue, [this](const auto& info) { core_.add_camera_info(raw(*info)); }, {}, hints);
    timer_ = node_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { report(); });
  }

 private:
  using Publisher = ros::Publisher;

  /// Unless somebody listens, nothing is copied.
  static void publish_if_wanted(const Publisher& publisher, const stillpoint::ImageView& image,
                                const sensor_msgs::Image& original, const std::string& encoding) {
    if (publisher.getNumSubscribers() > 0) publisher.publish(message(image, original.header, encoding));
  }

  void publish(const stillpoint_ros::PairedFrame& frame, const stillpoint_ros::FrameAnswer& answer) const {
    const auto image = std::static_pointer_cast<const sensor_msgs::Image>(frame.image.message);
    const auto depth = std::static_pointer_cast<const sensor_msgs::Image>(frame.depth.message);
    publish_if_wanted(depth_, answer.depth, *depth, depth->encoding);
    publish_if_wanted(mask_inverse_, answer.mask_inverse, *image, "mono8");
    if (movers_.getNumSubscribers() > 0)
      movers_.publish(stillpoint_ros::markers<visualization_msgs::MarkerArray>(answer.movers, image->header));
    publish_if_wanted(mask_, answer.mask, *image, "mono8");
  }

  void report() {
    const stillpoint_ros::Report report = core_.report();
    for (const std::string& sentence : report.missing) ROS_WARN("%s", sentence.c_str());
    if (!report.hint.empty()) ROS_WARN("%s", report.hint.c_str());
    diagnostics_.publish(stillpoint_ros::diagnostics<diagnostic_msgs::DiagnosticArray>(
        report, ros::this_node::getName(), ros::Time::now()));
  }

  ros::NodeHandle node_, private_node_{"~"};
  Publisher mask_, mask_inverse_, depth_, movers_, diagnostics_;
  stillpoint_ros::NodeCore core_;
  ros::Subscriber image_in_, depth_in_, camera_info_in_;
  ros::WallTimer timer_;
};

}  // namespace stillpoint_ros1

int main(int argument_count, char** arguments) {
  constexpr int kFailed = 2;
  ros::init(argument_count, arguments, "stillpoint");
  const ros::NodeHandle keeps_ros_running;  // with the last one its log ends, too
  try {
    const stillpoint_ros1::StillpointNode node;
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return kFailed;
  }
}
