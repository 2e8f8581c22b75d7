// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The options of the paper's ego-motion.

#include <cstddef>
#include <cstdint>

#include "stillpoint/core/options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/motion/candidates.hpp"

namespace stillpoint {

/// Points of a minimal sample for the fundamental matrix.
enum class EpipolarSolver : std::uint8_t { seven, eight };

/// `EpipolarMotion::Options`.
struct EpipolarOptions {
  CandidateOptions candidates;
  EpipolarSolver solver = EpipolarSolver::seven;  ///< points of a minimal sample (the paper leaves it open)
  double threshold_px = 0.1;                      ///< D of Eq. 2, undistorted pixels (the paper names no unit)
  double confidence = 0.99;                       ///< of having drawn a sample without an outlier
  std::size_t max_trials = 1000;                  ///< OpenCV's; with 7 points enough for 47 % inliers
  double min_inlier_share = 0.2;                  ///< of the candidates
  double noise_sigmas = 3.0;                      ///< within so many of the matches' own standard deviations ...
  double min_parallax_px = 0.5;     ///< ... and at most so far off, a simpler motion explains them; 0: is not asked
  double rotation_share = 0.8;      ///< of what F explains: `rotation_only`; two axes of noise against one
  double planar_share = 0.9;        ///< of the inliers on one plane: degenerate; > 1: not asked
  std::size_t min_depths = 3;       ///< inliers with depth at both ends that give t its length
  double pixel_sigma_px = 1.0;      ///< of a match, for the noise of the scale
  bool printed_eq3 = false;         ///< E = K F Kᵀ, as printed
  bool unit_translation = false;    ///< leaves ‖t‖ = 1, as printed: Eq. 6 then has a false offset
  float least_static_prior = 0.0f;  ///< of a candidate, from memory
  std::uint64_t seed = Random::kDefaultSeed;
};

template <class Visit>
void each_option(EpipolarOptions& options, Visit& visit) {
  visit("candidates", options.candidates);
  visit.choice("solver", options.solver, "seven", "eight");
  visit("threshold_px", options.threshold_px, OptionRange{1e-3, 100});
  visit("confidence", options.confidence, OptionRange{0.01, 0.999999});
  visit("max_trials", options.max_trials, OptionRange{1, 1e4});
  visit("min_inlier_share", options.min_inlier_share, OptionRange{0, 1});
  visit("noise_sigmas", options.noise_sigmas, OptionRange{0, 100});
  visit("min_parallax_px", options.min_parallax_px, OptionRange{0, 100});
  visit("rotation_share", options.rotation_share, OptionRange{0, 1});
  visit("planar_share", options.planar_share, OptionRange{0, 2});
  visit("min_depths", options.min_depths, OptionRange{1, 1e6});
  visit("pixel_sigma_px", options.pixel_sigma_px, OptionRange{0.01, 100});
  visit("printed_eq3", options.printed_eq3);
  visit("unit_translation", options.unit_translation);
  visit("least_static_prior", options.least_static_prior, OptionRange{0, 1});
  visit.seed("seed", options.seed);
}

}  // namespace stillpoint
