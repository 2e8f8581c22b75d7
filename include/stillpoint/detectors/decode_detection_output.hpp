// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Boxes after the network's own suppression of duplicates, seven numbers a row, in two orders; and six.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/box_mask.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// SSD's DetectionOutput, 1x1xKx7: image, class, score, corners as shares of the input. Unused rows score 0.
inline void decode_detection_output(const Tensor& output, const DecodeSettings& settings,
                                    std::vector<RawDetection>& found) {
  const TensorShape& shape = output.shape;
  require_shape(shape.rank() == 4 && shape[0] == 1 && shape[1] == 1 && shape[3] == 7, "ssd", "1x1xKx7", {&output, 1});
  const auto width = static_cast<float>(settings.input.width), height = static_cast<float>(settings.input.height);
  for (int i = 0; i < shape[2]; ++i) {
    const float* const row = output.data + std::ptrdiff_t{i} * 7;
    if (!(row[2] > 0.0f && row[2] >= settings.lowest_confidence)) continue;
    append_corners(found, row[3] * width, row[4] * height, row[5] * width, row[6] * height, row[2], label_of(row[1]),
                   i);
  }
}

/// Gives each box of `decode_detection_output` its mask: the channel of its class, stretched over the box, where it
/// passes one half (He et al., "Mask R-CNN", 2017).
/// @param masks  Kxnxhxw, probabilities; a box whose class has no channel stays without a mask
/// @throws Error on another shape, and where there are boxes but h or w is 0.
inline void attach_class_masks(const Tensor& masks, std::vector<RawDetection>& found) {
  const int channels = masks.shape[1], rows = masks.shape[2], columns = masks.shape[3];
  require_shape(masks.shape.rank() == 4 && (found.empty() || (rows > 0 && columns > 0)), "mask-rcnn",
                "1x1xKx7 and Kx(classes)xhxw", {&masks, 1});
  // Cells of the mask for each of the network's, which are interpolated; those of a large one are fine enough.
  constexpr int kLarge = 256;
  const int finer = rows < kLarge && columns < kLarge ? 4 : 1;
  for (RawDetection& box : found) {
    if (box.source >= masks.shape[0] || box.label < 0 || box.label >= channels) continue;
    const float* const cells = masks.data + (std::ptrdiff_t{box.source} * channels + box.label) * rows * columns;
    const auto inside = [&](float x, float y) {
      const float u = std::clamp((x - box.left) / (box.right - box.left) * static_cast<float>(columns) - 0.5f, 0.0f,
                                 static_cast<float>(columns - 1));
      const float v = std::clamp((y - box.top) / (box.bottom - box.top) * static_cast<float>(rows) - 0.5f, 0.0f,
                                 static_cast<float>(rows - 1));
      const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
      const int u1 = std::min(u0 + 1, columns - 1), v1 = std::min(v0 + 1, rows - 1);
      const float a = u - static_cast<float>(u0), b = v - static_cast<float>(v0);
      const auto at = [&](int column, int row) { return cells[row * columns + column]; };
      return (1 - b) * ((1 - a) * at(u0, v0) + a * at(u1, v0)) + b * ((1 - a) * at(u0, v1) + a * at(u1, v1)) > 0.5f;
    };
    box.mask = make_mask(box, finer * columns, finer * rows, inside);
  }
}

/// YOLOv7 exported with suppression inside, Kx7: image, corners in pixels of the input, class, score.
inline void decode_yolov7_end2end(const Tensor& output, const DecodeSettings& settings,
                                  std::vector<RawDetection>& found) {
  const TensorShape& shape = output.shape;
  require_shape(shape.rank() == 2 && shape[1] == 7, "yolov7-end2end", "Kx7", {&output, 1});
  for (int i = 0; i < shape[0]; ++i) {
    const float* const row = output.data + std::ptrdiff_t{i} * 7;
    if (row[6] >= settings.lowest_confidence)
      append_corners(found, row[1], row[2], row[3], row[4], row[6], label_of(row[5]), i);
  }
}

/// YOLOv10, YOLO26, or v8 with suppression inside, 1xKx6: corners in pixels of the input, score, class.
inline void decode_end2end(const Tensor& output, const DecodeSettings& settings, std::vector<RawDetection>& found) {
  const TensorShape& shape = output.shape;
  require_shape(shape.rank() == 3 && shape[0] == 1 && shape[2] == 6, "end2end", "1xKx6", {&output, 1});
  for (int i = 0; i < shape[1]; ++i) {
    const float* const row = output.data + std::ptrdiff_t{i} * 6;
    if (row[4] >= settings.lowest_confidence)
      append_corners(found, row[0], row[1], row[2], row[3], row[4], label_of(row[5]), i);
  }
}

}  // namespace stillpoint
