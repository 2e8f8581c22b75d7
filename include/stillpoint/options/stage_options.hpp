// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of every stage, by name: what options_file.hpp writes and reads.
//
// `each_option(stage, visit)` calls, in the order of the stage's header,
//
//   visit(name, value)            a number that is not negative, a bool, or a group with an `each_option` of its own
//   visit.positive(name, value)   a number above zero
//   visit.any(name, value)        a number of either sign
//   visit.choice(name, value, words...)   an enumerator or index; words name its values from 0 on
//
// A stage of your own takes part when its namespace has an `each_option` for it; one without has no options in files.

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "stillpoint/filter_frame.hpp"
#include "stillpoint/options/core_options.hpp"
#include "stillpoint/options/paper_stage_options.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint {

// prior/

template <class Visit>
void each_option(BoxPrior& stage, Visit& visit) {
  visit("lowest_confidence", stage.options.lowest_confidence);
}

template <class Visit>
void each_option(ForegroundPrior& stage, Visit& visit) {
  each_option(static_cast<BoxPrior&>(stage), visit);
  visit("reach_m", stage.reach_m);
}

template <class Visit>
void each_option(PropagatedPrior& stage, Visit& visit) {
  each_option(static_cast<ForegroundPrior&>(stage), visit);
  visit("longest_s", stage.carrying.longest_s);
  visit("most_missed", stage.carrying.most_missed);
  visit("growth_per_s", stage.carrying.growth_per_s);
  visit.positive("half_life_s", stage.carrying.half_life_s);
  visit("least_overlap", stage.carrying.least_overlap);
  visit("most_jump_m", stage.carrying.most_jump_m);
  visit("fewest_features", stage.carrying.fewest_features);
}

// match/

template <class Visit>
void each_option(CornerTracker& stage, Visit& visit) {
  visit.positive("cell_px", stage.options.cell_px);
  visit("weakest_corner", stage.options.weakest_corner);
  visit.positive("pyramid_levels", stage.options.pyramid_levels);
  visit("most_dissimilar", stage.options.most_dissimilar);
  visit("too_vague", stage.options.too_vague);
  visit("fewest_pixels", stage.options.fewest_pixels);
  visit("border_px", stage.options.border_px);
  visit("same_surface", stage.options.same_surface);
}

template <class Visit>
void each_option(PatchSearch& search, Visit& visit) {
  visit.positive("iterations", search.iterations);
  visit("precision_px", search.precision_px);
  visit.positive("reach_px", search.reach_px);
}

template <class Visit>
void each_option(SurfaceSearch& search, Visit& visit) {
  visit.positive("step_px", search.step_px);
  visit.positive("reach_px", search.reach_px);
  visit("steepest_cosine", search.steepest_cosine);
  visit("guard", search.guard);
  visit("smooth", search.smooth);
}

template <class Visit>
void each_option(LookBack& stage, Visit& visit) {
  visit("slowest_m_s", stage.options.slowest_m_s);
  visit("detectable_sigmas", stage.options.detectable_sigmas);
  visit.positive("pixel_sigma", stage.options.pixel_sigma);
  visit("longest_s", stage.options.longest_s);
  visit("fewest_pixels", stage.options.fewest_pixels);
  visit("same_surface", stage.options.same_surface);
  visit("occlusion_m", stage.options.occlusion_m);
  visit("occlusion_sigmas", stage.options.occlusion_sigmas);
  visit("occluder_reach_px", stage.options.occluder_reach_px);
  visit("surrounding_px", stage.options.surrounding_px);
  visit("supposed_spread", stage.options.supposed_spread);
  visit("clearly_alike", stage.options.clearly_alike);
  visit("clearly_there_px", stage.options.clearly_there_px);
  visit("search", stage.options.search);
  visit("guard", stage.guard);
  visit("surfaces", stage.surfaces);
}

template <class Visit>
void each_option(PatchMatcher& stage, Visit& visit) {
  visit("corners", stage.corners);
  visit("older", stage.older);
}

// motion/

