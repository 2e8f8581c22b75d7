// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How badly does a feature disagree with the camera's motion?   Evidence from every older frame in which it was looked
// for: where its patch was found, how alike it looks, what depth was there.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/reprojection_information.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Each older frame gives a log-likelihood ratio, moving against static. A static point's whitened distance is
/// Gaussian in its core with a heavy tail; a Gaussian contaminated by a flat share ε has −log p = min(d² / 2, −log ε):
/// evidence saturates, no single observation decides. The score is the mean of the two frames that object most: one bad
/// observation is a reflection or an edge, two are motion.
class ReprojectionScore {
 public:
  using Needs = Capabilities<capability::metric_depth, capability::past_observations, capability::metric_motion>;
  using Provides = Capabilities<capability::log_likelihoods>;

  struct Options {
    double pixel_sigma = 1.0;      ///< of a found patch that looks unlike, pixels
    double depth_sigmas = 1.5;     ///< measured depth noise over the model's
    double most_from_place = 8.0;  ///< −log ε of the found place, nats
    double most_from_look = 6.0;   ///< of the dissimilarity, nats
    double most_from_depth = 8.0;  ///< of the depth, nats
  };
  Options options;

  double expected_patch = 2.5;  ///< what a static point scores by place and look on average, nats; no option in files

