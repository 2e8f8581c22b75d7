// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which frames can be judged at all, before any stage sees them.

#include <cmath>
#include <optional>

#include "stillpoint/core/frame.hpp"
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
    const bool depth_readable =
        depth == PixelFormat::depth32f || (depth == PixelFormat::depth16 && frame.depth.factor > 0);
    if (!frame.depth.empty() && !depth_readable) return Status::unsupported_image;
    for (const ImageView* view : {&frame.gray, &frame.colour})
      if (!view->empty() && !has_size(*view, camera)) return Status::size_changed;
    if (!std::isfinite(frame.timestamp_s)) return Status::invalid_time;
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
    return status == Status::no_image || status == Status::unsupported_image || status == Status::size_changed ||
           status == Status::invalid_time || status == Status::duplicate_frame;
  }
};

}  // namespace stillpoint
