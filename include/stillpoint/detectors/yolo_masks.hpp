// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Masks of YOLO's segmentation variants: each box mixes prototypes that cover the whole image
// (Bolya et al., "YOLACT", 2019).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/detectors/box_mask.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// Where the numbers that mix the prototypes are in the boxes' output.
struct MaskFields {
  int first = 0;            ///< 4 + nc or 5 + nc
  bool boxes_last = false;  ///< a column for each box, not a row
};

/// Gives each box its mask: inside where the sigmoid of the mixture passes one half, that is, the mixture is positive.
/// @param prototypes  1xmxhxw
inline void attach_yolo_masks(const Tensor& boxes, const Tensor& prototypes, const MaskFields& fields,
                              const InputSize& input, std::vector<RawDetection>& found) {
  const int count = prototypes.shape[1], rows = prototypes.shape[2], columns = prototypes.shape[3];
  const std::ptrdiff_t per_box = fields.boxes_last ? 1 : boxes.shape[2];
  const std::ptrdiff_t per_field = fields.boxes_last ? boxes.shape[2] : 1;
  const std::ptrdiff_t per_prototype = std::ptrdiff_t{rows} * columns;
  const float columns_per_px = static_cast<float>(columns) / static_cast<float>(input.width);
  const float rows_per_px = static_cast<float>(rows) / static_cast<float>(input.height);
  for (RawDetection& box : found) {
    const float* const mixture = boxes.data + box.source * per_box + fields.first * per_field;
    const auto inside = [&](float x, float y) {
      const int u = cell_at(x * columns_per_px, columns), v = cell_at(y * rows_per_px, rows);
      if (u < 0 || v < 0) return false;
      const float* const prototype = prototypes.data + v * columns + u;
      float sum = 0;
      for (int k = 0; k < count; ++k) sum += mixture[k * per_field] * prototype[k * per_prototype];
      return sum > 0.0f;
    };
    // No finer than the prototypes, and no larger than they are, however large the box.
    const float width = std::min((box.right - box.left) * columns_per_px, static_cast<float>(columns));
    const float height = std::min((box.bottom - box.top) * rows_per_px, static_cast<float>(rows));
    box.mask = make_mask(box, static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)), inside);
  }
}

}  // namespace stillpoint
