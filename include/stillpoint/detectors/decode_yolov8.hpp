// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// YOLO without an objectness (YOLOv8, v9, v11): a column, or a row, for each box.

#include <cstddef>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// Decodes 1x(4+nc+m)xN: middle and size in pixels of the input, class probabilities, numbers that belong to a mask.
/// @param transposed  1xNx(4+nc+m)
inline void decode_yolov8(const Tensor& output, const DecodeSettings& settings, int mask_fields, bool transposed,
                          std::vector<RawDetection>& found) {
  const TensorShape& shape = output.shape;
  const int fields = 4 + settings.class_count + mask_fields;
  require_shape(shape.rank() == 3 && shape[0] == 1 && shape[transposed ? 2 : 1] == fields,
                transposed ? "yolov8-transposed" : "yolov8", transposed ? "1xNx(4+classes)" : "1x(4+classes)xN",
                {&output, 1});
  const int boxes = shape[transposed ? 1 : 2];
  const std::ptrdiff_t per_box = transposed ? fields : 1, per_field = transposed ? 1 : boxes;
  for (int i = 0; i < boxes; ++i) {
    const float* const box = output.data + i * per_box;
    const BestClass best = best_class(box + 4 * per_field, settings.class_count, per_field);
    if (!(best.score >= settings.lowest_confidence)) continue;
    append_centred(found, box[0], box[per_field], box[2 * per_field], box[3 * per_field], best.score, best.label, i);
  }
}

}  // namespace stillpoint
