// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which layout is it?   Shapes of the outputs, size of the input, number of classes → layout.   Rank, divisibility and
// the number of cells settle most; what they do not settle is refused, not guessed.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/cells.hpp"
#include "stillpoint/detectors/decode_detr.hpp"
#include "stillpoint/detectors/decode_nanodet.hpp"
#include "stillpoint/detectors/decode_yolo_grid.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/raw_detection.hpp"
#include "stillpoint/detectors/tensor.hpp"

namespace stillpoint {

/// YOLO's segmentation variants: the boxes and the prototypes among two outputs, in either order.
struct BoxesAndPrototypes {
  const Tensor *boxes = nullptr, *prototypes = nullptr;
  explicit operator bool() const noexcept { return boxes != nullptr && prototypes != nullptr; }
};

inline BoxesAndPrototypes find_prototypes(span<const Tensor> outputs) noexcept {
  BoxesAndPrototypes found;
  if (outputs.size() != 2) return found;
  for (const Tensor& output : outputs) {
    if (output.shape.rank() == 4 && output.shape[0] == 1) found.prototypes = &output;
    if (output.shape.rank() == 3 && output.shape[0] == 1) found.boxes = &output;
  }
  return found;
}

/// Mask R-CNN's boxes 1x1xKx7 and masks Kxnxhxw, in either order.
struct BoxesAndMasks {
  const Tensor *boxes = nullptr, *masks = nullptr;
  explicit operator bool() const noexcept { return boxes != nullptr && masks != nullptr; }
};

inline BoxesAndMasks find_class_masks(span<const Tensor> outputs) noexcept {
  BoxesAndMasks found;
  if (outputs.size() != 2) return found;
  for (const Tensor& output : outputs) {
    const TensorShape& s = output.shape;
    if (s.rank() == 4) (s[0] == 1 && s[1] == 1 && s[3] == 7 ? found.boxes : found.masks) = &output;
  }
  if (found && found.boxes->shape[2] != found.masks->shape[0]) return {};
  return found;
}

namespace detail {

inline bool is_yolo_heads(span<const Tensor> outputs, const InputSize& input, int class_count) {
  if (outputs.size() < 2 || outputs.size() > 4) return false;
  const int fields = 5 + class_count;
  std::vector<int> strides;
  for (const Tensor& output : outputs) {
    const TensorShape& s = output.shape;
    const bool fields_last = s.rank() == 5 && s[1] == 3 && s[4] == fields;
    if (!fields_last && !(s.rank() == 4 && s[1] == 3 * fields)) return false;
    if (s[0] != 1 || s[3] <= 0) return false;
    const int stride_px = input.width / s[3];
    for (const int other : strides)
      if (other == stride_px) return false;
    if (stride_px < 8 || s[2] != cells_along(input.height, stride_px) || s[3] != cells_along(input.width, stride_px))
      return false;
    strides.push_back(stride_px);
  }
  return true;
}

inline bool is_nanodet(span<const Tensor> outputs, const InputSize& input, int class_count, std::size_t strides) {
  if (outputs.size() != 2 * strides) return false;
  for (std::size_t i = 0; i < strides; ++i) {
    const int cells = cells_of(input, 8 << i);
    if (find_distance_head(outputs, cells, class_count, false) == nullptr ||
        find_distance_head(outputs, cells, class_count, true) == nullptr)
      return false;
  }
  return true;
}

inline bool is_darknet(span<const Tensor> outputs, const InputSize& input, int class_count) {
  for (const Tensor& output : outputs) {
    if (output.shape.rank() != 2 || output.shape[1] != 5 + class_count) return false;
    bool fits_a_stride = false;
    for (const int stride_px : {8, 16, 32})  // three anchors a cell, five with YOLOv2
      fits_a_stride = fits_a_stride || output.shape[0] == 3 * cells_of(input, stride_px) ||
                      output.shape[0] == 5 * cells_of(input, stride_px);
    if (!fits_a_stride) return false;
  }
  return !outputs.empty();
}

/// Three anchors for each cell of strides 8 to 32, to 64, or of 16 and 32 (the tiny ones of v3).
inline bool is_three_a_cell(const InputSize& input, int boxes) {
  return (boxes % 3 == 0 && last_stride(input, boxes / 3) != 0) ||
         boxes == 3 * (cells_of(input, 16) + cells_of(input, 32));
}

/// An image, not a list: K x 7 is no image.
inline bool is_image(int rows, int columns) noexcept { return rows >= 8 && columns >= 8; }

}  // namespace detail

/// Whether outputs may be of a layout. Looks at shapes, and at values only to tell YOLOX decoded from undecoded.
inline bool fits_layout(DetectorLayout layout, span<const Tensor> outputs, const InputSize& input, int class_count) {
  if (outputs.empty()) return false;
  const TensorShape& s = outputs[0].shape;
  const int nc = class_count;
  const bool one_list = outputs.size() == 1 && s.rank() == 3 && s[0] == 1;
  const bool one_image = outputs.size() == 1 && s.rank() == 4 && s[0] == 1;
  const auto mask_fields = [&](const BoxesAndPrototypes& parts) { return parts.prototypes->shape[1]; };
  switch (layout) {
    case DetectorLayout::mask_rcnn: {
      const BoxesAndMasks parts = find_class_masks(outputs);
      const int channels = parts ? parts.masks->shape[1] : 0;
      return parts && channels >= nc - 1 && channels <= nc + 1;
    }
    case DetectorLayout::ssd: return one_image && s[1] == 1 && s[3] == 7;
    case DetectorLayout::yolov7_end2end: return outputs.size() == 1 && s.rank() == 2 && s[1] == 7;
    case DetectorLayout::end2end: return one_list && s[1] <= 1000 && s[2] == 6;
    case DetectorLayout::detr:  // a box for each cell would be something else
      return find_queries(outputs, nc) && last_stride(input, s[1]) == 0;
    case DetectorLayout::labelled_boxes: return find_labelled_boxes(outputs).complete();
    case DetectorLayout::nanodet: return detail::is_nanodet(outputs, input, nc, 3);
    case DetectorLayout::picodet: return detail::is_nanodet(outputs, input, nc, 4);
    case DetectorLayout::nanodet_plus: return one_list && s[1] == cells_up_to(input, 64) && s[2] == nc + 32;
    case DetectorLayout::yolov3:
    case DetectorLayout::yolov4:
    case DetectorLayout::yolov5:
    case DetectorLayout::yolov7: return detail::is_yolo_heads(outputs, input, nc);
    case DetectorLayout::yolo_grid: return one_list && s[2] == 5 + nc && detail::is_three_a_cell(input, s[1]);
    case DetectorLayout::yolox:
    case DetectorLayout::yolox_decoded:
      return one_list && s[2] == 5 + nc && last_stride(input, s[1]) != 0 &&
             yolox_is_undecoded(outputs[0]) == (layout == DetectorLayout::yolox);
    case DetectorLayout::yolov8: return one_list && s[1] == 4 + nc && last_stride(input, s[2]) != 0;
    case DetectorLayout::yolov8_transposed: return one_list && s[2] == 4 + nc && last_stride(input, s[1]) != 0;
    case DetectorLayout::yolov8_segmentation: {
      const BoxesAndPrototypes parts = find_prototypes(outputs);
      return parts && parts.boxes->shape[1] == 4 + nc + mask_fields(parts) &&
             last_stride(input, parts.boxes->shape[2]) != 0;
    }
    case DetectorLayout::yolov5_segmentation: {
      const BoxesAndPrototypes parts = find_prototypes(outputs);
      return parts && parts.boxes->shape[2] == 5 + nc + mask_fields(parts) &&
             detail::is_three_a_cell(input, parts.boxes->shape[1]);
    }
    case DetectorLayout::darknet: return detail::is_darknet(outputs, input, nc);
    case DetectorLayout::segmentation:
      return one_image && detail::is_image(s[2], s[3]) && (s[1] <= 2 || s[1] == nc || s[1] == nc + 1);
    case DetectorLayout::label_map:
      return outputs.size() == 1 && s[0] == 1 &&
             ((s.rank() == 4 && s[3] == 1 && detail::is_image(s[1], s[2])) ||
              (s.rank() == 3 && outputs[0].whole_numbers && detail::is_image(s[1], s[2])));
    default: return false;
  }
}

/// All layouts that the outputs may be of.
inline std::vector<DetectorLayout> fitting_layouts(span<const Tensor> outputs, const InputSize& input,
                                                   int class_count) {
  std::vector<DetectorLayout> layouts;
  for (auto i = static_cast<int>(DetectorLayout::automatic) + 1; i <= static_cast<int>(DetectorLayout::label_map); ++i)
    if (fits_layout(static_cast<DetectorLayout>(i), outputs, input, class_count))
      layouts.push_back(static_cast<DetectorLayout>(i));
  return layouts;
}

/// "yolov3, yolov5".
inline std::string layout_names(span<const DetectorLayout> layouts) {
  std::string names;
  for (const DetectorLayout layout : layouts) names.append(names.empty() ? "" : ", ").append(to_string(layout));
  return names;
}

/// @throws Error that lists the shapes, if they fit no layout, or the layouts to choose from, if they fit several.
inline DetectorLayout recognise_layout(span<const Tensor> outputs, const InputSize& input, int class_count) {
  const std::vector<DetectorLayout> fitting = fitting_layouts(outputs, input, class_count);
  if (fitting.size() == 1) return fitting.front();
  const std::string seen = "outputs " + describe(outputs) + " with an input of " + std::to_string(input.width) + "x" +
                           std::to_string(input.height) + " and " + std::to_string(class_count) + " classes";
  if (fitting.empty())
    throw Error(seen + " fit no layout; check the input size and the class list, or set one of " + layout_names());
  throw Error(seen + " fit more than one layout; set one of " + layout_names(fitting));
}

}  // namespace stillpoint
