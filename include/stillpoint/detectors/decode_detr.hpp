// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// DETR and its relatives: a fixed number of queries, each of which answers with a class or with nothing.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/box_mask.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// Logits 1xQxC and boxes 1xQx4, in either order.
struct LogitsAndBoxes {
  const Tensor *logits = nullptr, *boxes = nullptr;
  explicit operator bool() const noexcept { return logits != nullptr && boxes != nullptr; }
};

/// Told apart by their columns; not there if both have four, or C is neither nc nor nc + 1.
inline LogitsAndBoxes find_queries(span<const Tensor> outputs, int class_count) noexcept {
  if (outputs.size() != 2) return {};
  const TensorShape &a = outputs[0].shape, &b = outputs[1].shape;
  if (a.rank() != 3 || b.rank() != 3 || a[0] != 1 || b[0] != 1 || a[1] != b[1] || (a[2] == 4) == (b[2] == 4)) return {};
  const std::size_t boxes = a[2] == 4 ? 0 : 1;
  const int columns = outputs[1 - boxes].shape[2];
  if (columns != class_count && columns != class_count + 1) return {};
  return {&outputs[1 - boxes], &outputs[boxes]};
}

/// Decodes logits 1xQxC and boxes 1xQx4 (middles and sizes as shares of the input). C == nc: sigmoids (RT-DETR,
/// D-FINE); C == nc + 1: softmax with "nothing" as the last column (Carion et al., "DETR", 2020).
inline void decode_detr(span<const Tensor> outputs, const DecodeSettings& settings, std::vector<RawDetection>& found) {
  const LogitsAndBoxes parts = find_queries(outputs, settings.class_count);
  require_shape(static_cast<bool>(parts), "detr", "1xQx(classes or classes+1) and 1xQx4, classes not 4", outputs);
  const Tensor *const logits = parts.logits, *const boxes = parts.boxes;
  const int columns = logits->shape[2];
  const bool softmax = columns == settings.class_count + 1;
  const auto width = static_cast<float>(settings.input.width), height = static_cast<float>(settings.input.height);
  for (int q = 0; q < logits->shape[1]; ++q) {
    const float* const row = logits->data + std::ptrdiff_t{q} * columns;
    const BestClass best = best_class(row, settings.class_count);
    float score = sigmoid(best.score);
    if (softmax) {
      float sum = 0;
      const float highest = std::max(best.score, row[columns - 1]);
      for (int c = 0; c < columns; ++c) sum += std::exp(row[c] - highest);
      score = std::exp(best.score - highest) / sum;
    }
    if (!(score >= settings.lowest_confidence)) continue;
    const float* const box = boxes->data + std::ptrdiff_t{q} * 4;
    append_centred(found, box[0] * width, box[1] * height, box[2] * width, box[3] * height, score, best.label, q);
  }
}

/// The three or four outputs of networks that sort their answers themselves.
struct LabelledBoxes {
  const Tensor *labels = nullptr, *boxes = nullptr, *scores = nullptr, *masks = nullptr;
  bool complete() const noexcept { return labels != nullptr && boxes != nullptr && scores != nullptr; }
};

/// Told apart by shape and by the labels' being integers: Q labels, Qx4 boxes, Q scores, and perhaps Qx1xhxw masks.
inline LabelledBoxes find_labelled_boxes(span<const Tensor> outputs) {
  LabelledBoxes found;
  std::size_t queries = 0;
  for (const Tensor& output : outputs)
    if (output.whole_numbers && output.shape.rank() <= 2) {
      found.labels = &output;
      queries = output.shape.count();
    }
  for (const Tensor& output : outputs) {
    const TensorShape& shape = output.shape;
    if (&output == found.labels) continue;
    if (shape.rank() <= 3 && shape.last() == 4 && shape.count() == 4 * queries)
      found.boxes = &output;
    else if (shape.rank() <= 2 && shape.count() == queries)
      found.scores = &output;
    else if (shape.rank() == 4 && shape[1] == 1 && static_cast<std::size_t>(shape[0]) == queries)
      found.masks = &output;
    else
      return {};
  }
  return found;
}

/// Decodes RT-DETR and D-FINE with their post-processing, and torchvision's detectors: corners in pixels of the input;
/// masks (torchvision's Mask R-CNN) cover the whole input.
inline void decode_labelled_boxes(span<const Tensor> outputs, const DecodeSettings& settings,
                                  std::vector<RawDetection>& found) {
  const LabelledBoxes parts = find_labelled_boxes(outputs);
  require_shape(parts.complete(), "labelled-boxes", "Q integers, Qx4, Q scores, and perhaps Qx1xhxw", outputs);
  const auto queries = static_cast<int>(parts.labels->shape.count());
  for (int q = 0; q < queries; ++q) {
    const float score = parts.scores->data[q];
    if (!(score >= settings.lowest_confidence)) continue;
    const float* const box = parts.boxes->data + std::ptrdiff_t{q} * 4;
    append_corners(found, box[0], box[1], box[2], box[3], score, label_of(parts.labels->data[q]), q);
  }
  if (parts.masks == nullptr) return;
  const int rows = parts.masks->shape[2], columns = parts.masks->shape[3];
  const float columns_per_px = static_cast<float>(columns) / static_cast<float>(settings.input.width);
  const float rows_per_px = static_cast<float>(rows) / static_cast<float>(settings.input.height);
  for (RawDetection& box : found) {
    const float* const cells = parts.masks->data + std::ptrdiff_t{box.source} * rows * columns;
    const float width = std::min((box.right - box.left) * columns_per_px, static_cast<float>(columns));
    const float height = std::min((box.bottom - box.top) * rows_per_px, static_cast<float>(rows));
    box.mask =
        make_mask(box, static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)), [&](float x, float y) {
          const int u = cell_at(x * columns_per_px, columns), v = cell_at(y * rows_per_px, rows);
          return u >= 0 && v >= 0 && cells[v * columns + u] > 0.5f;
        });
  }
}

}  // namespace stillpoint
