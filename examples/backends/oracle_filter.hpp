// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter that looks at the answer: drops what a label image calls a mover. A yardstick, not a filter.

#include <cmath>
#include <cstdint>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/keypoint.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/feature_score.hpp"

namespace examples {

/// Drops keypoints whose rounded pixel is labelled as a mover, whether it moves now (255) or is parked (128). All
/// others are kept, those outside the image or on its ignored rim (64) too.
class OracleFilter {
 public:
  stillpoint::ImageView labels;  ///< 8 bit, of the frame that is filtered next; empty keeps everything

  /// Flags of one frame. They belong to the filter and hold until its next frame.
  struct Result {
    stillpoint::span<const std::uint8_t> flags;
    stillpoint::span<const std::uint8_t> keep() const noexcept { return flags; }
  };

  template <class Keypoints>
  Result filter_frame(const stillpoint::FrameView&, const Keypoints& keypoints) {
    keep_.clear();
    for (const auto& keypoint : keypoints) keep_.push_back(stands_still(pixel_of(keypoint)) ? 1 : 0);
    return {keep_};
  }

 private:
  template <class Keypoint>
  static stillpoint::Vector2f pixel_of(const Keypoint& keypoint) {
    return stillpoint::keypoint_traits<Keypoint>::pixel(keypoint);
  }

  bool stands_still(const stillpoint::Vector2f& pixel) const {
    if (!pixel.allFinite()) return true;
    const auto u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (!labels.contains(u, v)) return true;
    const auto label = static_cast<stillpoint::PixelLabel>(labels.row<std::uint8_t>(v)[u]);
    return label != stillpoint::PixelLabel::moving && label != stillpoint::PixelLabel::parked;
  }

  std::vector<std::uint8_t> keep_;
};

}  // namespace examples
