// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What can be said of a frame as a whole.

#include <cstdint>

namespace stillpoint {

/// Every status but `ok` and the three warnings means: this frame was not judged, all features are kept (fail open).
enum class Status : std::uint8_t {
  ok,
  first_frame,          ///< nothing to compare with yet: after construction or `reset()`
  no_image,             ///< empty image; the filter's state is untouched
  unsupported_image,    ///< not 8-bit gray or BGR, or depth neither 16 bit nor float; state untouched
  size_changed,         ///< the image is not of the camera's size; state untouched
  invalid_time,         ///< the time stamp is not finite; state untouched
  invalid_options,      ///< an option is out of its range, `options_error()` says which; state untouched
  duplicate_frame,      ///< same time stamp as the last frame; state untouched
  out_of_order,         ///< time runs backwards: everything is forgotten, this frame is the new reference
  time_gap,             ///< too long since the last frame: everything is forgotten, this frame is the new reference
  no_keypoints,         ///< nothing to judge; the frame becomes the reference
  no_depth,             ///< no usable depth in this frame or the last, and the ego-motion needs it
  too_few_matches,      ///< fewer matches than the ego-motion needs
  degenerate_geometry,  ///< the matches do not determine a motion (one point, one line, one plane for F)
  no_consensus,         ///< no motion explains enough of the matches
  rotation_only,        ///< warning: the camera turned without moving (or stood still); motion has no direction
  consensus_inverted,   ///< warning: another rigid motion explains more; the one that agrees with the past was taken
  keep_floor,           ///< warning: so much was dynamic that the keep-floor acted
};

/// True where the frame was judged: verdicts are verdicts, not the fail-open default.
constexpr bool judged(Status status) noexcept {
  return status == Status::ok || status == Status::rotation_only || status == Status::consensus_inverted ||
         status == Status::keep_floor;
}

/// The status as it is written in files.
constexpr const char* to_string(Status status) noexcept {
  switch (status) {
    case Status::ok: return "ok";
    case Status::first_frame: return "first_frame";
    case Status::no_image: return "no_image";
    case Status::unsupported_image: return "unsupported_image";
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
    case Status::rotation_only: return "rotation_only";
    case Status::consensus_inverted: return "consensus_inverted";
    case Status::keep_floor: return "keep_floor";
  }
  return "?";
}

}  // namespace stillpoint
