// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a detector found, as a file: boxes.txt of a sequence, `timestamp class_name confidence x y w h`.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/io/table_reader.hpp"

namespace stillpoint {

/// What a detector says of one object.
struct DetectedBox {
  std::string class_name;   ///< as the detector's list of classes has it, with its spaces
  float confidence = 0.0f;  ///< 0 to 1
  Box box;                  ///< pixels of the image as it is; may reach over its edge
};

/// All boxes of one frame.
struct FrameBoxes {
  double timestamp_s = 0.0;
  std::vector<DetectedBox> boxes;
};

/// Reads a file of boxes. Spaces in a class name are written `_` there and come back as spaces.
/// @return        one entry for each time that has a box, in the order of time: a frame without one has no entry, and a
///                file with a header only gives none.
/// @throws Error if the file is missing; with file and line for a row that does not have the seven columns, a
///         confidence outside [0, 1], a size that is not positive, or a time before that of the row above.
inline std::vector<FrameBoxes> read_boxes(const std::filesystem::path& file) {
  std::vector<FrameBoxes> frames;
  TableReader rows(file);
  const auto pixels = [&rows](std::size_t column, const char* name) {
    constexpr double kMostPixels = 1e6;  // beyond any image, and exact enough as a float
    const double value = rows.number(column, name);
    if (!(std::abs(value) <= kMostPixels)) rows.fail_at(column, name, "a number of pixels of at most a million");
    return static_cast<float>(value);
  };
  for (double previous_s = TableReader::kBeforeAllTime; rows.next_row();) {
    rows.require_columns(7, "timestamp class_name confidence x y w h");
    const double timestamp_s = rows.time(0, previous_s);
    DetectedBox box;
    box.class_name = std::string(rows[1]);
    std::replace(box.class_name.begin(), box.class_name.end(), '_', ' ');
    const double confidence = rows.number(2, "confidence");
    if (!(confidence >= 0 && confidence <= 1)) rows.fail_at(2, "confidence", "a number from 0 to 1");
    box.confidence = static_cast<float>(confidence);
    box.box = {pixels(3, "x"), pixels(4, "y"), pixels(5, "w"), pixels(6, "h")};
    if (!(box.box.width > 0)) rows.fail_at(5, "w", "a positive number of pixels");
    if (!(box.box.height > 0)) rows.fail_at(6, "h", "a positive number of pixels");
    if (frames.empty() || frames.back().timestamp_s != timestamp_s) frames.push_back({timestamp_s, {}});
    frames.back().boxes.push_back(std::move(box));
  }
  return frames;
}

/// The boxes of the frame taken at a time; null where nothing was detected then.
/// @param frames       in the order of time, as `read_boxes` returns them.
/// @param tolerance_s  how far the time may be off. The default allows for rounding to the millisecond.
inline const FrameBoxes* boxes_at(const std::vector<FrameBoxes>& frames, double timestamp_s,
                                  double tolerance_s = 0.001) {
  const FrameBoxes* nearest = nullptr;
  const auto distance = [&](const FrameBoxes& frame) { return std::abs(frame.timestamp_s - timestamp_s); };
  const auto first = std::lower_bound(frames.begin(), frames.end(), timestamp_s - tolerance_s,
                                      [](const FrameBoxes& frame, double t) { return frame.timestamp_s < t; });
  for (auto frame = first; frame != frames.end() && frame->timestamp_s <= timestamp_s + tolerance_s; ++frame)
    if (nearest == nullptr || distance(*frame) < distance(*nearest)) nearest = &*frame;
  return nearest;
}

}  // namespace stillpoint
