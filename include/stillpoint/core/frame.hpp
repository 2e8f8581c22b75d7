// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a host hands to the filter for one moment in time. Owns nothing.

#include <cmath>
#include <cstdint>
#include <utility>

#include "stillpoint/core/image.hpp"

namespace stillpoint {

/// A depth image and how to read it. Metres; 0 or non-finite means no depth.
struct DepthView {
  ImageView image;
  /// Units of a 16-bit image per metre; 0: nobody said, and a frame with a 16-bit image is `depth_unit_missing`. Not
  /// used for float images.
  double factor = 0.0;

  /// The coarsest and the finest unit of 16-bit depth: kilometres and micrometres.
  static constexpr double kLeastFactor = 1e-3, kMostFactor = 1e6;
  static constexpr bool is_unit(double units_per_metre) noexcept {
    return units_per_metre >= kLeastFactor && units_per_metre <= kMostFactor;  // false for NaN
  }

  DepthView() = default;

  /// Of a float image in metres; of a 16-bit one with what `units_per_metre` says.
  template <class Image, class = decltype(ImageView(std::declval<const Image&>()))>
  DepthView(const Image& depth, double units_per_metre = 0.0) : image(depth), factor(units_per_metre) {}

  /// 16 bit in millimetres: ROS, RealSense, Azure Kinect, OAK, Orbbec.
  template <class Image>
  static DepthView millimetres(const Image& depth) {
    return DepthView(depth, 1000.0);
  }

  /// 16 bit in the unit of the TUM and Bonn benchmarks, a fifth of a millimetre.
  template <class Image>
  static DepthView tum(const Image& depth) {
    return DepthView(depth, 5000.0);
  }

  bool empty() const noexcept { return image.empty(); }

  /// Depth in metres at a pixel of the depth image, 0 where there is none.
  float metres(int u, int v) const noexcept {
    return image.format == PixelFormat::depth16 ? metres(image.row<std::uint16_t>(v)[u])
                                                : metres(image.row<float>(v)[u]);
  }

  /// Of a pixel of the depth image.
  bool has_depth(int u, int v) const noexcept {
    return image.format == PixelFormat::depth16 ? is_depth(image.row<std::uint16_t>(v)[u])
                                                : is_depth(image.row<float>(v)[u]);
  }

  /// Whether a pixel has a depth: not 0, and not NaN or infinite.
  static bool is_depth(std::uint16_t raw) noexcept { return raw > 0; }
  static bool is_depth(float value_m) noexcept { return std::isfinite(value_m) && value_m > 0.0f; }

  /// What the image holds, in metres.
  float metres(std::uint16_t raw) const noexcept { return static_cast<float>(raw / factor); }
  static float metres(float value_m) noexcept { return is_depth(value_m) ? value_m : 0.0f; }
};

/// One frame. All views must stay alive during `filter_frame` and may die after it.
struct FrameView {
  ImageView gray;            ///< 8 bit; may be empty when `colour` is given: the filter makes gray of it
  ImageView colour;          ///< BGR, optional: for a prior that needs it
  DepthView depth;           ///< optional; another size than the image is fine when the field of view is the same
  double timestamp_s = 0.0;  ///< seconds, growing from frame to frame

  FrameView() = default;

  /// @param image    gray or BGR, 8 bit
  /// @param depth_view  float metres, or 16 bit with its unit (`DepthView::millimetres`); an empty image where there is
  /// none
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
