// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The ROS 2 component: image, depth, camera_info and detections in; masks, depth with holes, movers and diagnostics
// out. docs/ros.md says how to run it; all that is not ROS is in stillpoint_ros/, shared with the ROS 1 node.

#include <array>
#include <chrono>
#include <cstdint>
#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <image_transport/image_transport.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <string>
#include <utility>
#include <vector>
#include <visualization_msgs/msg/marker_array.hpp>
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
#include <vision_msgs/msg/detection2_d_array.hpp>
#include <vision_msgs/msg/detection3_d_array.hpp>
#endif

#include "messages.hpp"
#include "stillpoint_component.hpp"
#include "stillpoint_ros/detections.hpp"
#include "stillpoint_ros/mover_messages.hpp"
#include "stillpoint_ros/node_core.hpp"

namespace stillpoint_ros2 {

/// Declares each option as a parameter that is set before the node begins.
class RosParameters {
 public:
  explicit RosParameters(rclcpp::Node& node) : node_(node) {}

  template <class Value>
  Value get(const std::string& name, const Value& value) const {
    return node_.declare_parameter(name, value, read_only());
  }
  /// A number may be written without its point.
  double get(const std::string& name, double value) const {
    rcl_interfaces::msg::ParameterDescriptor descriptor = read_only();
    descriptor.dynamic_typing = true;
    const rclcpp::ParameterValue found = node_.declare_parameter(name, rclcpp::ParameterValue(value), descriptor);
    if (found.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER)
      return static_cast<double>(found.get<std::int64_t>());
    if (found.get_type() != rclcpp::ParameterType::PARAMETER_DOUBLE)
      throw stillpoint::Error("parameter " + name + " is '" + rclcpp::to_string(found) + "', expected a number");
    return found.get<double>();
  }

  /// The names that were given, but for those of ROS itself.
  std::vector<std::string> given() const {
    std::vector<std::string> names;
    for (const auto& entry : node_.get_node_parameters_interface()->get_parameter_overrides())
      if (entry.first != "use_sim_time" && entry.first != "start_type_description_service" &&
          entry.first.rfind("qos_overrides.", 0) != 0)
        names.push_back(entry.first);
    return names;
  }

 private:
  static rcl_interfaces::msg::ParameterDescriptor read_only() {
    rcl_interfaces::msg::ParameterDescriptor descriptor;
    descriptor.read_only = true;
    return descriptor;
  }

  rclcpp::Node& node_;
};

class StillpointComponent : public rclcpp::Node {
 public:
  explicit StillpointComponent(const rclcpp::NodeOptions& options)
      : Node("stillpoint", options),
        core_(input_topics(), [this](const auto& frame, const auto& answer) { publish(frame, answer); }) {
    const rclcpp::QoS reliable = rclcpp::QoS(kQueue).reliable();  // subscribers of either kind get it
    mask_ = create_publisher<Image>("~/mask", reliable);
    mask_inverse_ = create_publisher<Image>("~/mask_inverse", reliable);
    depth_ = create_publisher<Image>("~/depth", reliable);
    movers_ = create_publisher<visualization_msgs::msg::MarkerArray>("~/movers", reliable);
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
    mover_boxes_ = create_publisher<vision_msgs::msg::Detection3DArray>("~/mover_boxes", reliable);
#endif
    diagnostics_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", reliable);

    RosParameters parameters(*this);
    std::vector<std::string> known = core_.start(parameters);
    const std::string transport = parameters.get("image_transport", std::string("raw"));
    const std::string depth_transport = parameters.get("depth_transport", std::string("raw"));
    known.insert(known.end(), {"image_transport", "depth_transport", "classes"});
    names_.classes = stillpoint::ClassList::named(parameters.get("classes", std::string("coco")));
    const std::string unknown = stillpoint_ros::unknown_parameter(parameters.given(), known);
    if (!unknown.empty())
      throw stillpoint::Error("parameter " + unknown + " is unknown; docs/ros.md lists the parameters");

    image_in_ = image_transport::create_subscription(
        this, input_topic("image"), [this](const Image::ConstSharedPtr& image) { core_.add_image(raw(image)); },
        transport, rmw_qos_profile_sensor_data);
    depth_in_ = image_transport::create_subscription(
        this, input_topic("depth"), [this](const Image::ConstSharedPtr& depth) { core_.add_depth(raw(depth)); },
        depth_transport, rmw_qos_profile_sensor_data);
    camera_info_in_ = create_subscription<sensor_msgs::msg::CameraInfo>(
        "camera_info", rclcpp::SensorDataQoS(),
        [this](const sensor_msgs::msg::CameraInfo::ConstSharedPtr& info) { core_.add_camera_info(raw(*info)); });
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
    detections_in_ = create_subscription<vision_msgs::msg::Detection2DArray>(
        "detections", rclcpp::SensorDataQoS(),
        [this](const vision_msgs::msg::Detection2DArray::ConstSharedPtr& found) { add_detections(*found); });
#endif
    timer_ = create_wall_timer(std::chrono::seconds(1), [this] { report(); });
  }

