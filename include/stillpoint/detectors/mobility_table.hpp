// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Class names of a detector to mobility groups, by a table that the user can change.

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stillpoint/core/regions.hpp"

namespace stillpoint {

/// Which group a class belongs to. Names are compared as they are, with `_` and space alike; a class that is not in the
/// table is `Mobility::unknown`: its box says nothing.
class MobilityTable {
 public:
  /// The table for COCO's and VOC's names, and who moves in Cityscapes: people, animals and vehicles are dynamic; what
  /// people carry and push is movable; furniture and appliances are fixed (the paper, 3.2: wall, TV, table; chair,
  /// mouse, bottle).
  MobilityTable() {
    for (const char* name : {"person", "bicycle",  "car",  "motorcycle", "motorbike", "airplane", "aeroplane", "bus",
                             "train",  "truck",    "boat", "bird",       "cat",       "dog",      "horse",     "sheep",
                             "cow",    "elephant", "bear", "zebra",      "giraffe",   "rider"})
      set(name, Mobility::dynamic);
    for (const char* name :
         {"chair",          "bottle",     "mouse",      "backpack",      "umbrella",    "handbag",  "tie",
          "suitcase",       "frisbee",    "skis",       "snowboard",     "sports ball", "kite",     "baseball bat",
          "baseball glove", "skateboard", "surfboard",  "tennis racket", "wine glass",  "cup",      "fork",
          "knife",          "spoon",      "bowl",       "banana",        "apple",       "sandwich", "orange",
          "broccoli",       "carrot",     "hot dog",    "pizza",         "donut",       "cake",     "potted plant",
          "pottedplant",    "laptop",     "remote",     "keyboard",      "cell phone",  "book",     "vase",
          "scissors",       "teddy bear", "hair drier", "toothbrush"})
      set(name, Mobility::movable);
    for (const char* name :
         {"wall",         "tv",    "tvmonitor", "dining table",  "diningtable",  "table",     "couch",
          "sofa",         "bed",   "toilet",    "microwave",     "oven",         "toaster",   "sink",
          "refrigerator", "clock", "bench",     "traffic light", "fire hydrant", "stop sign", "parking meter"})
      set(name, Mobility::fixed);
  }

  void set(std::string_view class_name, Mobility mobility) {
    const auto found = find(class_name);
    if (found != entries_.end())
      found->second = mobility;
    else
      entries_.emplace_back(normalized(class_name), mobility);
  }

  Mobility operator[](std::string_view class_name) const {
    const std::string wanted = normalized(class_name);
    for (const auto& [name, mobility] : entries_)
      if (name == wanted) return mobility;
    return Mobility::unknown;
  }

 private:
  static std::string normalized(std::string_view name) {
    std::string result(name);
    std::replace(result.begin(), result.end(), '_', ' ');
    return result;
  }
  std::vector<std::pair<std::string, Mobility>>::iterator find(std::string_view class_name) {
    const std::string name = normalized(class_name);
    return std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry.first == name; });
  }

  std::vector<std::pair<std::string, Mobility>> entries_;
};

}  // namespace stillpoint
