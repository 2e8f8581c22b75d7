// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Movers as messages that ROS 1 and ROS 2 spell alike: the types are template parameters.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_ros {

namespace detail {

/// A geometry_msgs Point or Vector3.
template <class Message>
void assign(Message& message, const stillpoint::Vector3d& value) {
  message.x = value.x();
  message.y = value.y();
  message.z = value.z();
}

/// An identifier has one colour; neighbours differ.
template <class Colour>
void assign_colour(Colour& colour, std::uint32_t id, float opacity) {
  constexpr std::array<std::array<float, 3>, 6> kColours = {{{1.0f, 0.48f, 0.85f},
                                                             {0.24f, 0.84f, 1.0f},
                                                             {1.0f, 0.69f, 0.23f},
                                                             {0.73f, 0.64f, 1.0f},
                                                             {0.83f, 0.95f, 0.29f},
                                                             {1.0f, 0.61f, 0.56f}}};
  const std::array<float, 3>& rgb = kColours[id % kColours.size()];
  colour.r = rgb[0];
  colour.g = rgb[1];
  colour.b = rgb[2];
  colour.a = opacity;
}

/// No box of an object that is seen from one side is flat.
inline stillpoint::Vector3d visible_size(const stillpoint::Mover& mover) {
  constexpr double kThinnest_m = 0.05;
  return mover.extent_m.cwiseMax(kThinnest_m);
}

}  // namespace detail

/// A visualization_msgs MarkerArray that takes the place of the one before: for each mover a box, "2: 1.1 m/s" above
/// it, and an arrow as long as it goes in a second. A lost one has a faint box and no arrow.
/// @param header  of the image: its frame is the camera's optical one, in which movers are given
template <class MarkerArray, class Header>
MarkerArray markers(stillpoint::span<const stillpoint::Mover> movers, const Header& header) {
  MarkerArray array;
  using Marker = typename decltype(array.markers)::value_type;
  Marker clears;
  clears.header = header;
  clears.action = Marker::DELETEALL;
  array.markers.push_back(clears);
  for (const stillpoint::Mover& mover : movers) {
    const bool is_lost = mover.state == stillpoint::MoverState::lost;
    const stillpoint::Vector3d size = detail::visible_size(mover);
    const auto add = [&](const char* kind, auto type, float opacity) -> Marker& {
      Marker marker;
      marker.header = header;
      marker.ns = kind;
      marker.id = static_cast<decltype(marker.id)>(mover.id);
      marker.type = type;
      marker.action = Marker::ADD;
      marker.pose.orientation.w = 1.0;
      detail::assign_colour(marker.color, mover.id, opacity);
      array.markers.push_back(marker);
      return array.markers.back();
    };
    Marker& box = add("box", Marker::CUBE, is_lost ? 0.15f : 0.4f);
    detail::assign(box.pose.position, mover.centroid);
    detail::assign(box.scale, size);
    Marker& text = add("text", Marker::TEXT_VIEW_FACING, 1.0f);
    constexpr double kLetters_m = 0.15;
    detail::assign(text.pose.position,
                   mover.centroid - stillpoint::Vector3d(0, size.y() / 2 + kLetters_m, 0));  // y points down
    text.scale.z = kLetters_m;
    text.text =
        std::to_string(mover.id) + ": " +
        (mover.state == stillpoint::MoverState::moving ? stillpoint::format_fixed(mover.velocity.norm(), 1) + " m/s"
                                                       : to_string(mover.state));
    if (is_lost) continue;
    Marker& arrow = add("velocity", Marker::ARROW, 1.0f);
    arrow.points.resize(2);
    detail::assign(arrow.points[0], mover.centroid);
    detail::assign(arrow.points[1], mover.centroid + mover.velocity);
    arrow.scale.x = 0.03;  // metres: shaft, head
    arrow.scale.y = 0.08;
  }
  return array;
}

/// A vision_msgs Detection3DArray with the movers that are seen: their boxes along the axes of the camera, their
/// identifiers as `id`, and the class where a detector named it.
/// @param class_name  (int class_index) → text
template <class DetectionArray, class Header, class ClassName>
DetectionArray detections_3d(stillpoint::span<const stillpoint::Mover> movers, const Header& header,
                             const ClassName& class_name) {
  DetectionArray array;
  array.header = header;
  for (const stillpoint::Mover& mover : movers) {
    if (mover.state == stillpoint::MoverState::lost) continue;
    array.detections.emplace_back();
    auto& detection = array.detections.back();
    detection.header = header;
    detection.id = std::to_string(mover.id);
    detail::assign(detection.bbox.center.position, mover.centroid);
    detection.bbox.center.orientation.w = 1.0;
    detail::assign(detection.bbox.size, detail::visible_size(mover));
    if (mover.class_index < 0) continue;
    detection.results.emplace_back();
    auto& result = detection.results.back();
    result.hypothesis.class_id = class_name(mover.class_index);
    result.hypothesis.score = static_cast<double>(mover.confidence);
    result.pose.pose = detection.bbox.center;
  }
  return array;
}

}  // namespace stillpoint_ros
