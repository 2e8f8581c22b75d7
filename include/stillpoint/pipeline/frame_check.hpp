// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which frames can be judged at all, before any stage sees them.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/status.hpp"

namespace stillpoint {

/// Names what is wrong with a frame. It never throws.
struct FrameCheck {
  struct Options {
    double longest_gap_s = 1.0;  ///< a longer time since the last frame is a `time_gap`; matching would fail anyway
  };
  Options options;

  /// @param last_timestamp_s of the frame before, nothing for the first
  template <class Camera>
  Status operator()(const FrameView& frame, std::optional<double> last_timestamp_s,
                    const Camera& camera) const noexcept {
    const ImageView& image = frame.image();
    if (image.empty()) return Status::no_image;
    if (!frame.gray.empty() && frame.gray.format != PixelFormat::gray8) return Status::unsupported_image;
    if (!frame.colour.empty() && frame.colour.format != PixelFormat::bgr8) return Status::unsupported_image;
    const PixelFormat depth = frame.depth.image.format;
    const bool is_raw = depth == PixelFormat::depth16;
    if (!frame.depth.empty() && !is_raw && depth != PixelFormat::depth32f) return Status::unsupported_image;
    for (const ImageView* view : {&frame.gray, &frame.colour, &frame.depth.image})
      if (!view->empty() && !has_whole_rows(*view)) return Status::unsupported_image;
    if (!frame.depth.empty() && is_raw && !DepthView::is_unit(frame.depth.factor)) return Status::depth_unit_missing;
    for (const ImageView* view : {&frame.gray, &frame.colour})
      if (!view->empty() && !has_size(*view, camera)) return Status::size_changed;
    if (!(std::abs(frame.timestamp_s) < kLatest_s)) return Status::invalid_time;
    if (half_beyond_a_kilometre(frame.depth)) return Status::implausible_depth;
    if (!last_timestamp_s) return Status::first_frame;
    if (frame.timestamp_s == *last_timestamp_s) return Status::duplicate_frame;
    if (frame.timestamp_s < *last_timestamp_s) return Status::out_of_order;
    if (frame.timestamp_s - *last_timestamp_s > options.longest_gap_s) return Status::time_gap;
    return Status::ok;
  }

  /// Whether an image is of the camera's size.
  template <class Camera>
  static bool has_size(const ImageView& image, const Camera& camera) noexcept {
    return image.width == camera.width() && image.height == camera.height();
  }

  /// Such a frame is no frame: it leaves the filter as it was.
  static constexpr bool rejects(Status status) noexcept {
    return status == Status::no_image || status == Status::unsupported_image || status == Status::depth_unit_missing ||
           status == Status::implausible_depth || status == Status::size_changed || status == Status::invalid_time ||
           status == Status::invalid_options || status == Status::duplicate_frame;
  }

 private:
  /// A stride in pixels instead of bytes makes rows overlap; a pixel of 16 or 32 bit lies at an address of its own
  /// size.
  static bool has_whole_rows(const ImageView& image) noexcept {
    const std::size_t pixel = bytes_per_pixel(image.format), alignment = image.format == PixelFormat::bgr8 ? 1 : pixel;
    return image.stride_bytes / pixel >= static_cast<std::size_t>(image.width) && image.stride_bytes % alignment == 0 &&
           reinterpret_cast<std::uintptr_t>(image.data) % alignment == 0;
  }

  static constexpr double kLatest_s = 1e11;  // the year 5138; nanoseconds since 1970 are 10 million times that

  /// Looks at some hundred pixels.
  static bool half_beyond_a_kilometre(const DepthView& depth) noexcept {
    constexpr int kSamples = 16;  // a side
    constexpr float kFarthest_m = 1000.0f;
    int known = 0, beyond = 0;
    if (depth.empty()) return false;
    for (int row = 0; row < kSamples; ++row) {
      for (int column = 0; column < kSamples; ++column) {
        const float depth_m = depth.metres((2 * column + 1) * depth.image.width / (2 * kSamples),
                                           (2 * row + 1) * depth.image.height / (2 * kSamples));
        known += depth_m > 0;
        beyond += depth_m > kFarthest_m;
      }
    }
    return 2 * beyond > known;
  }
};

template <class Visit>
void each_option(FrameCheck& stage, Visit& visit) {
  visit("longest_gap_s", stage.options.longest_gap_s, OptionRange{1e-3, 3600});
}

}  // namespace stillpoint
