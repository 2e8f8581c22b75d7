// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Movers as messages: what the fields of ROS's types get, in types of the same names.

#include "stillpoint_ros/mover_messages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace stillpoint_ros::mover_messages_test {

struct Header {
  std::string frame_id;
};
struct Point {
  double x = 0, y = 0, z = 0;
};
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 0;
};
struct RosPose {
  Point position;
  Quaternion orientation;
};
struct Colour {
  float r = 0, g = 0, b = 0, a = 0;
};
struct Marker {
  enum : std::int32_t { ARROW = 0, CUBE = 1, TEXT_VIEW_FACING = 9, ADD = 0, DELETEALL = 3 };
  Header header;
  std::string ns, text;
  std::int32_t id = 0, type = 0, action = 0;
  RosPose pose;
  Point scale;
  Colour color;
  std::vector<Point> points;
};
struct MarkerArray {
  std::vector<Marker> markers;
};
struct Hypothesis {
  std::string class_id;
  double score = 0;
};
struct PoseWithCovariance {
  RosPose pose;
};
struct HypothesisWithPose {
  Hypothesis hypothesis;
  PoseWithCovariance pose;
};
struct BoundingBox {
  RosPose center;
  Point size;
};
struct Detection3D {
  Header header;
  std::vector<HypothesisWithPose> results;
  BoundingBox bbox;
  std::string id;
};
struct Detection3DArray {
  Header header;
  std::vector<Detection3D> detections;
};

/// One of each state, 2 m ahead; the second has a class.
std::vector<stillpoint::Mover> movers() {
  std::vector<stillpoint::Mover> all(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    all[i].id = i + 4;
    all[i].state = static_cast<stillpoint::MoverState>(i);
    all[i].centroid = {0.1, 0.2, 2.0};
    all[i].extent_m = {0.5, 1.0, 0.0};
    all[i].velocity = {0.3, 0.0, -0.4};
  }
  all[1].class_index = 7;
  all[1].confidence = 0.5f;
  return all;
}

TEST(MoverMessages, MarkersHaveABoxATextAndAnArrow) {
  const auto array = markers<MarkerArray>(movers(), Header{"camera"});
  ASSERT_EQ(array.markers.size(), 1u + 3u + 3u + 2u);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL) << "what was there before goes";
  for (const Marker& marker : array.markers) EXPECT_EQ(marker.header.frame_id, "camera");
  const Marker &box = array.markers[1], &text = array.markers[2], &arrow = array.markers[3];
  EXPECT_EQ(box.type, Marker::CUBE);
  EXPECT_EQ(box.id, 4);
  EXPECT_EQ(box.pose.position.y, 0.2);
  EXPECT_EQ(box.pose.orientation.w, 1.0);
  EXPECT_EQ(box.scale.y, 1.0);
  EXPECT_EQ(box.scale.z, 0.05) << "seen from one side, and not flat";
  EXPECT_EQ(text.text, "4: 0.5 m/s");
  EXPECT_LT(text.pose.position.y, 0.2 - 0.5) << "above the box: y points down";
  EXPECT_EQ(arrow.type, Marker::ARROW);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_EQ(arrow.points[1].x, 0.1 + 0.3);
  EXPECT_EQ(arrow.points[1].z, 2.0 - 0.4);
  EXPECT_EQ(array.markers[5].text, "5: parked");
  EXPECT_EQ(array.markers[8].text, "6: lost") << "the last: without an arrow";
  EXPECT_LT(array.markers[7].color.a, box.color.a);
}

TEST(MoverMessages, WithoutMoversTheMarkersGo) {
  const auto array = markers<MarkerArray>({}, Header{"camera"});
  ASSERT_EQ(array.markers.size(), 1u);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
}

TEST(MoverMessages, DetectionsAreThoseThatAreSeen) {
  const auto array = detections_3d<Detection3DArray>(movers(), Header{"camera"},
                                                     [](int index) { return "class " + std::to_string(index); });
  EXPECT_EQ(array.header.frame_id, "camera");
  ASSERT_EQ(array.detections.size(), 2u);
  EXPECT_EQ(array.detections[0].id, "4");
  EXPECT_TRUE(array.detections[0].results.empty());
  EXPECT_EQ(array.detections[0].bbox.center.position.z, 2.0);
  EXPECT_EQ(array.detections[0].bbox.size.x, 0.5);
  ASSERT_EQ(array.detections[1].results.size(), 1u);
  EXPECT_EQ(array.detections[1].results[0].hypothesis.class_id, "class 7");
  EXPECT_EQ(array.detections[1].results[0].hypothesis.score, 0.5);
  EXPECT_EQ(array.detections[1].results[0].pose.pose.position.x, 0.1);
}

}  // namespace stillpoint_ros::mover_messages_test
