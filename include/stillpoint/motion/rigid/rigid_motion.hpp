// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move?   Metric: from matches with depth at both ends.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/candidates.hpp"
#include "stillpoint/motion/ransac.hpp"
#include "stillpoint/motion/rigid/rigid_estimator.hpp"

namespace stillpoint {

/// The rigid motion that most 3D points agree with, whitened by depth and pixel noise, with its covariance. It does not
/// mind planes, pure rotation or a stationary camera.
///
/// | status                | when                                                                                    |
/// |-----------------------|-----------------------------------------------------------------------------------------|
/// | `too_few_matches`     | fewer than 3 candidates, whether they have depth or not                                 |
/// | `no_depth`            | of the candidates fewer than 3 have depth at both ends                                  |
/// | `degenerate_geometry` | these coincide or lie on a line, so that the rotation about it is not determined        |
/// | `no_consensus`        | no motion explains `min_inliers` and `min_inlier_share` of them                         |
///
/// `rotation_only` never: with metric points the pose is whole whether the camera moved or not, and how far a small
/// translation can be told from none is what the covariance says.
class RigidMotion {
 public:
  using Needs = Capabilities<capability::matches, capability::metric_depth>;
  using Provides = Capabilities<capability::metric_motion>;

  struct Options {
    CandidateOptions candidates;
    double threshold_sigma = 2.8;  ///< largest whitened distance of an inlier: √(χ²₃ at 95 %)
    double pixel_sigma_px = 1.0;   ///< of a match, across the ray, at either end
    double confidence = 0.99;      ///< of having drawn a sample without an outlier
    std::size_t max_trials = 500;  ///< enough for 21 % inliers
    std::size_t min_inliers = 3;
    double min_inlier_share = 0.2;    ///< of the candidates
    double max_rotation_sigma = 0.1;  ///< radians; about some axis less certain: degenerate
    std::uint64_t seed = Random::kDefaultSeed;
  };
  Options options;

  /// @return current_from_reference in metres, its covariance from the inliers' normal equations. O(trials × matches).
  template <class Camera>
  Motion estimate(const Observations& observations, const Camera& camera, const MotionPrior&,
                  Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const Regions& regions = observations.regions;
    const Workspace::Scope scope(workspace);
    Motion motion;
    const auto metric = [&matches](std::size_t i) { return matches.metric(i); };
    const span<const std::uint32_t> candidates =
        select_candidates(matches, regions, options.candidates, workspace, metric);
    motion.candidates = static_cast<int>(candidates.size());
    if (candidates.size() < RigidEstimator::kSampleSize) {
      motion.status = why_so_few(matches, regions, workspace);
      return motion;
    }
    const RigidEstimator estimator(shuffled_pairs(matches, candidates, camera, workspace), workspace);
    const auto report = ransac(estimator, ransac_options(options.threshold_sigma, options), workspace);
    motion.inliers = static_cast<int>(report.inliers);
    motion.status = judge(report, candidates.size());
    if (motion.status != Status::ok) return motion;
    conclude(report, estimator, motion);
    return motion;
  }

 private:
  Status why_so_few(const Matches& matches, const Regions& regions, Workspace& workspace) const {
    const auto any = [](std::size_t) { return true; };
    const std::size_t without_depth = select_candidates(matches, regions, options.candidates, workspace, any).size();
    return without_depth < RigidEstimator::kSampleSize ? Status::too_few_matches : Status::no_depth;
  }

  template <class Camera>
  span<const WhitenedPair> shuffled_pairs(const Matches& matches, span<const std::uint32_t> candidates,
                                          const Camera& camera, Workspace& workspace) const {
    const span<WhitenedPair> pairs = workspace.take<WhitenedPair>(candidates.size());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const std::uint32_t i = candidates[k];
      pairs[k] = WhitenedPair(matches.reference.point[i], matches.reference.depth_sigma_m[i], matches.current.point[i],
                              matches.current.depth_sigma_m[i], options.pixel_sigma_px, camera);
    }
    Random random(options.seed);
    shuffle(pairs, random);
    return {pairs.data(), pairs.size()};
  }

  Status judge(const RansacReport<Pose>& report, std::size_t candidates) const {
    if (report.degenerate == report.trials) return Status::degenerate_geometry;
    const double least =
        std::max(static_cast<double>(options.min_inliers), options.min_inlier_share * static_cast<double>(candidates));
    return report.success && static_cast<double>(report.inliers) >= least ? Status::ok : Status::no_consensus;
  }

  void conclude(const RansacReport<Pose>& report, const RigidEstimator& estimator, Motion& motion) const {
    const std::optional<Matrix6d> covariance = estimator.covariance(report.model, report.inlier);
    const double most = options.max_rotation_sigma * options.max_rotation_sigma;
    if (!covariance || !(largest_rotation_variance(*covariance) <= most)) {
      motion.status = Status::degenerate_geometry;
      return;
    }
    motion.current_from_reference = report.model;
    motion.covariance = *covariance;
  }

  /// An upper bound that is at most three times too large.
  static double largest_rotation_variance(const Matrix6d& covariance) {
    return covariance.topLeftCorner<3, 3>().trace();
  }
};

template <class Visit>
void each_option(RigidMotion& stage, Visit& visit) {
  visit("candidates", stage.options.candidates);
  visit("threshold_sigma", stage.options.threshold_sigma, OptionRange{0.1, 100});
  visit("pixel_sigma_px", stage.options.pixel_sigma_px, OptionRange{0.01, 100});
  visit("confidence", stage.options.confidence, OptionRange{0.01, 0.999999});
  visit("max_trials", stage.options.max_trials, OptionRange{1, 1e4});
  visit("min_inliers", stage.options.min_inliers, OptionRange{3, 1e6});
  visit("min_inlier_share", stage.options.min_inlier_share, OptionRange{0, 1});
  visit("max_rotation_sigma", stage.options.max_rotation_sigma, OptionRange{0, 10});
  visit.seed("seed", stage.options.seed);
}

}  // namespace stillpoint
