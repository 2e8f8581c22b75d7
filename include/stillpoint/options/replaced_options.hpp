// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Options of earlier versions that are gone, and what replaced each: an old options.yaml is refused with a hint.

#include <array>
#include <optional>
#include <string_view>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

/// An option that was once in files.
struct ReplacedOption {
  std::string_view name;         ///< with its stage, as in `gate.decay`
  std::string_view replacement;  ///< the name of an option that is there, or "fixed at VALUE: WHY"
};

// clang-format off
inline constexpr std::array<ReplacedOption, 126> kReplacedOptions = {{
    {"depth_lookup.fewest_neighbours", "fixed at 6: pixels of nine with a depth"},
    {"depth_lookup.jump_m", "fixed at 0.03: depth_noise adds seven sigmas"},
    {"depth_lookup.jump_per_square_m", "depth_noise.model"},
    {"prior.reach_m", "fixed at 0.1: half the depth of a body"},
    {"prior.most_missed", "fixed at 8: prior.longest_s ends what is not seen"},
    {"prior.growth_per_s", "fixed at 0.2: a box grows until prior.longest_s ends it"},
    {"prior.half_life_s", "fixed at 1: half of prior.longest_s"},
    {"prior.least_overlap", "fixed at 0.2: boxes of neighbours overlap less"},
    {"prior.most_jump_m", "fixed at 0.2: more is something before the object"},
    {"prior.fewest_features", "fixed at 4: for a median"},
    {"matcher.corners.weakest_corner", "fixed at 600: matcher.corners.cell_px sets how many corners there are"},
    {"matcher.corners.pyramid_levels", "fixed at 4: frames are aligned before corners are followed"},
    {"matcher.corners.too_vague", "fixed at 0.5: of coarse levels alone"},
    {"matcher.corners.fewest_pixels", "fixed at 25: of a patch's 64"},
    {"matcher.corners.border_px", "fixed at 8: a patch's width"},
    {"matcher.corners.same_surface.constant_m", "fixed at 0.05: roughness of a surface"},
    {"matcher.corners.same_surface.per_square_m", "depth_noise.model"},
    {"matcher.older.detectable_sigmas", "fixed at 3: scale matcher.older.slowest_m_s"},
    {"matcher.older.fewest_pixels", "fixed at 25: of a patch's 64"},
    {"matcher.older.same_surface.constant_m", "fixed at 0.05: roughness of a surface"},
    {"matcher.older.same_surface.per_square_m", "depth_noise.model"},
    {"matcher.older.occlusion_m", "fixed at 0.15: matcher.older.occlusion_sigmas adds to it"},
    {"matcher.older.occluder_reach_px", "fixed at 8: a patch's width"},
    {"matcher.older.surrounding_px", "fixed at 24: as far as a hole in the depth is wide"},
    {"matcher.older.supposed_spread", "fixed at 0.1: of a supposed inverse depth"},
    {"matcher.older.clearly_alike", "fixed at 0.12: below it a patch is alike"},
    {"matcher.older.clearly_there_px", "fixed at 0.7: as exact as a patch is found"},
    {"matcher.older.search.iterations", "fixed at 3: more find look-alikes"},
    {"matcher.older.search.precision_px", "fixed at 0.2: saves time alone"},
    {"matcher.older.search.reach_px", "fixed at 3: three steps of a pixel reach no farther"},
    {"matcher.older.guard.fewest_neighbours", "fixed at 6: pixels of nine with a depth"},
    {"matcher.older.guard.jump_m", "fixed at 0.03: depth_noise adds seven sigmas"},
    {"matcher.older.guard.jump_per_square_m", "depth_noise.model"},
    {"matcher.older.surfaces.guard.fewest_neighbours", "fixed at 6: pixels of nine with a depth"},
    {"matcher.older.surfaces.guard.jump_m", "fixed at 0.03: depth_noise adds seven sigmas"},
    {"matcher.older.surfaces.guard.jump_per_square_m", "depth_noise.model"},
    {"matcher.older.surfaces.reach_px", "fixed at 5: of the pixels that span a normal"},
    {"matcher.older.surfaces.steepest_cosine", "fixed at 0.2: 78 degrees"},
    {"matcher.older.surfaces.smooth.constant_m", "fixed at 0.05: roughness of a surface"},
    {"matcher.older.surfaces.smooth.per_square_m", "depth_noise.model"},
    {"ego_motion.trials", "ego_motion.max_trials"},
    {"ego_motion.confidence", "fixed at 0.9996: ego_motion.max_trials bounds the time"},
    {"ego_motion.past_preference", "fixed at 0.35: chosen on recordings of walking people"},
    {"ego_motion.same_motion_px", "fixed at 1: less is noise"},
    {"ego_motion.least_support", "fixed at 0.08: less is no consensus"},
    {"ego_motion.undisputed_loss", "fixed at 48: squared sigmas of six degrees of freedom"},
    {"ego_motion.creep_gain", "fixed at 60: squared sigmas (docs/design/sweeps.md)"},
    {"ego_motion.least_pixel_sigma", "fixed at 0.1: as exact as corners of rendered images"},
    {"ego_motion.most_depth_noise", "fixed at 4: beyond it, set depth_noise.scale"},
    {"ego_motion.fewest_matches", "fixed at 6: two minimal samples"},
    {"ego_motion.constraints.depth_floor_m", "fixed at 0.003: what is left without a sensor's noise"},
    {"ego_motion.constraints.depthless_spread", "fixed at 0.3: of an unknown inverse depth"},
    {"ego_motion.constraints.surface_weight", "fixed at 0.8: errors of neighbours are not independent"},
    {"ego_motion.constraints.most_dissimilar", "fixed at 0.25: less alike says nothing of the motion"},
    {"ego_motion.constraints.dynamic_trust", "ego_motion.constraints.dynamic_region_weight"},
    {"ego_motion.constraints.movable_trust", "fixed at 0.6: changed no recording"},
    {"ego_motion.least_trust", "ego_motion.least_static_prior"},
    {"ego_motion.standing.rest_px", "fixed at 0.3: three sigmas of a corner at rest"},
    {"ego_motion.standing.begins_share", "fixed at 0.9: of the corners"},
    {"ego_motion.standing.majority_share", "fixed at 0.5: of the corners"},
    {"ego_motion.standing.continues_share", "fixed at 0.05: of the corners"},
    {"ego_motion.inertia.correlated", "fixed at 12: measured on recordings"},
    {"ego_motion.inertia.degrees_of_freedom", "fixed at 10: of Student's t"},
    {"scorer.alike_share", "fixed at 0.5: of scorer.pixel_sigma"},
    {"scorer.motion_sigmas", "fixed at 3.2: of the motion's own noise (docs/design/sweeps.md)"},
    {"scorer.least_noise", "fixed at 0.3: of scorer.pixel_sigma (docs/design/sweeps.md)"},
    {"scorer.drift_px_per_s", "fixed at 1: of chained poses"},
    {"scorer.depth_floor_m", "fixed at 0.004: what is left without a sensor's noise"},
    {"scorer.dissimilarity_scale", "fixed at 0.12: of static patches"},
    {"scorer.unseen", "fixed: what one frame alone saw counts 0.7 of its evidence"},
    {"scorer.least_trust", "scorer.least_static_prior"},
    {"scorer.expected_patch", "fixed at 2.5: nats of a static point"},
    {"scorer.expected_depth", "fixed at 1: nats of a static point"},
    {"gate.level_of_one_percent", "gate.false_positive_rate"},
    {"gate.decay", "fixed at 0.8: nats, measured with the whole filter"},
    {"gate.gain", "fixed at 0.01: nats per frame"},
    {"gate.most_excess", "fixed at 2: times the rate"},
    {"gate.most_raised", "fixed at 3: nats"},
    {"gate.stood_below", "fixed at -1.5: nats"},
    {"gate.trusted", "fixed at 0.95: nothing nearby moved before"},
    {"gate.fewest_known", "fixed at 50: fewer teach nothing"},
    {"classifier.fewest_clusters", "fixed at 2: classifier.features_per_cluster sets their number"},
    {"classifier.fewest_members", "fixed at 3: of a population"},
    {"classifier.max_iterations", "fixed at 3: a fourth changes nothing"},
    {"classifier.extent_px", "fixed at 40: scales with the focal length"},
    {"classifier.depth_extent_m", "fixed at 0.04: depth_noise adds three sigmas"},
    {"classifier.depth_extent_growth", "depth_noise.model"},
    {"classifier.nearest_m", "depth_noise.model"},
    {"classifier.lowest", "fixed at -2: nats"},
    {"classifier.highest", "fixed at 10: nats"},
    {"classifier.split_variance", "fixed at 9: squared nats"},
    {"classifier.split_explained", "fixed at 0.8: of the variance"},
    {"classifier.neighbour_px", "fixed at 25: scales with the focal length"},
    {"classifier.neighbour_share", "fixed at 0.7: of the neighbours' log-odds"},
    {"classifier.depthless_own", "fixed at 0.4: of a feature's own score"},
    {"classifier.depthless_shift", "fixed: counted in each frame, -1.5 nats where nothing can be counted"},
    {"classifier.alone", "fixed at -1: nats"},
    {"classifier.outside_shift", "fixed at -0.6: nats; classifier.dynamic_shift is what a box is worth"},
    {"classifier.movable_shift", "fixed at 0.2: nats"},
    {"classifier.fixed_shift", "fixed at -0.3: nats"},
    {"classifier.seed", "fixed: a run is varied by ego_motion.seed"},
    {"memory.surface_m", "fixed at 0.06: roughness of a surface"},
    {"memory.surface_per_square_m", "depth_noise.model"},
    {"memory.persistence", "memory.log_odds_decay_s"},
    {"memory.suspicion_gain", "memory.dynamic_prior_rise_s"},
    {"memory.suspicion_persistence", "memory.dynamic_prior_decay_s"},
    {"memory.suspicion_rise_s", "memory.dynamic_prior_rise_s"},
    {"memory.suspicion_decay_s", "memory.dynamic_prior_decay_s"},
    {"memory.most_log_odds", "fixed at 3: memory.log_odds_decay_s says how long they last"},
    {"memory.restlessness", "fixed at 0.6: swept (docs/design/sweeps.md)"},
    {"memory.drop_above", "gate.false_positive_rate"},
    {"memory.keep_below", "fixed at 0: it was as drop_above and changed nothing"},
    {"memory.suspect_above", "fixed at 2: nats"},
    {"memory.least_trust", "fixed at 0.01: at a dynamic prior of 1"},
    {"memory.feature_px", "fixed at 15: scales with the focal length"},
    {"memory.neighbour_px", "fixed at 25: scales with the focal length"},
    {"memory.minority", "fixed at 0.25: of the neighbours"},
    {"memory.same_surface.constant_m", "fixed at 0.06: roughness of a surface"},
    {"memory.same_surface.per_square_m", "depth_noise.model"},
    {"keep_floor.columns", "fixed at 4: keep_floor.fewest_cells says how many of 12 cells"},
    {"keep_floor.rows", "fixed at 3: keep_floor.fewest_cells says how many of 12 cells"},
    {"mask_prediction.surface_m", "fixed at 0.06: roughness of a surface"},
    {"mask_prediction.surface_per_square_m", "depth_noise.model"},
    {"mask_prediction.same_surface.constant_m", "fixed at 0.06: roughness of a surface"},
    {"mask_prediction.same_surface.per_square_m", "depth_noise.model"},
    {"mask_prediction.longest_gap_s", "fixed at 1: farther ahead nothing can be predicted"},
}};
// clang-format on

/// What replaced an option; nothing for a name that no version had, or that still is one.
inline std::optional<std::string_view> replacement_of(std::string_view name) noexcept {
  for (const ReplacedOption& option : kReplacedOptions)
    if (option.name == name) return option.replacement;
  return std::nullopt;
}

}  // namespace stillpoint