  /// Features without any observation keep NaN.
  template <class Camera>
  void score(const Observations& observations, const Motion& motion, const Camera& camera,
             span<FeatureScore> scores) const {
    const Matches& matches = observations.matches;
    if (matches.past_observations.frames().empty()) return;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      constexpr double kNever = -std::numeric_limits<double>::infinity();
      double most = kNever, second = kNever;
      for (const OlderFrame& frame : matches.past_observations.frames()) {
        const Observation& observation = frame.of_feature[i];
        if (observation.state != ObservationState::seen) continue;
        const double evidence = evidence_of(observation, frame, matches, i, motion, camera);
        second = std::max(second, std::min(most, evidence));
        most = std::max(most, evidence);
      }
      const double through = std::min(kPerViewThrough * matches.past_observations.views_through[i], kMostFromThrough);
      const bool is_seen = most > kNever;
      const double recent = second > kNever ? 0.5 * (most + second) : is_seen ? kSingleShare * most : 0.0;
      if (!is_seen && !(through > 0)) continue;
      scores[i].value = static_cast<float>(recent + through);
    }
  }

 private:
  static constexpr double kPerViewThrough = 4.0;   // nats of each view of the past seconds that saw through its place
  static constexpr double kMostFromThrough = 8.0;  // two such views
  static constexpr double kSingleShare = 0.7;      // of its evidence, where one frame alone saw the place

  static constexpr double kAlikeShare = 0.5;           // σ of a patch that looks just alike, of `pixel_sigma`
  static constexpr double kMotionSigmas = 3.2;         // of the motion's own matches are what a place has here …
  static constexpr double kLeastNoise = 0.3;           // … but no less than this of what is assumed, and no more
  static constexpr double kDrift_px_per_s = 1.0;       // what chained poses and rolling shutter add with time
  static constexpr double kDepthFloor_m = 0.004;       // what is left when the noise model's is nothing
  static constexpr double kDissimilarityScale = 0.12;  // 1 − correlation: static patches exceed it with probability 1/e
  static constexpr double kExpectedDepth = 1.0;        // what a static point scores by depth on average, nats

  /// What the pose's own uncertainty moves a pixel, the same in all directions: f² (σ_ω² + σ_v² / z²). An error that
  /// neighbours share moves the scored feature along with them: it is no disagreement.
  static double pose_variance_sq_px(const Motion& motion, double depth_m, double focal_px) noexcept {
    const auto variance = [&](int axis) { return motion.covariance(axis, axis); };
    const double rotation = (variance(0) + (variance(1) + variance(2))) / 3.0;
    const double translation = (variance(3) + (variance(4) + variance(5))) / 3.0;
    return focal_px * focal_px * (rotation + translation / (depth_m * depth_m)) / motion.correlation;
  }

  /// A patch that looks just alike is located better than one that does not.
  double place_sigma_px(float dissimilarity, double elapsed_s, const Motion& motion) const noexcept {
    const double unlike = std::min(1.0, static_cast<double>(dissimilarity) / kDissimilarityScale);
    const double sigma_px =
        options.pixel_sigma * (kAlikeShare + (1.0 - kAlikeShare) * unlike) + kDrift_px_per_s * elapsed_s;
    if (!(motion.pixel_sigma > 0)) return sigma_px;
    return sigma_px * std::clamp(kMotionSigmas * motion.pixel_sigma / options.pixel_sigma, kLeastNoise, 1.0);
  }

  /// The squared whitened distance from where a static point would be to where its patch was found.
  /// @param translation  of the motion that took it `there`, into the older camera
  /// @param spread       relative standard deviation of its inverse depth
  template <class Camera>
  static double squared_distance(const Vector3d& there, const Vector3d& translation, double spread,
                                 const Vector2f& found, double variance, const Camera& camera) {
    const Vector2d error = camera.project(there) - to_double(found);
    const EpipolarShift<double> shift(camera, translation, there.x(), there.y(), there.z(), there.x() / there.z(),
                                      there.y() / there.z(), spread / there.z());
    return ReprojectionInformation<double>(variance, shift).squared_distance(error.x(), error.y());
  }

  template <class Camera>
  double evidence_of(const Observation& observation, const OlderFrame& frame, const Matches& matches, std::size_t i,
                     const Motion& motion, const Camera& camera) const {
    const Vector3d& point = matches.past_observations.point[i];
    const Vector3d there = frame.reference_from_current * point;
    double evidence = 0;
    if (std::isfinite(observation.dissimilarity)) {
      const double sigma = lens_stretch(camera, to_double(observation.found)) *
                           place_sigma_px(observation.dissimilarity, frame.elapsed_s, motion);
      const double variance = sigma * sigma + pose_variance_sq_px(motion, there.z(), camera.fx());
      const double spread = point.z() * matches.past_observations.inverse_depth_sigma[i];
      const double squared = squared_distance(there, translation_of(frame.reference_from_current), spread,
                                              observation.found, variance, camera);
      const double look = static_cast<double>(observation.dissimilarity) / kDissimilarityScale;
      evidence +=
          std::min(0.5 * squared, options.most_from_place) + std::min(look, options.most_from_look) - expected_patch;
    }
    if (observation.depth_m > 0) {
      const double here_m = matches.current.depth_sigma_m[i], there_m = static_cast<double>(observation.depth_sigma_m);
      const double sigma =
          motion.depth_noise * (options.depth_sigmas * std::sqrt(here_m * here_m + there_m * there_m) + kDepthFloor_m);
      const double error = (static_cast<double>(observation.depth_m) - there.z()) / sigma;
      evidence += std::min(0.5 * error * error, options.most_from_depth) - kExpectedDepth;
    }
    return evidence;
  }
};

using SightingScore [[deprecated("ReprojectionScore")]] = ReprojectionScore;  ///< its name in 0.1; gone in 0.4

template <class Visit>
void each_option(ReprojectionScore& stage, Visit& visit) {
  visit("pixel_sigma", stage.options.pixel_sigma, OptionRange{0.01, 100});
  visit("depth_sigmas", stage.options.depth_sigmas, OptionRange{0.01, 100});
  visit("most_from_place", stage.options.most_from_place, OptionRange{0, 100});
  visit("most_from_look", stage.options.most_from_look, OptionRange{0, 100});
  visit("most_from_depth", stage.options.most_from_depth, OptionRange{0, 100});
  if constexpr (sees_code_only<Visit>::value) visit("expected_patch", stage.expected_patch, OptionRange{-100, 100});
}

}  // namespace stillpoint
