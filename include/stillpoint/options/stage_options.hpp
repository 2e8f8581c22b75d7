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
void each_option(PropagatedPrior& stage, Visit& visit) {
  each_option(static_cast<BoxPrior&>(stage), visit);
  visit("longest_s", stage.carrying.longest_s);
}

// match/

template <class Visit>
void each_option(CornerTracker& stage, Visit& visit) {
  visit.positive("cell_px", stage.options.cell_px);
  visit("most_dissimilar", stage.options.most_dissimilar);
}

template <class Visit>
void each_option(SurfaceSearch& search, Visit& visit) {
  visit.positive("step_px", search.step_px);
}

template <class Visit>
void each_option(LookBack& stage, Visit& visit) {
  visit("slowest_m_s", stage.options.slowest_m_s);
  visit.positive("pixel_sigma", stage.options.pixel_sigma);
  visit("longest_s", stage.options.longest_s);
  visit("occlusion_sigmas", stage.options.occlusion_sigmas);
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
  visit("dynamic_trust", constraints.dynamic_trust);
  visit("movable_trust", constraints.movable_trust);
}

template <class Visit>
void each_option(Inertia& inertia, Visit& visit) {
  visit("acceleration_m_s2", inertia.acceleration_m_s2);
  visit("angular_acceleration_rad_s2", inertia.angular_acceleration_rad_s2);
}

template <class Visit>
void each_option(SupportMotion& stage, Visit& visit) {
  visit.positive("inlier_sigmas", stage.options.inlier_sigmas);
  visit("max_trials", stage.options.max_trials);
  visit("seed", stage.options.seed);
  visit("constraints", stage.constraints);
  visit("inertia", stage.inertia);
}

// score/, gate/

template <class Visit>
void each_option(SightingScore& stage, Visit& visit) {
  visit.positive("pixel_sigma", stage.options.pixel_sigma);
  visit("depth_sigmas", stage.options.depth_sigmas);
  visit("most_from_place", stage.options.most_from_place);
  visit("most_from_look", stage.options.most_from_look);
  visit("most_from_depth", stage.options.most_from_depth);
}

template <class Visit>
void each_option(TailGate& stage, Visit& visit) {
  visit.positive("false_positive_rate", stage.options.false_positive_rate);
}

// cluster/, memory/, verdict/

template <class Visit>
void each_option(SurfaceClusters& stage, Visit& visit) {
  visit.positive("features_per_cluster", stage.options.features_per_cluster);
  visit("own_share", stage.options.own_share);
  visit.any("dynamic_shift", stage.options.dynamic_shift);
}

template <class Visit>
void each_option(EvidenceMemory& stage, Visit& visit) {
  visit("log_odds_decay_s", stage.options.log_odds_decay_s);
  visit("suspicion_rise_s", stage.options.suspicion_rise_s);
  visit("suspicion_decay_s", stage.options.suspicion_decay_s);
}

template <class Visit>
void each_option(KeepFloor& stage, Visit& visit) {
  visit("fewest_features", stage.options.fewest_features);
  visit("fewest_cells", stage.options.fewest_cells);
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
