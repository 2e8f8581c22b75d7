// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a user may say of a network, whichever library runs it.

#include <optional>
#include <string>
#include <vector>

#include "stillpoint/detectors/class_list.hpp"
#include "stillpoint/detectors/decode_yolo_raw.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/mobility_table.hpp"
#include "stillpoint/detectors/preprocess.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

struct DetectorOptions {
  DetectorLayout layout = DetectorLayout::automatic;
  ClassList classes;       ///< none: COCO, VOC or Cityscapes, where the number of classes tells which
  MobilityTable mobility;  ///< which class moves
  InputSize input_size;    ///< zeros: as the model's file says
  float lowest_confidence = 0.4f;
  float highest_overlap = 0.45f;  ///< of two boxes of a class that overlap more (intersection over union), one is left

  std::optional<Preprocess> preprocess;   ///< none: as usual for the layout
  std::optional<YoloCoding> coding;       ///< none: that of the family, for layouts `yolov3` to `yolov7`
  std::optional<int> first_class_number;  ///< how the network calls `classes[0]`; none: as usual for the layout
  std::vector<std::string> outputs;       ///< names of the outputs that are read; none: all that the network has
  float smallest_part = 0.002f;           ///< of a segmented image: smaller connected parts are left out
};

}  // namespace stillpoint
