// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Segmentation: a class for each pixel. Each connected part of a class becomes a box with a mask.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// A class and how sure of it the network is, for each cell; row by row.
struct LabelMap {
  static constexpr std::int16_t kNothing = -1;
  int columns = 0, rows = 0;
  std::vector<std::int16_t> label;
  std::vector<float> score;

  bool contains(int u, int v) const noexcept { return u >= 0 && v >= 0 && u < columns && v < rows; }
  std::size_t index(int u, int v) const noexcept {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(u);
  }
};

/// The classes of scores 1xCxhxw. C == 1 or 2: one class, 0, where it passes one half (C == 2: against the background
/// in channel 0). C == nc: the best channel; C == nc + 1: the same, with the background in channel 0, which the class
/// list does not have. Values far outside 0 to 1 are logarithms: sigmoid or softmax first. An enlarged map leaves 0 to
/// 1 by rounding, or by the overshoot of a cubic. A cell of NaN has no class.
inline LabelMap label_map_from_scores(const Tensor& output, const DecodeSettings& settings) {
  const TensorShape& shape = output.shape;
  require_shape(
      shape.rank() == 4 && shape[0] == 1 &&
          (shape[1] == 1 || shape[1] == 2 || shape[1] == settings.class_count || shape[1] == settings.class_count + 1),
      "segmentation", "1xCxhxw with C of 1, 2, classes or classes+1", {&output, 1});
  const int channels = shape[1];
  LabelMap map{shape[3], shape[2], {}, {}};
  const std::size_t cells = static_cast<std::size_t>(shape[2]) * static_cast<std::size_t>(shape[3]);
  constexpr float kOvershoot = 0.25f;
  const bool probabilities = std::none_of(output.data, output.data + shape.count(),
                                          [](float value) { return value < -kOvershoot || value > 1.0f + kOvershoot; });
  map.label.assign(cells, LabelMap::kNothing);
  map.score.assign(cells, 0.0f);
  for (std::size_t i = 0; i < cells; ++i) {
    const float* const scores = output.data + i;
    const auto channel = [&](int c) { return scores[static_cast<std::size_t>(c) * cells]; };
    if (channels <= 2) {
      const float value = channels == 1 ? channel(0) : probabilities ? channel(1) : channel(1) - channel(0);
      map.score[i] = probabilities ? std::min(value, 1.0f) : sigmoid(value);
      if (map.score[i] > 0.5f) map.label[i] = 0;
      continue;
    }
    const BestClass best = best_class(scores, channels, static_cast<std::ptrdiff_t>(cells));
    map.score[i] = std::min(best.score, 1.0f);
    if (!probabilities) {
      float sum = 0;
      for (int c = 0; c < channels; ++c) sum += std::exp(channel(c) - best.score);
      map.score[i] = 1.0f / sum;
    }
    if (!std::isnan(map.score[i]))
      map.label[i] = static_cast<std::int16_t>(channels == settings.class_count ? best.label : best.label - 1);
  }
  return map;
}

/// The classes of 1xhxwx1 or 1xhxw integers, all of them certain.
inline LabelMap label_map_from_labels(const Tensor& output) {
  const TensorShape& shape = output.shape;
  require_shape((shape.rank() == 3 || (shape.rank() == 4 && shape[3] == 1)) && shape[0] == 1, "label-map",
                "1xhxwx1 or 1xhxw", {&output, 1});
  LabelMap map{shape[2], shape[1], {}, {}};
  map.label.reserve(shape.count());
  for (const float value : span<const float>(output.data, shape.count()))
    map.label.push_back(static_cast<std::int16_t>(std::min(label_of(value), int{INT16_MAX})));
  map.score.assign(shape.count(), 1.0f);
  return map;
}

namespace detail {

/// Cells of one class that touch at their edges.
struct ConnectedPart {
  std::vector<std::pair<int, int>> cells;  ///< columns and rows
  int left = 0, top = 0, right = 0, bottom = 0;
  double mean_score = 0;
};

/// The part that a cell belongs to; marks its cells as seen.
inline void grow_part(const LabelMap& map, int column, int row, std::vector<std::uint8_t>& seen, ConnectedPart& part) {
  const std::int16_t label = map.label[map.index(column, row)];
  part.cells.clear();
  part.left = part.right = column;
  part.top = part.bottom = row;
  const auto visit = [&](int u, int v) {
    if (!map.contains(u, v) || map.label[map.index(u, v)] != label || seen[map.index(u, v)] != 0) return;
    seen[map.index(u, v)] = 1;
    part.cells.emplace_back(u, v);
  };
  visit(column, row);
  double sum = 0;
  for (std::size_t i = 0; i < part.cells.size(); ++i) {  // grows while it is walked through
    const auto [u, v] = part.cells[i];
    part.left = std::min(part.left, u);
    part.right = std::max(part.right, u);
    part.top = std::min(part.top, v);
    part.bottom = std::max(part.bottom, v);
    sum += static_cast<double>(map.score[map.index(u, v)]);
    visit(u - 1, v);
    visit(u + 1, v);
    visit(u, v - 1);
    visit(u, v + 1);
  }
  part.mean_score = sum / static_cast<double>(part.cells.size());
}

inline std::shared_ptr<const BoxMask> mask_of(const ConnectedPart& part) {
  auto mask = std::make_shared<BoxMask>();
  mask->columns = part.right - part.left + 1;
  mask->rows = part.bottom - part.top + 1;
  const auto columns = static_cast<std::size_t>(mask->columns);
  mask->inside.assign(columns * static_cast<std::size_t>(mask->rows), 0);
  for (const auto& [u, v] : part.cells)
    mask->inside[static_cast<std::size_t>(v - part.top) * columns + static_cast<std::size_t>(u - part.left)] = 1;
  return mask;
}

}  // namespace detail

/// Appends a box with a mask for each part of a class whose cells touch at an edge; its score is the mean over them.
/// Time linear in the cells.
/// @param smallest_share  of the image; what is smaller is left out
inline void append_parts(const LabelMap& map, const DecodeSettings& settings, float smallest_share,
                         std::vector<RawDetection>& found) {
  const float px_per_column = static_cast<float>(settings.input.width) / static_cast<float>(map.columns);
  const float px_per_row = static_cast<float>(settings.input.height) / static_cast<float>(map.rows);
  const double smallest = static_cast<double>(smallest_share) * map.columns * map.rows;
  std::vector<std::uint8_t> seen(map.label.size(), 0);
  detail::ConnectedPart part;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const std::int16_t label = map.label[map.index(column, row)];
      if (label == LabelMap::kNothing || seen[map.index(column, row)] != 0) continue;
      detail::grow_part(map, column, row, seen, part);
      const auto score = static_cast<float>(part.mean_score);
      if (static_cast<double>(part.cells.size()) < smallest || !(score >= settings.lowest_confidence)) continue;
      found.push_back({static_cast<float>(part.left) * px_per_column, static_cast<float>(part.top) * px_per_row,
                       static_cast<float>(part.right + 1) * px_per_column,
                       static_cast<float>(part.bottom + 1) * px_per_row, score, label, RawDetection::kNoSource,
                       detail::mask_of(part)});
    }
  }
}

}  // namespace stillpoint
