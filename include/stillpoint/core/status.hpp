// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What can be said of a frame as a whole.

#include <cstddef>
#include <cstdint>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// Every status but `ok` means: this frame was not judged, all features are kept (fail open).
enum class Status : std::uint8_t {
  ok,
  first_frame,          ///< nothing to compare with yet: after construction or `reset()`
  no_image,             ///< empty image; the filter's state is untouched
  unsupported_image,    ///< not 8-bit gray or BGR, depth neither 16 bit nor float, or rows too short; state
                        ///< untouched
  depth_unit_missing,   ///< 16-bit depth of which nobody says what a metre is (`DepthView::millimetres`); state
                        ///< untouched
  implausible_depth,    ///< half of the depths lie beyond a kilometre: millimetres taken for metres? State untouched
  size_changed,         ///< the image is not of the camera's size; state untouched
  invalid_time,         ///< the time stamp is not finite, or beyond any date in seconds (nanoseconds?); state untouched
  invalid_options,      ///< an option is out of its range, `options_error()` says which; state untouched
  duplicate_frame,      ///< same time stamp as the last frame; state untouched
  out_of_order,         ///< time runs backwards: everything is forgotten, this frame is the new reference
  time_gap,             ///< too long since the last frame: everything is forgotten, this frame is the new reference
  no_keypoints,         ///< nothing to judge; the stages go on by corners of their own, where they have any
  no_depth,             ///< no usable depth in this frame or the last, and the ego-motion needs it
  too_few_matches,      ///< fewer matches than the ego-motion needs
  degenerate_geometry,  ///< the matches do not determine a motion (one point, one line, one plane for F)
  no_consensus,         ///< no motion explains enough of the matches, or the frames contradict it
};

constexpr std::size_t kStatusCount = static_cast<std::size_t>(Status::no_consensus) + 1;

/// True where the frame was judged: verdicts are verdicts, not the fail-open default.
constexpr bool judged(Status status) noexcept { return status == Status::ok; }

/// The status as it is written in files.
constexpr const char* to_string(Status status) noexcept {
  switch (status) {
    case Status::ok: return "ok";
    case Status::first_frame: return "first_frame";
    case Status::no_image: return "no_image";
    case Status::unsupported_image: return "unsupported_image";
    case Status::depth_unit_missing: return "depth_unit_missing";
    case Status::implausible_depth: return "implausible_depth";
    case Status::size_changed: return "size_changed";
    case Status::invalid_time: return "invalid_time";
    case Status::invalid_options: return "invalid_options";
    case Status::duplicate_frame: return "duplicate_frame";
    case Status::out_of_order: return "out_of_order";
    case Status::time_gap: return "time_gap";
    case Status::no_keypoints: return "no_keypoints";
    case Status::no_depth: return "no_depth";
    case Status::too_few_matches: return "too_few_matches";
    case Status::degenerate_geometry: return "degenerate_geometry";
    case Status::no_consensus: return "no_consensus";
  }
  return "?";
}

}  // namespace stillpoint
