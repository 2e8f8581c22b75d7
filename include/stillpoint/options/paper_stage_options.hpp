// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of the paper's stages and of `ProvidedMatches`, by name; the form is told in stage_options.hpp.

#include "stillpoint/match/provided_matches.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint {

template <class Visit>
void each_option(LucasKanade& stage, Visit& visit) {
  visit.positive("window_px", stage.options.window_px);
  visit("pyramid_levels", stage.options.pyramid_levels);
  visit.positive("iterations", stage.options.iterations);
  visit("precision_px", stage.options.precision_px);
  visit("forward_backward_px", stage.options.forward_backward_px);
  visit("border_px", stage.options.border_px);
}

template <class Visit>
void each_option(OlderFrameChoice& choice, Visit& visit) {
  visit("slowest_m_s", choice.slowest_m_s);
  visit.positive("pixel_sigma", choice.pixel_sigma);
  visit("longest_s", choice.longest_s);
}

template <class Visit>
void each_option(PlaceTest& test, Visit& visit) {
  visit("occlusion_sigmas", test.occlusion_sigmas);
}

template <class Visit>
void each_option(ProvidedMatches& stage, Visit& visit) {
  visit("border_px", stage.options.border_px);
  visit("same_point_px", stage.options.same_point_px);
  visit("objection_px", stage.options.objection_px);
  visit("known_log_odds", stage.options.known_log_odds);
  visit("occluder_reach_px", stage.options.occluder_reach_px);
  visit("surrounding_px", stage.options.surrounding_px);
  visit("older", stage.older);
  visit("places", stage.places);
  visit("surfaces", stage.surfaces);
}

template <class Visit>
void each_option(CandidateOptions& candidates, Visit& visit) {
  visit("region_margin_px", candidates.region_margin_px);
  visit("enough", candidates.enough);
}

template <class Visit>
void each_option(EpipolarMotion& stage, Visit& visit) {
  visit("candidates", stage.options.candidates);
  visit.choice("solver", stage.options.solver, "seven", "eight");
  visit.positive("threshold_px", stage.options.threshold_px);
  visit.positive("confidence", stage.options.confidence);
  visit.positive("max_trials", stage.options.max_trials);
  visit("min_inlier_share", stage.options.min_inlier_share);
  visit("noise_sigmas", stage.options.noise_sigmas);
  visit("min_parallax_px", stage.options.min_parallax_px);
  visit("rotation_share", stage.options.rotation_share);
  visit("planar_share", stage.options.planar_share);
  visit("min_depths", stage.options.min_depths);
  visit.positive("pixel_sigma_px", stage.options.pixel_sigma_px);
  visit("printed_eq3", stage.options.printed_eq3);
  visit("unit_translation", stage.options.unit_translation);
  visit("least_trust", stage.options.least_trust);
  visit("seed", stage.options.seed);
}

template <class Visit>
void each_option(RigidMotion& stage, Visit& visit) {
  visit("candidates", stage.options.candidates);
  visit.positive("threshold_sigma", stage.options.threshold_sigma);
  visit.positive("pixel_sigma_px", stage.options.pixel_sigma_px);
  visit.positive("confidence", stage.options.confidence);
  visit.positive("max_trials", stage.options.max_trials);
  visit("min_inliers", stage.options.min_inliers);
  visit("min_inlier_share", stage.options.min_inlier_share);
  visit("max_rotation_sigma", stage.options.max_rotation_sigma);
  visit("seed", stage.options.seed);
}

template <class Visit>
void each_option(OffsetScore& stage, Visit& visit) {
  visit("angle_weight", stage.options.angle_weight);
  visit("length_weight", stage.options.length_weight);
  visit("printed_eq8", stage.options.printed_eq8);
}

template <class Visit>
void each_option(MeanGate& stage, Visit& visit) {
  visit("outlier_sigmas", stage.options.outlier_sigmas);
}

template <class Visit>
void each_option(RegionClusters& stage, Visit& visit) {
  visit.positive("features_per_cluster", stage.options.features_per_cluster);
  visit.positive("max_iterations", stage.options.max_iterations);
  visit("seed", stage.options.seed);
}

}  // namespace stillpoint
