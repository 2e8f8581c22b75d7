// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The forms in which networks write down what they have found, and their names.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "stillpoint/core/error.hpp"

namespace stillpoint {

/// N: number of boxes, nc: number of classes. See docs/detectors.md for which network has which.
enum class DetectorLayout : std::uint8_t {
  automatic,            ///< recognised by the outputs' shapes, refused where these fit two
  mask_rcnn,            ///< 1x1xKx7 and Kxncxhxw: `ssd` with a mask for each class
  ssd,                  ///< 1x1xKx7: image, class, score, corners as shares of the input
  yolov7_end2end,       ///< Kx7: image, corners in pixels, class, score
  end2end,              ///< 1xKx6: corners in pixels, score, class (YOLOv10, YOLO26)
  detr,                 ///< 1xQx(nc or nc+1) and 1xQx4: logits, middles and sizes as shares
  labelled_boxes,       ///< Q integers, Qx4 corners in pixels, Q scores (RT-DETR and torchvision, post-processed)
  nanodet,              ///< for strides 8, 16, 32: nx(nc) scores and nx4(r+1) distances
  picodet,              ///< the same with stride 64, and other middles
  nanodet_plus,         ///< 1xNx(nc+4(r+1)), strides 8 to 64
  yolov3,               ///< two to four heads 1x3(5+nc)xhxw or 1x3xhxwx(5+nc); sizes by exp
  yolov4,               ///< the same with YOLOv4's anchors and widened middles
  yolov5,               ///< the same heads; sizes by a square; anchors of YOLOv5
  yolov7,               ///< as `yolov5`; anchors of YOLOv7
  yolo_grid,            ///< 1xNx(5+nc), N = 3 cells: decoded pixels (YOLOv5, YOLOv7 --grid)
  yolox,                ///< 1xNx(5+nc), N = cells: not decoded
  yolox_decoded,        ///< 1xNx(5+nc), N = cells: decoded pixels
  yolov8,               ///< 1x(4+nc)xN: no objectness (YOLOv8, v9, v11)
  yolov8_transposed,    ///< 1xNx(4+nc)
  yolov8_segmentation,  ///< 1x(4+nc+m)xN and prototypes 1xmxhxw
  yolov5_segmentation,  ///< 1xNx(5+nc+m) and prototypes 1xmxhxw
  darknet,              ///< Nx(5+nc), one or more: shares of the input, classes already times objectness
  segmentation,         ///< 1xCxhxw: scores of each class
  label_map,            ///< 1xhxwx1 or 1xhxw: the class of each pixel
};

namespace detail {
constexpr std::array<std::string_view, 24> kLayoutNames = {"automatic",
                                                           "mask-rcnn",
                                                           "ssd",
                                                           "yolov7-end2end",
                                                           "end2end",
                                                           "detr",
                                                           "labelled-boxes",
                                                           "nanodet",
                                                           "picodet",
                                                           "nanodet-plus",
                                                           "yolov3",
                                                           "yolov4",
                                                           "yolov5",
                                                           "yolov7",
                                                           "yolo-grid",
                                                           "yolox",
                                                           "yolox-decoded",
                                                           "yolov8",
                                                           "yolov8-transposed",
                                                           "yolov8-segmentation",
                                                           "yolov5-segmentation",
                                                           "darknet",
                                                           "segmentation",
                                                           "label-map"};
static_assert(kLayoutNames.size() == static_cast<std::size_t>(DetectorLayout::label_map) + 1);
}  // namespace detail

/// As on the command line: "yolov8-transposed".
constexpr std::string_view to_string(DetectorLayout layout) noexcept {
  return detail::kLayoutNames[static_cast<std::size_t>(layout)];
}

/// Whether networks of the layout leave several boxes for one object, for their user to choose from.
constexpr bool leaves_duplicates(DetectorLayout layout) noexcept {
  switch (layout) {
    case DetectorLayout::mask_rcnn:
    case DetectorLayout::ssd:
    case DetectorLayout::yolov7_end2end:
    case DetectorLayout::end2end:
    case DetectorLayout::detr:
    case DetectorLayout::labelled_boxes:
    case DetectorLayout::segmentation:
    case DetectorLayout::label_map: return false;
    default: return true;
  }
}

/// All names but "automatic", between commas.
inline std::string layout_names() {
  std::string names;
  for (std::size_t i = 1; i < detail::kLayoutNames.size(); ++i)
    names.append(i == 1 ? "" : ", ").append(detail::kLayoutNames[i]);
  return names;
}

/// @throws Error that lists the names, if there is no such layout.
inline DetectorLayout layout_from_name(std::string_view name) {
  for (std::size_t i = 0; i < detail::kLayoutNames.size(); ++i)
    if (detail::kLayoutNames[i] == name) return static_cast<DetectorLayout>(i);
  throw Error("detector layout: found '" + std::string(name) + "', expected automatic or one of " + layout_names());
}

}  // namespace stillpoint