 private:
  using Image = sensor_msgs::msg::Image;
  using ImagePublisher = rclcpp::Publisher<Image>::SharedPtr;
  static constexpr std::size_t kQueue = 5;

  std::array<std::string, stillpoint_ros::kInputCount> input_topics() {
    return {input_topic("image"), input_topic("depth"), input_topic("camera_info")};
  }
  /// Its name after remapping. Transports of images append to it, and ROS does not remap what they make of it.
  std::string input_topic(const std::string& name) { return get_node_topics_interface()->resolve_topic_name(name); }

  /// Unless somebody listens, nothing is copied.
  static void publish_if_wanted(const ImagePublisher& publisher, const stillpoint::ImageView& image,
                                const Image& original, const std::string& encoding) {
    if (publisher->get_subscription_count() > 0) publisher->publish(message(image, original.header, encoding));
  }

  void publish(const stillpoint_ros::PairedFrame& frame, const stillpoint_ros::FrameAnswer& answer) const {
    const auto image = std::static_pointer_cast<const Image>(frame.image.message);
    const auto depth = std::static_pointer_cast<const Image>(frame.depth.message);
    publish_if_wanted(depth_, answer.depth, *depth, depth->encoding);
    publish_if_wanted(mask_inverse_, answer.mask_inverse, *image, "mono8");
    if (movers_->get_subscription_count() > 0)
      movers_->publish(stillpoint_ros::markers<visualization_msgs::msg::MarkerArray>(answer.movers, image->header));
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
    const auto class_name = [this](int index) { return names_.name_of(std::to_string(index)); };
    if (mover_boxes_->get_subscription_count() > 0)
      mover_boxes_->publish(
          stillpoint_ros::detections_3d<vision_msgs::msg::Detection3DArray>(answer.movers, image->header, class_name));
#endif
    publish_if_wanted(mask_, answer.mask, *image, "mono8");
  }

#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
  void add_detections(const vision_msgs::msg::Detection2DArray& found) {
    std::vector<stillpoint::Detection> detections;
    for (const vision_msgs::msg::Detection2D& detection : found.detections) {
      stillpoint_ros::RawDetection box;
      box.score = 0.0;
      for (const auto& result : detection.results) {
        if (!(result.hypothesis.score > box.score)) continue;
        box.class_id = result.hypothesis.class_id;
        box.score = result.hypothesis.score;
      }
      box.centre_x = detection.bbox.center.position.x;
      box.centre_y = detection.bbox.center.position.y;
      box.width = detection.bbox.size_x;
      box.height = detection.bbox.size_y;
      detections.push_back(stillpoint_ros::detection_of(box, names_));
    }
    core_.add_detections(seconds(found.header.stamp), std::move(detections));
  }
#endif

  void report() {
    const stillpoint_ros::Report report = core_.report();
    for (const std::string& sentence : report.missing) RCLCPP_WARN(get_logger(), "%s", sentence.c_str());
    if (!report.hint.empty()) RCLCPP_WARN(get_logger(), "%s", report.hint.c_str());
    diagnostics_->publish(
        stillpoint_ros::diagnostics<diagnostic_msgs::msg::DiagnosticArray>(report, get_fully_qualified_name(), now()));
  }

  ImagePublisher mask_, mask_inverse_, depth_;
  rclcpp::Publisher<visualization_msgs::msg::MarkerArray>::SharedPtr movers_;
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
  rclcpp::Publisher<vision_msgs::msg::Detection3DArray>::SharedPtr mover_boxes_;
#endif
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr diagnostics_;
  stillpoint_ros::ClassNames names_;
  stillpoint_ros::NodeCore core_;  // before what hands messages to it
  image_transport::Subscriber image_in_, depth_in_;
  rclcpp::Subscription<sensor_msgs::msg::CameraInfo>::SharedPtr camera_info_in_;
#ifdef STILLPOINT_ROS2_WITH_VISION_MSGS
  rclcpp::Subscription<vision_msgs::msg::Detection2DArray>::SharedPtr detections_in_;
#endif
  rclcpp::TimerBase::SharedPtr timer_;
};

std::shared_ptr<rclcpp::Node> make_stillpoint(const rclcpp::NodeOptions& options) {
  return std::make_shared<StillpointComponent>(options);
}

}  // namespace stillpoint_ros2

RCLCPP_COMPONENTS_REGISTER_NODE(stillpoint_ros2::StillpointComponent)
