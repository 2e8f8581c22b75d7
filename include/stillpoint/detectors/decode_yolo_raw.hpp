// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Heads of YOLO before they are decoded: convolutions' outputs, one head a stride, some anchors a cell.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

/// A box that a network bends to fit, pixels of the input.
struct Anchor {
  float width = 0, height = 0;
};

/// How the numbers of a head become a box.
struct YoloCoding {
  bool squared = true;          ///< sizes (2p)², middles 2p - 0.5 (YOLOv5, v7); else sizes exp(t), middles p (v3, v4)
  std::vector<float> widened;   ///< factor on the middles, one a head (YOLOv4's scale_x_y); none: 1
  std::vector<Anchor> anchors;  ///< those of the smallest stride first
};

/// The published coding of a family with three heads; a smaller one has anchors of its own, to be set by the user.
/// Anchors: Redmon and Farhadi, "YOLOv3", 2018 (v5 took them over); Bochkovskiy et al., "YOLOv4", 2020 (v7 took them).
inline YoloCoding yolo_coding(DetectorLayout family) {
  const std::vector<Anchor> v3 = {{10, 13},  {16, 30},  {33, 23},   {30, 61},  {62, 45},
                                  {59, 119}, {116, 90}, {156, 198}, {373, 326}};
  const std::vector<Anchor> v4 = {{12, 16},  {19, 36},   {40, 28},   {36, 75},  {76, 55},
                                  {72, 146}, {142, 110}, {192, 243}, {459, 401}};
  switch (family) {
    case DetectorLayout::yolov3: return {false, {}, v3};
    case DetectorLayout::yolov4: return {false, {1.2f, 1.1f, 1.05f}, v4};
    case DetectorLayout::yolov7: return {true, {}, v4};
    default: return {true, {}, v3};
  }
}

namespace detail {

/// A head, whichever way its numbers are ordered: those of a box are `per_field` apart.
struct YoloHead {
  const float* data;
  int anchors, height, width;
  std::ptrdiff_t per_anchor, per_cell, per_field;
};

/// The smallest stride first.
inline std::vector<YoloHead> yolo_heads(span<const Tensor> outputs, int fields) {
  std::vector<YoloHead> heads;
  for (const Tensor& output : outputs) {
    const TensorShape& s = output.shape;
    const bool fields_last = s.rank() == 5;
    require_shape(s[0] == 1 && (fields_last ? s[4] == fields : s.rank() == 4 && s[1] > 0 && s[1] % fields == 0),
                  "yolov3 to yolov7", "heads 1x(A(5+classes))xhxw or 1xAxhxwx(5+classes)", outputs);
    const std::ptrdiff_t cells = std::ptrdiff_t{s[2]} * s[3];
    if (fields_last)
      heads.push_back({output.data, s[1], s[2], s[3], cells * fields, fields, 1});
    else
      heads.push_back({output.data, s[1] / fields, s[2], s[3], cells * fields, 1, cells});
  }
  std::stable_sort(heads.begin(), heads.end(), [](const YoloHead& a, const YoloHead& b) { return a.width > b.width; });
  return heads;
}

/// The boxes of one anchor in all cells.
/// @param widened  factor on the middles
inline void decode_yolo_anchor(const YoloHead& head, int anchor_index, const Anchor& anchor, float widened,
                               bool squared, const DecodeSettings& settings, std::vector<RawDetection>& found) {
  const float stride_x = static_cast<float>(settings.input.width) / static_cast<float>(head.width);
  const float stride_y = static_cast<float>(settings.input.height) / static_cast<float>(head.height);
  const float* cell = head.data + anchor_index * head.per_anchor;
  for (int v = 0; v < head.height; ++v) {
    for (int u = 0; u < head.width; ++u, cell += head.per_cell) {
      const auto field = [&](int k) { return cell[k * head.per_field]; };
      const float objectness = sigmoid(field(4));
      if (!(objectness >= settings.lowest_confidence)) continue;
      const BestClass best = best_class(cell + 5 * head.per_field, settings.class_count, head.per_field);
      const float score = objectness * sigmoid(best.score);
      if (!(score >= settings.lowest_confidence)) continue;
      const auto middle = [&](int k, int g) {
        return widened * sigmoid(field(k)) - 0.5f * (widened - 1.0f) + static_cast<float>(g);
      };
      const auto size = [&](int k, float of_anchor) {
        const float twice = 2.0f * sigmoid(field(k));
        return (squared ? twice * twice : std::exp(field(k))) * of_anchor;
      };
      append_centred(found, middle(0, u) * stride_x, middle(1, v) * stride_y, size(2, anchor.width),
                     size(3, anchor.height), score, best.label, RawDetection::kNoSource);
    }
  }
}

}  // namespace detail

/// Decodes heads 1x(A(5+nc))xhxw or 1xAxhxwx(5+nc), in any order.
/// @throws Error on other shapes, or when there is not one anchor for each box of a cell.
inline void decode_yolo_raw(span<const Tensor> outputs, const DecodeSettings& settings, const YoloCoding& coding,
                            std::vector<RawDetection>& found) {
  const std::vector<detail::YoloHead> heads = detail::yolo_heads(outputs, 5 + settings.class_count);
  std::size_t anchors = 0;
  for (const detail::YoloHead& head : heads) anchors += static_cast<std::size_t>(head.anchors);
  if (anchors != coding.anchors.size())
    throw Error("anchors: found " + std::to_string(coding.anchors.size()) + ", expected " + std::to_string(anchors) +
                " for outputs " + describe(outputs));
  std::size_t anchor = 0;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    const float widened = coding.squared ? 2.0f : h < coding.widened.size() ? coding.widened[h] : 1.0f;
    for (int a = 0; a < heads[h].anchors; ++a)
      detail::decode_yolo_anchor(heads[h], a, coding.anchors[anchor++], widened, coding.squared, settings, found);
  }
}

}  // namespace stillpoint
