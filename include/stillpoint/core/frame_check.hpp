// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which frames can be judged at all, before any stage sees them.

#include <cmath>
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
    const bool depth_readable =
        depth == PixelFormat::depth32f || (depth == PixelFormat::depth16 && frame.depth.factor > 0);
    if (!frame.depth.empty() && !depth_readable) return Status::unsupported_image;
    const auto other_size = [&camera](const ImageView& view) {
      return !view.empty() && (view.width != camera.width() || view.height != camera.height());
    };
    if (other_size(frame.gray) || other_size(frame.colour)) return Status::size_changed;
    if (!std::isfinite(frame.timestamp_s)) return Status::invalid_time;
    if (!last_timestamp_s) return Status::first_frame;
    if (frame.timestamp_s == *last_timestamp_s) return Status::duplicate_frame;
    if (frame.timestamp_s < *last_timestamp_s) return Status::out_of_order;
    if (frame.timestamp_s - *last_timestamp_s > options.longest_gap_s) return Status::time_gap;
    return Status::ok;
  }

  /// Such a frame is no frame: it leaves the filter as it was.
  static constexpr bool rejects(Status status) noexcept {
    return status == Status::no_image || status == Status::unsupported_image || status == Status::size_changed ||
           status == Status::invalid_time || status == Status::invalid_options || status == Status::duplicate_frame;
  }
};

template <class Visit>
void each_option(FrameCheck& stage, Visit& visit) {
  visit("longest_gap_s", stage.options.longest_gap_s, OptionRange{1e-3, 3600});
}

}  // namespace stillpoint