template <class Visit>
void each_option(SupportConstraints& constraints, Visit& visit) {
  visit.positive("pixel_sigma", constraints.pixel_sigma);
  visit("depth_sigmas", constraints.depth_sigmas);
  visit("depth_floor_m", constraints.depth_floor_m);
  visit.positive("depthless_spread", constraints.depthless_spread);
  visit("dynamic_trust", constraints.dynamic_trust);
  visit("movable_trust", constraints.movable_trust);
  visit("surface_weight", constraints.surface_weight);
  visit("cell_px", constraints.cell_px);
  visit("most_dissimilar", constraints.most_dissimilar);
}

template <class Visit>
void each_option(StandingCamera& standing, Visit& visit) {
  visit("rest_px", standing.rest_px);
  visit("begins_share", standing.begins_share);
  visit("majority_share", standing.majority_share);
  visit("continues_share", standing.continues_share);
}

template <class Visit>
void each_option(Inertia& inertia, Visit& visit) {
  visit("acceleration_m_s2", inertia.acceleration_m_s2);
  visit("angular_acceleration_rad_s2", inertia.angular_acceleration_rad_s2);
  visit.positive("correlated", inertia.correlated);
  visit.positive("degrees_of_freedom", inertia.degrees_of_freedom);
}

template <class Visit>
void each_option(SupportMotion& stage, Visit& visit) {
  visit.positive("inlier_sigmas", stage.options.inlier_sigmas);
  visit("max_trials", stage.options.max_trials);
  visit.positive("confidence", stage.options.confidence);
  visit("past_preference", stage.options.past_preference);
  visit("same_motion_px", stage.options.same_motion_px);
  visit("least_support", stage.options.least_support);
  visit("undisputed_loss", stage.options.undisputed_loss);
  visit("creep_gain", stage.options.creep_gain);
  visit.positive("least_pixel_sigma", stage.options.least_pixel_sigma);
  visit.positive("most_depth_noise", stage.options.most_depth_noise);
  visit("fewest_matches", stage.options.fewest_matches);
  visit("seed", stage.options.seed);
  visit("constraints", stage.constraints);
  visit("standing", stage.standing);
  visit("inertia", stage.inertia);
}

// score/, gate/

template <class Visit>
void each_option(SightingScore& stage, Visit& visit) {
  visit.positive("pixel_sigma", stage.options.pixel_sigma);
  visit("alike_share", stage.options.alike_share);
  visit("motion_sigmas", stage.options.motion_sigmas);
  visit.positive("least_noise", stage.options.least_noise);
  visit("drift_px_per_s", stage.options.drift_px_per_s);
  visit("depth_sigmas", stage.options.depth_sigmas);
  visit.positive("depth_floor_m", stage.options.depth_floor_m);
  visit.positive("dissimilarity_scale", stage.options.dissimilarity_scale);
  visit("most_from_place", stage.options.most_from_place);
  visit("most_from_look", stage.options.most_from_look);
  visit("most_from_depth", stage.options.most_from_depth);
  visit("expected_patch", stage.options.expected_patch);
  visit("expected_depth", stage.options.expected_depth);
}

template <class Visit>
void each_option(TailGate& stage, Visit& visit) {
  visit.positive("false_positive_rate", stage.options.false_positive_rate);
  visit.any("level_of_one_percent", stage.options.level_of_one_percent);
  visit.positive("decay", stage.options.decay);
  visit("gain", stage.options.gain);
  visit("most_excess", stage.options.most_excess);
  visit("most_raised", stage.options.most_raised);
  visit.any("stood_below", stage.options.stood_below);
  visit("trusted", stage.options.trusted);
  visit("fewest_known", stage.options.fewest_known);
}

// cluster/, memory/, verdict/

