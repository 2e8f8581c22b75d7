// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// NanoDet, NanoDet-Plus and PicoDet: class scores, and distances to a box's four sides as distributions over whole
// strides (Li et al., "Generalized Focal Loss", 2020).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/cells.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

namespace detail {

/// Mean of 0, 1 … bins-1 under the softmax of the given logarithms.
inline float expected_bin(const float* logits, int bins) noexcept {
  const float highest = *std::max_element(logits, logits + bins);
  float sum = 0, weighted = 0;
  for (int i = 0; i < bins; ++i) {
    const float weight = std::exp(logits[i] - highest);
    sum += weight;
    weighted += weight * static_cast<float>(i);
  }
  return weighted / sum;
}

/// @param middle_x, middle_y  of the cell, pixels
inline void append_distances(const float* distances, int bins, float middle_x, float middle_y, int stride_px,
                             const BestClass& best, int source, std::vector<RawDetection>& found) {
  std::array<float, 4> side{};  // left, top, right, bottom
  for (std::size_t s = 0; s < side.size(); ++s)
    side[s] = expected_bin(distances + static_cast<int>(s) * bins, bins) * static_cast<float>(stride_px);
  append_corners(found, middle_x - side[0], middle_y - side[1], middle_x + side[2], middle_y + side[3], best.score,
                 best.label, source);
}

/// n and the number of columns of nxC or 1xnxC; zeros for other shapes.
inline std::array<int, 2> table_size(const TensorShape& shape) noexcept {
  if (shape.rank() == 2) return {shape[0], shape[1]};
  if (shape.rank() == 3 && shape[0] == 1) return {shape[1], shape[2]};
  return {0, 0};
}

}  // namespace detail

/// Where a family has the middle of a cell: first + stride · (index + offset).
struct CellMiddle {
  float offset = 0.5f, first_px = 0.0f;
};
inline constexpr CellMiddle kNanoDetMiddle{0.5f, -0.5f};
inline constexpr CellMiddle kPicoDetMiddle{0.5f, 0.0f};
inline constexpr CellMiddle kNanoDetPlusMiddle{0.0f, 0.0f};

/// The output with a row for each cell of one stride, which holds distances or, else, class scores. The names of the
/// outputs and their order say nothing that can be relied on.
/// @return null if there is none, or two
inline const Tensor* find_distance_head(span<const Tensor> outputs, int cells, int class_count, bool distances) {
  constexpr int kMostBins = 17;  // the families have 8; more are rather classes
  const Tensor* found = nullptr;
  for (const Tensor& output : outputs) {
    const auto [rows, columns] = detail::table_size(output.shape);
    const bool are_distances = columns % 4 == 0 && columns > 4 && columns <= 4 * kMostBins;
    if (rows != cells || (distances ? !are_distances || columns == class_count : columns != class_count)) continue;
    if (found != nullptr) return nullptr;
    found = &output;
  }
  return found;
}

/// Decodes pairs of nx(nc) scores (sigmoids) and nx4(r+1) distances, strides 8 to 32, or to 64 with eight outputs.
inline void decode_nanodet(span<const Tensor> outputs, const DecodeSettings& settings, const CellMiddle& middle,
                           std::vector<RawDetection>& found) {
  constexpr std::size_t kMostHeads = 4;
  require_shape(outputs.size() % 2 == 0 && outputs.size() <= 2 * kMostHeads, "nanodet or picodet",
                "a pair for each stride from 8 to 64 at most", outputs);
  int source = 0;
  for (int stride_px = 8, head = 0; head < static_cast<int>(outputs.size()) / 2; stride_px *= 2, ++head) {
    const int cells = cells_of(settings.input, stride_px);
    const Tensor* const scores = find_distance_head(outputs, cells, settings.class_count, false);
    const Tensor* const distances = find_distance_head(outputs, cells, settings.class_count, true);
    require_shape(scores != nullptr && distances != nullptr, "nanodet or picodet",
                  "for each stride from 8 on a pair (cells)x(classes) and (cells)x(4 bins), classes not 4 bins",
                  outputs);
    const int columns = cells_along(settings.input.width, stride_px), fields = distances->shape.last();
    const auto at = [&](int index) {
      return middle.first_px + (static_cast<float>(index) + middle.offset) * static_cast<float>(stride_px);
    };
    for (int i = 0; i < cells; ++i, ++source) {
      const BestClass best = best_class(scores->data + std::ptrdiff_t{i} * settings.class_count, settings.class_count);
      if (!(best.score >= settings.lowest_confidence)) continue;
      detail::append_distances(distances->data + std::ptrdiff_t{i} * fields, fields / 4, at(i % columns),
                               at(i / columns), stride_px, best, source, found);
    }
  }
}

/// Decodes NanoDet-Plus, 1xNx(nc+4(r+1)): N = cells of strides 8 to 64, or to 32.
inline void decode_nanodet_plus(const Tensor& output, const DecodeSettings& settings,
                                std::vector<RawDetection>& found) {
  const auto [rows, fields] = detail::table_size(output.shape);
  const int last = last_stride(settings.input, rows), bins = (fields - settings.class_count) / 4;
  require_shape(last != 0 && bins > 1 && settings.class_count + 4 * bins == fields, "nanodet-plus",
                "1xNx(classes+32) with N cells of strides 8 to 64", {&output, 1});
  for_each_cell(settings.input, last, [&, row_fields = fields](int index, int u, int v, int stride_px) {
    const float* const row = output.data + std::ptrdiff_t{index} * row_fields;
    const BestClass best = best_class(row, settings.class_count);
    if (!(best.score >= settings.lowest_confidence)) return;
    const auto at = [&](int cell) {
      return kNanoDetPlusMiddle.first_px +
             (static_cast<float>(cell) + kNanoDetPlusMiddle.offset) * static_cast<float>(stride_px);
    };
    detail::append_distances(row + settings.class_count, bins, at(u), at(v), stride_px, best, index, found);
  });
}

}  // namespace stillpoint
