// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is done to an image's values before a network sees them, and what each family was trained with.

#include <array>

#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/letterbox.hpp"

namespace stillpoint {

/// A value of the input is (value of the image, 0 to 255, minus `mean`) times `scale`, in the network's order of
/// channels.
struct Preprocess {
  ImageFit fit = ImageFit::stretch;
  bool rgb = true;  ///< red first; else blue first
  std::array<float, 3> mean = {0, 0, 0};
  std::array<float, 3> scale = {1, 1, 1};
  float padding = 114;  ///< value of the bars of a letterbox, before mean and scale
};

/// What the networks of a layout are usually fed with. A network trained otherwise needs `DetectorOptions::preprocess`:
/// SSD and segmentation above all, for which there is no custom.
inline Preprocess usual_preprocess(DetectorLayout layout) noexcept {
  constexpr float kUnit = 1.0f / 255.0f;
  constexpr std::array<float, 3> kToUnit = {kUnit, kUnit, kUnit};
  // ImageNet's mean, and one over its spread, red first.
  constexpr std::array<float, 3> kMean = {123.675f, 116.28f, 103.53f};
  constexpr std::array<float, 3> kPerSpread = {1 / 58.395f, 1 / 57.12f, 1 / 57.375f};
  switch (layout) {
    case DetectorLayout::yolox:
    case DetectorLayout::yolox_decoded: return {ImageFit::letterbox_top_left, false};
    case DetectorLayout::nanodet:
    case DetectorLayout::nanodet_plus:
      return {ImageFit::letterbox_centred,
              false,
              {kMean[2], kMean[1], kMean[0]},
              {kPerSpread[2], kPerSpread[1], kPerSpread[0]},
              0};
    case DetectorLayout::picodet: return {ImageFit::stretch, true, kMean, kPerSpread};
    case DetectorLayout::ssd:
    case DetectorLayout::mask_rcnn: return {ImageFit::stretch, true};  // TensorFlow's zoo: the graph does the rest
    case DetectorLayout::yolov3:
    case DetectorLayout::yolov4:
    case DetectorLayout::darknet:
    case DetectorLayout::detr:
    case DetectorLayout::labelled_boxes:
    case DetectorLayout::segmentation:
    case DetectorLayout::label_map: return {ImageFit::stretch, true, {0, 0, 0}, kToUnit};
    default: return {ImageFit::letterbox_centred, true, {0, 0, 0}, kToUnit};
  }
}

}  // namespace stillpoint
