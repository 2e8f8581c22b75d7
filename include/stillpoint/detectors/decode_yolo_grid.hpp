// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Rows of YOLO with an objectness: middle and size, objectness, a score for each class.

#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/cells.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

namespace detail {

struct YoloRow {
  const float* fields;  ///< x, y, width, height, objectness, classes
  float score;
  int label, index;
};

/// Calls `visit(YoloRow)` for the rows that score enough.
template <class Visit>
void for_each_yolo_row(const Tensor& output, int rows, const DecodeSettings& settings, bool times_objectness,
                       Visit&& visit) {
  const std::ptrdiff_t fields = output.shape.last();
  for (int i = 0; i < rows; ++i) {
    const float* const row = output.data + i * fields;
    if (!(row[4] >= settings.lowest_confidence)) continue;
    const BestClass best = best_class(row + 5, settings.class_count);
    const float score = times_objectness ? row[4] * best.score : best.score;
    if (score >= settings.lowest_confidence) visit(YoloRow{row, score, best.label, i});
  }
}

inline bool is_rows(const TensorShape& shape, int fields) {
  return shape.rank() == 3 && shape[0] == 1 && shape[2] == fields;
}

}  // namespace detail

/// Decoded rows 1xNx(5+nc+m), pixels of the input: YOLOv5 and v7 exported with `--grid`, YOLOX with its decoding
/// inside.
/// @param mask_fields  m, numbers behind the classes that belong to a mask
inline void decode_yolo_grid(const Tensor& output, const DecodeSettings& settings, int mask_fields,
                             std::vector<RawDetection>& found) {
  require_shape(detail::is_rows(output.shape, 5 + settings.class_count + mask_fields), "yolo-grid",
                mask_fields == 0 ? "1xNx(5+classes)" : "1xNx(5+classes+masks)", {&output, 1});
  detail::for_each_yolo_row(output, output.shape[1], settings, true, [&](const detail::YoloRow& row) {
    const float* const f = row.fields;
    append_centred(found, f[0], f[1], f[2], f[3], row.score, row.label, row.index);
  });
}

/// YOLOX as it is usually exported, 1xNx(5+nc), N = cells: middles relative to their cell, logarithms of sizes, in
/// strides (Ge et al., "YOLOX", 2021).
inline void decode_yolox(const Tensor& output, const DecodeSettings& settings, std::vector<RawDetection>& found) {
  const int last = output.shape.rank() == 3 ? last_stride(settings.input, output.shape[1]) : 0;
  require_shape(last != 0 && detail::is_rows(output.shape, 5 + settings.class_count), "yolox",
                "1xNx(5+classes) with N cells of strides 8 to 32", {&output, 1});
  struct Cell {
    float u, v, stride_px;
  };
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(output.shape[1]));
  for_each_cell(settings.input, last, [&](int, int u, int v, int stride_px) {
    cells.push_back({static_cast<float>(u), static_cast<float>(v), static_cast<float>(stride_px)});
  });
  detail::for_each_yolo_row(output, output.shape[1], settings, true, [&](const detail::YoloRow& row) {
    const Cell& cell = cells[static_cast<std::size_t>(row.index)];
    const float* const f = row.fields;
    append_centred(found, (f[0] + cell.u) * cell.stride_px, (f[1] + cell.v) * cell.stride_px,
                   std::exp(f[2]) * cell.stride_px, std::exp(f[3]) * cell.stride_px, row.score, row.label, row.index);
  });
}

/// Whether rows as YOLOX's are still to be decoded: logarithms of sizes may be negative, and no middle is far from its
/// cell, while decoded ones are all over the image.
inline bool yolox_is_undecoded(const Tensor& output) noexcept {
  constexpr float kFarthest = 16.0f;  // raw ones stay below 4, decoded ones reach the input's width
  const std::ptrdiff_t fields = output.shape.last();
  bool near = true;
  for (int i = 0; i < output.shape[1]; ++i) {
    const float* const row = output.data + i * fields;
    if (row[2] < 0.0f || row[3] < 0.0f) return true;
    near = near && std::abs(row[0]) < kFarthest && std::abs(row[1]) < kFarthest;
  }
  return near;
}

/// OpenCV's region layers for Darknet, one or more of Nx(5+nc): shares of the input; the class scores are already
/// multiplied by the objectness, and zero where the layer's own threshold (0.2 unless the .cfg says another) cut them.
inline void decode_darknet(span<const Tensor> outputs, const DecodeSettings& settings,
                           std::vector<RawDetection>& found) {
  const auto width = static_cast<float>(settings.input.width), height = static_cast<float>(settings.input.height);
  int first = 0;
  for (const Tensor& output : outputs) {
    require_shape(output.shape.rank() == 2 && output.shape[1] == 5 + settings.class_count, "darknet",
                  "one or more Nx(5+classes)", outputs);
    detail::for_each_yolo_row(output, output.shape[0], settings, false, [&](const detail::YoloRow& row) {
      const float* const f = row.fields;
      append_centred(found, f[0] * width, f[1] * height, f[2] * width, f[3] * height, row.score, row.label,
                     first + row.index);
    });
    first += output.shape[0];
  }
}

}  // namespace stillpoint
