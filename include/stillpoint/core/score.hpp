// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What scoring, gating and classifying say of a feature.

#include <cstddef>
#include <cstdint>
#include <limits>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// How badly a feature disagrees with the camera's motion.
struct FeatureScore {
  float value = std::numeric_limits<float>::quiet_NaN();  ///< grows with disagreement; NaN: could not be scored

  bool scored() const noexcept { return value == value; }
};

/// Above which score disagreement is more than noise.
struct Threshold {
  double level = std::numeric_limits<double>::infinity();
};

enum class Verdict : std::uint8_t {
  kept,     ///< stands still, as far as can be told
  dynamic,  ///< moves
  unknown,  ///< could not be told
};

/// Why a feature got its verdict, and why it was kept or not.
enum class Reason : std::uint8_t {
  not_judged,       ///< the frame was not judged: see its status
  outside_regions,  ///< nothing moves there (the paper tests features inside dynamic boxes only)
  static_cluster,   ///< its cluster agrees with the camera's motion
  moving_cluster,   ///< its cluster does not
  consistent,       ///< agrees with the camera's motion
  inconsistent,     ///< does not
  neighbours,       ///< could not be told by itself; its neighbours on the same surface decided
  remembered,       ///< earlier frames decided
  no_match,         ///< not found in the reference frame
  no_depth,         ///< no depth here or in the reference frame
  outside_image,    ///< its keypoint is outside the image or not finite
  keep_floor,       ///< dynamic, but kept, because too few would be left
  object_motion,    ///< the motion of the object that it lies on decided (movers)
};

constexpr std::size_t kReasonCount = static_cast<std::size_t>(Reason::object_motion) + 1;

constexpr const char* to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kept: return "kept";
    case Verdict::dynamic: return "dynamic";
    default: return "unknown";
  }
}

constexpr const char* to_string(Reason reason) noexcept {
  switch (reason) {
    case Reason::not_judged: return "not_judged";
    case Reason::outside_regions: return "outside_regions";
    case Reason::static_cluster: return "static_cluster";
    case Reason::moving_cluster: return "moving_cluster";
    case Reason::consistent: return "consistent";
    case Reason::inconsistent: return "inconsistent";
    case Reason::neighbours: return "neighbours";
    case Reason::remembered: return "remembered";
    case Reason::no_match: return "no_match";
    case Reason::no_depth: return "no_depth";
    case Reason::outside_image: return "outside_image";
    case Reason::keep_floor: return "keep_floor";
    case Reason::object_motion: return "object_motion";
  }
  return "?";
}

/// What the filter says of one feature.
struct Label {
  static constexpr std::int32_t kNoCluster = -1;

  Verdict verdict = Verdict::kept;
  Reason reason = Reason::not_judged;
  bool keep = true;
  std::int32_t cluster = kNoCluster;
  float log_odds = 0;  ///< of this frame alone, then of all frames: that it moves; natural logarithm
  float probability = std::numeric_limits<float>::quiet_NaN();  ///< that it moves, 0 to 1; NaN where nobody says
  float static_prior = 1.0f;  ///< 0 to 1: its weight in the camera's motion; low where something moved before
};

}  // namespace stillpoint
