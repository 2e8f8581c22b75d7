// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A filter without some of the corrections of the paper's method.

#include <type_traits>

#include "corrections.hpp"
#include "corrections_policies.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint_run {

namespace detail {

/// What another type of a stage does; nothing where the stages can't be told.
template <class Policies>
void switch_stages([[maybe_unused]] const Without& without,
                   [[maybe_unused]] stillpoint::FrameFilter<Policies>& filter) {
  if constexpr (std::is_base_of_v<SwitchedPolicies, Policies>) {
    filter.scorer.is_whitened = !without("whitened");
    filter.gate.is_calibrated = !without("calibrated");
    filter.gate.lowest = stillpoint::SurfaceClusters::kLowest;
    filter.classifier.tests_all = !without("all-features");
    filter.matcher.supports_by_area = !without("area-support");
    filter.depth_lookup.is_guarded = !without("depth-guard");
    if (without("area-support")) {
      filter.ego_motion.support.constraints.surface_weight = 0.0;
      filter.ego_motion.support.constraints.host_cell_px = 0.0f;
    }
  }
}

inline stillpoint::SupportMotion& support_motion(stillpoint::SupportMotion& motion) { return motion; }
inline stillpoint::SupportMotion& support_motion(SwitchedMotion& motion) { return motion.support; }

}  // namespace detail

/// Sets a filter of `DefaultPolicies` or `SwitchedPolicies`, or of what inherits from them, so that it does without the
/// corrections named.
template <class Policies>
void switch_off(const Without& without, stillpoint::FrameFilter<Policies>& filter) {
  constexpr float kNever = 1e6f;
  detail::switch_stages(without, filter);
  stillpoint::SupportMotion& motion = detail::support_motion(filter.ego_motion);
  if (without("measured-noise")) motion.constraints.pixel_sigma = 0.1 / motion.options.inlier_sigmas;
  if (without("own-noise")) {
    motion.measures_noise = false;
    filter.gate.gain = 0.0;
  }
  if (without("stationary-camera")) motion.stationary_camera.is_enabled = false;
  if (without("past-hypothesis")) motion.past_preference = kNever;
  if (without("inertia")) motion.inertia.acceleration_m_s2 = 0.0;
  if (without("clusters")) {
    stillpoint::SurfaceClusters& clusters = filter.classifier;
    clusters.options.features_per_cluster = 10;
    clusters.fewest_clusters = 1;
    clusters.split_variance = kNever;
    clusters.options.own_share = 0.0f;
    // As long along the ray as across it: 40 px at 2 m are 0.15 m.
    clusters.depth_extent_m = 0.15;
    clusters.depth_extent_sigmas = 0.0;
  }
  if (without("older-frames")) filter.matcher.older.options.longest_s = 0.0;
  if (without("lost-features")) {
    constexpr double kOfLook = 0.5;  // of the score that 1 % of the static features of static_room exceed
    filter.scorer.options.most_from_look = 0.0;
    filter.scorer.expected_patch -= kOfLook;
  }
  if (without("depth-guard")) {
    stillpoint::GuardedDepth& guard = filter.matcher.older.guard;
    guard.fewest_neighbours = 1;
    guard.jump_m = kNever;
    filter.matcher.older.surfaces.guard = guard;
  }
  if (without("memory")) {
    auto& memory = filter.memory.options;
    memory.log_odds_decay_s = memory.dynamic_prior_decay_s = 0.0;
  }
  if (without("keep-floor")) filter.keep_floor.options.fewest_features = filter.keep_floor.options.fewest_cells = 0;
}

}  // namespace stillpoint_run
