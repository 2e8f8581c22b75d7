// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is worth knowing of a frame beside its status.

#include <cstddef>
#include <cstdint>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// No warning changes a verdict. The first three tell what the filter did, the others that it may be used wrongly: they
/// come when many frames look so (`UseCheck`, `DepthRegistration`), and `FrameResult::hint` says what to look at.
enum class Warning : std::uint8_t {
  rotation_only,             ///< the camera turned without moving (or stood still); motion has no direction
  consensus_inverted,        ///< another rigid motion explains more; the one that agrees with the past was taken
  keep_floor,                ///< so much was dynamic that the keep-floor acted
  depth_turned_over,         ///< its jumps fit the image better when it is mirrored or upside down
  depth_too_near,            ///< hardly a depth beyond 1 m
  motion_too_fast,           ///< metres from frame to frame
  scale_differs,             ///< the host moves more than twice or less than half as far
  keypoints_in_one_quarter,  ///< of the image
  keypoints_outside,         ///< half of them are outside of the image
  times_far_apart,           ///< each frame comes too late for the last one
  nothing_fits,              ///< hardly a frame can be judged
  depth_unsynchronised,      ///< depth is older or newer than its image; the filter uses moved depth
  depth_shape_differs,       ///< its width by its height is not the image's
  principal_point_aside,     ///< it is far from the image's middle, as that of another resolution is
  depth_shifted,             ///< depth lies some pixels beside its image; the filter uses moved depth
};
constexpr std::size_t kWarningCount = 15;

/// The warning as it is written in files.
constexpr const char* to_string(Warning warning) noexcept {
  switch (warning) {
    case Warning::rotation_only: return "rotation_only";
    case Warning::consensus_inverted: return "consensus_inverted";
    case Warning::keep_floor: return "keep_floor";
    case Warning::depth_turned_over: return "depth_turned_over";
    case Warning::depth_too_near: return "depth_too_near";
    case Warning::motion_too_fast: return "motion_too_fast";
    case Warning::scale_differs: return "scale_differs";
    case Warning::keypoints_in_one_quarter: return "keypoints_in_one_quarter";
    case Warning::keypoints_outside: return "keypoints_outside";
    case Warning::times_far_apart: return "times_far_apart";
    case Warning::nothing_fits: return "nothing_fits";
    case Warning::depth_unsynchronised: return "depth_unsynchronised";
    case Warning::depth_shape_differs: return "depth_shape_differs";
    case Warning::principal_point_aside: return "principal_point_aside";
    case Warning::depth_shifted: return "depth_shifted";
  }
  return "?";
}

/// A set of warnings.
class Warnings {
 public:
  constexpr Warnings() = default;
  constexpr Warnings(Warning warning) noexcept : bits_(bit(warning)) {}

  constexpr bool empty() const noexcept { return bits_ == 0; }
  constexpr bool has(Warning warning) const noexcept { return (bits_ & bit(warning)) != 0; }
  constexpr void add(Warnings others) noexcept { bits_ |= others.bits_; }

  /// Calls `visit(Warning)` for each, in the order of the enum.
  template <class Visit>
  constexpr void for_each(Visit&& visit) const {
    for (std::size_t w = 0; w < kWarningCount; ++w)
      if (has(static_cast<Warning>(w))) visit(static_cast<Warning>(w));
  }

  friend constexpr bool operator==(Warnings a, Warnings b) noexcept { return a.bits_ == b.bits_; }
  friend constexpr bool operator!=(Warnings a, Warnings b) noexcept { return !(a == b); }

 private:
  static constexpr std::uint32_t bit(Warning warning) noexcept { return 1u << static_cast<unsigned>(warning); }

  std::uint32_t bits_ = 0;
};

}  // namespace stillpoint
