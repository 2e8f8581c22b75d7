// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a host hands to the filter for one moment in time. Owns nothing.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// A depth image and how to read it. Metres; 0 or non-finite means no depth.
struct DepthView {
  ImageView image;
  double factor = 5000.0;  ///< units of a 16-bit image per metre (TUM: 5000); not used for float images

  DepthView() = default;
  template <class Image, class = decltype(ImageView(std::declval<const Image&>()))>
  DepthView(const Image& depth, double units_per_metre = 5000.0) : image(depth), factor(units_per_metre) {}

  bool empty() const noexcept { return image.empty(); }

  /// Depth in metres at a pixel of the depth image, 0 where there is none.
  float metres(int u, int v) const noexcept {
    return image.format == PixelFormat::depth16 ? metres(image.row<std::uint16_t>(v)[u])
                                                : metres(image.row<float>(v)[u]);
  }

  /// What the image holds, in metres.
  float metres(std::uint16_t raw) const noexcept { return static_cast<float>(raw / factor); }
  static float metres(float value_m) noexcept { return std::isfinite(value_m) && value_m > 0.0f ? value_m : 0.0f; }
};

/// One frame. All views must stay alive during `filter_frame` and may die after it.
struct FrameView {
  ImageView gray;            ///< 8 bit; may be empty when `colour` is given: the filter makes gray of it
  ImageView colour;          ///< BGR, optional: for a prior that needs it
  DepthView depth;           ///< optional; another size than the image is fine when the field of view is the same
  double timestamp_s = 0.0;  ///< seconds, growing from frame to frame

  FrameView() = default;

  /// @param image    gray or BGR, 8 bit
  /// @param depth_view  16 bit with a factor, or float metres; an empty image where there is none
  /// @param timestamp seconds
  template <class Image, class = decltype(ImageView(std::declval<const Image&>()))>
  FrameView(const Image& image, const DepthView& depth_view, double timestamp)
      : depth(depth_view), timestamp_s(timestamp) {
    const ImageView view(image);
    (view.format == PixelFormat::bgr8 ? colour : gray) = view;
  }

  /// The image that gives the frame its size.
  const ImageView& image() const noexcept { return gray.empty() ? colour : gray; }
};

/// The frame, with gray made of its colour where the host gave none.
/// @param gray  where it is made; must outlive the view
inline FrameView with_gray(FrameView frame, ImageBuffer& gray) {
  if (frame.gray.empty()) {
    gray_from_bgr(frame.colour, gray);
    frame.gray = gray.view();
  }
  return frame;
}

}  // namespace stillpoint
