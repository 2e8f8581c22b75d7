// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is the camera stationary?   Corners at rest are no coincidence: a mover hides no wall, however much of the view it
// fills.

#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/observations.hpp"

namespace stillpoint {

/// A stationary camera has exactly no motion, which needs far less support than one that was estimated: a moving camera
/// leaves nothing at rest but what is fixed to it, and that lies before the world, and what is too far away to show its
/// motion. Without this, a person who stands close before the lens and sways takes the pose along.
struct StationaryCamera {
  static constexpr double kRest_px = 0.3;  ///< a corner that moved less is at rest

  bool is_enabled = true;  ///< false: no camera is taken for stationary; no option in files

  /// Between the last frame and this one.
  bool since_last_frame(const Observations& observations, bool stood) const {
    const Matches& matches = observations.matches;
    Census census;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.matched(i)) continue;
      census.count(moved_px(matches, i), observations, i);
    }
    return stands(census, stood);
  }

  /// @param i  a match
  bool at_rest(const Matches& matches, std::size_t i) const { return moved_px(matches, i) < kRest_px; }

  /// Since the oldest frame that was looked at and in which the camera is thought to have stood already: a slow
  /// motion is at rest from frame to frame.
  bool since_older_frames(const Observations& observations) const {
    const Matches& matches = observations.matches;
    const OlderFrame* oldest = nullptr;
    for (const OlderFrame& frame : matches.past_observations.frames())
      if (is_identity(frame.reference_from_current)) oldest = &frame;
    if (oldest == nullptr) return true;
    Census census;
    for (std::size_t i = matches.first_support(); i < matches.size(); ++i) {
      const Observation& observation = oldest->of_feature[i];
      if (observation.state != ObservationState::seen || !(observation.dissimilarity < 2.0f)) continue;
      census.count((matches.current.undistorted[i] - to_double(observation.found)).norm(), observations, i);
    }
    return census.empty() || stands(census, true);
  }

 private:
  static constexpr double kParallax_px = 0.05;   // what rests would have moved so far, if the camera had, or is too far
  static constexpr double kBeginsShare = 0.9;    // of the weight of all corners that is at rest when a camera stops
  static constexpr double kMajorityShare = 0.5;  // while it is stationary, so much is enough …
  static constexpr double kContinuesShare = 0.05;  // … or so much, if it lies behind the rest

  /// Of chained poses, which are rounded.
  static bool is_identity(const Pose& pose) {
    constexpr double kSame = 1e-9;
    return translation_of(pose).norm() < kSame && (rotation_of(pose) - Matrix3d(Matrix3d::Identity())).norm() < kSame;
  }

  struct Group {
    double weight = 0;
    double moved_px = 0;                       ///< Σ weight times how far each moved
    double with_depth = 0, inverse_depth = 0;  ///< weight of those with a depth; Σ weight / depth

    double mean_moved_px() const { return weight > 0 ? moved_px / weight : 0.0; }
    double mean_inverse_depth() const { return with_depth > 0 ? inverse_depth / with_depth : 0.0; }
  };
  struct Census {
    Group resting, moving;

    bool empty() const noexcept { return !(resting.weight + moving.weight > 0); }

    void count(double moved_px, const Observations& observations, std::size_t i) {
      const FrameFeatures& current = observations.matches.current;
      Group& group = moved_px < kRest_px ? resting : moving;
      const auto weight = static_cast<double>(observations.remembered.static_prior[i]);
      group.weight += weight;
      group.moved_px += weight * moved_px;
      if (!current.has_depth(i)) return;
      group.with_depth += weight;
      group.inverse_depth += weight / current.depth_m[i];
    }
  };

  static double moved_px(const Matches& matches, std::size_t i) {
    return (matches.current.undistorted[i] - matches.reference.undistorted[i]).norm();
  }

  bool stands(const Census& census, bool stood) const {
    const double all = census.resting.weight + census.moving.weight;
    if (!is_enabled || !(all > 0)) return false;
    const double share = census.resting.weight / all;
    const double resting_inverse_m = census.resting.mean_inverse_depth();
    const double moving_inverse_m = census.moving.mean_inverse_depth();
    const bool has_depth = census.resting.with_depth > 0;
    const bool would_show = census.moving.mean_moved_px() * resting_inverse_m >= kParallax_px * moving_inverse_m;
    if (has_depth && !would_show) return false;
    if (share > (stood ? kMajorityShare : kBeginsShare)) return true;
    return stood && share > kContinuesShare && has_depth && resting_inverse_m < moving_inverse_m;
  }
};

using StandingCamera [[deprecated("StationaryCamera")]] = StationaryCamera;  ///< its name in 0.2; gone in 0.4

}  // namespace stillpoint
