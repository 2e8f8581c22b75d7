// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A detection of vision_msgs, without ROS, and what the prior takes of it.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/class_list.hpp"
#include "stillpoint/detectors/mobility_table.hpp"

namespace stillpoint_ros {

/// vision_msgs/Detection2D with its most probable class.
struct RawDetection {
  std::string class_id;  ///< a name, or a number in a list of classes
  double score = 1.0;
  double centre_x = 0.0, centre_y = 0.0, width = 0.0, height = 0.0;  ///< pixels
};

/// What may move of what a detector reports. Numbers are looked up in `classes`, names in `mobility`.
struct ClassNames {
  stillpoint::ClassList classes = stillpoint::ClassList::coco();
  stillpoint::MobilityTable mobility;

  std::string name_of(const std::string& class_id) const {
    const int number = number_of(class_id);
    return classes.names(number) ? classes[static_cast<std::size_t>(number)] : class_id;
  }
  /// In the list of classes; -1 where it has none of that name.
  int index_of(const std::string& class_id) const {
    if (const int number = number_of(class_id); classes.names(number)) return number;
    const std::string name = spaced(class_id);
    for (std::size_t i = 0; i < classes.size(); ++i)
      if (!name.empty() && spaced(classes[i]) == name) return static_cast<int>(i);
    return -1;
  }

 private:
  /// Some lists have "traffic light", others "traffic_light"; to `mobility` both are the same, too.
  static std::string spaced(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
  }
  static int number_of(const std::string& class_id) {
    const bool is_number =
        !class_id.empty() && class_id.size() < 6 && class_id.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? std::stoi(class_id) : -1;
  }
};

/// The library's form of it. A class that the table does not know is `Mobility::unknown`: its box says nothing.
inline stillpoint::Detection detection_of(const RawDetection& raw, const ClassNames& names) {
  stillpoint::Detection detection;
  detection.box = {static_cast<float>(raw.centre_x - raw.width / 2), static_cast<float>(raw.centre_y - raw.height / 2),
                   static_cast<float>(raw.width), static_cast<float>(raw.height)};
  detection.confidence = static_cast<float>(raw.score);
  detection.class_index = static_cast<std::int16_t>(names.index_of(raw.class_id));
  detection.mobility = names.mobility[names.name_of(raw.class_id)];
  return detection;
}

}  // namespace stillpoint_ros