template <class Visit>
void each_option(SurfaceClusters& stage, Visit& visit) {
  visit.positive("features_per_cluster", stage.options.features_per_cluster);
  visit.positive("fewest_clusters", stage.options.fewest_clusters);
  visit("fewest_members", stage.options.fewest_members);
  visit.positive("max_iterations", stage.options.max_iterations);
  visit.positive("extent_px", stage.options.extent_px);
  visit.positive("depth_extent_m", stage.options.depth_extent_m);
  visit.positive("depth_extent_growth", stage.options.depth_extent_growth);
  visit("nearest_m", stage.options.nearest_m);
  visit.any("lowest", stage.options.lowest);
  visit.any("highest", stage.options.highest);
  visit("own_share", stage.options.own_share);
  visit("split_variance", stage.options.split_variance);
  visit("split_explained", stage.options.split_explained);
  visit.positive("neighbour_px", stage.options.neighbour_px);
  visit("neighbour_share", stage.options.neighbour_share);
  visit("depthless_own", stage.options.depthless_own);
  visit.any("depthless_shift", stage.options.depthless_shift);
  visit.any("alone", stage.options.alone);
  visit.any("dynamic_shift", stage.options.dynamic_shift);
  visit.any("outside_shift", stage.options.outside_shift);
  visit.any("movable_shift", stage.options.movable_shift);
  visit.any("fixed_shift", stage.options.fixed_shift);
  visit("seed", stage.options.seed);
}

template <class Visit>
void each_option(EvidenceMemory& stage, Visit& visit) {
  visit("log_odds_decay_s", stage.options.log_odds_decay_s);
  visit("most_log_odds", stage.options.most_log_odds);
  visit("restlessness", stage.options.restlessness);
  visit.any("drop_above", stage.options.drop_above);
  visit.any("keep_below", stage.options.keep_below);
  visit.any("suspect_above", stage.options.suspect_above);
  visit("suspicion_rise_s", stage.options.suspicion_rise_s);
  visit("suspicion_decay_s", stage.options.suspicion_decay_s);
  visit("least_trust", stage.options.least_trust);
  visit.positive("feature_px", stage.options.feature_px);
  visit.positive("neighbour_px", stage.options.neighbour_px);
  visit("minority", stage.options.minority);
  visit("same_surface", stage.options.same_surface);
}

template <class Visit>
void each_option(KeepFloor& stage, Visit& visit) {
  visit("fewest_features", stage.options.fewest_features);
  visit("fewest_cells", stage.options.fewest_cells);
  visit.positive("columns", stage.options.columns);
  visit.positive("rows", stage.options.rows);
}

/// All stages of a filter, in the order of its members; the camera is no option.
template <class Policies, class Visit>
void each_option(FrameFilter<Policies>& filter, Visit& visit) {
  visit("frame_check", filter.frame_check);
  visit("depth_noise", filter.depth_noise);
  visit("depth_lookup", filter.depth_lookup);
  visit("prior", filter.prior);
  visit("matcher", filter.matcher);
  visit("ego_motion", filter.ego_motion);
  visit("scorer", filter.scorer);
  visit("gate", filter.gate);
  visit("classifier", filter.classifier);
  visit("memory", filter.memory);
  visit("keep_floor", filter.keep_floor);
  visit("mask_prediction", filter.mask_prediction);
}

/// What a visitor that only looks at options needs besides `(name, value)`: the range is nothing to it, and a choice is
/// the word for its value, by `word(name, text)`.
/// @tparam Visitor  the class that derives from this one
template <class Visitor>
class LooksAtOptions {
 public:
  template <class T>
  void positive(const char* name, T& value) {
    static_cast<Visitor&> (*this)(name, value);
  }
  template <class T>
  void any(const char* name, T& value) {
    static_cast<Visitor&> (*this)(name, value);
  }
  template <class T, class... Words>
  void choice(const char* name, T& value, Words... words) {
    const std::array<const char*, sizeof...(Words)> all{words...};
    static_cast<Visitor&>(*this).word(name, all[static_cast<std::size_t>(value)]);
  }
};

/// True for a stage or group whose options have names.
template <class Group, class Visit, class = void>
struct has_options : std::false_type {};
template <class Group, class Visit>
struct has_options<Group, Visit, std::void_t<decltype(each_option(std::declval<Group&>(), std::declval<Visit&>()))>>
    : std::true_type {};

}  // namespace stillpoint
