// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move?   The paper's way (3.3, Eq. 1 to 3): epipolar geometry, with its scale from depth.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/candidates.hpp"
#include "stillpoint/motion/epipolar/epipolar_options.hpp"
#include "stillpoint/motion/epipolar/essential.hpp"
#include "stillpoint/motion/epipolar/fundamental_eight_point.hpp"
#include "stillpoint/motion/epipolar/fundamental_estimator.hpp"
#include "stillpoint/motion/epipolar/fundamental_seven_point.hpp"
#include "stillpoint/motion/epipolar/metric_scale.hpp"
#include "stillpoint/motion/epipolar/parallax.hpp"
#include "stillpoint/motion/motion_covariance.hpp"
#include "stillpoint/motion/ransac.hpp"

namespace stillpoint {

/// The motion that the epipolar constraint of most matches agrees with.
///
/// | status                | when                                                                                     |
/// |-----------------------|------------------------------------------------------------------------------------------|
/// | `too_few_matches`     | fewer than 8 candidates                                                                  |
/// | `rotation_only`       | within the matches' noise a rotation explains nearly what F explains, or half of all     |
/// |                       | where there is no F: the pose has t = 0, a smaller translation can't be told             |
/// | `degenerate_geometry` | the candidates coincide or lie on a line, or the inliers on one plane                    |
/// | `no_consensus`        | no F explains 8 and `min_inlier_share` of the candidates, or none with them in front     |
/// | `no_depth`            | fewer than `min_depths` inliers have depth at both ends: t has no length                 |
class EpipolarMotion {
 public:
  using Needs = Capabilities<capability::matches, capability::metric_depth>;
  using Provides = Capabilities<capability::metric_motion, capability::subpixel_motion>;

  using Solver = EpipolarSolver;
  using Options = EpipolarOptions;
  Options options;

  /// @return current_from_reference in metres. Covariance: from the inliers' Sampson errors and the scale's deviation.
  template <class Camera>
  Motion estimate(const Observations& observations, const Camera& camera, const MotionPrior&,
                  Workspace& workspace) const {
    const Matches& matches = observations.matches;
    const Workspace::Scope scope(workspace);
    Motion motion;
    const auto likely_static = [&](std::size_t i) {
      return observations.remembered.static_prior[i] >= options.least_static_prior;
    };
    const Pairs pairs =
        gather(matches, select_candidates(matches, observations.regions, options.candidates, workspace, likely_static),
               camera, workspace);
    motion.candidates = static_cast<int>(pairs.size());
    motion.metric = !options.unit_translation;
    if (pairs.size() < kLeastMatches) {
      motion.status = Status::too_few_matches;
    } else if (options.solver == Solver::seven) {
      estimate_with<FundamentalSevenPoint>(matches, pairs, camera, motion, workspace);
    } else {
      estimate_with<FundamentalEightPoint>(matches, pairs, camera, motion, workspace);
    }
    return motion;
  }

 private:
  static constexpr std::size_t kLeastMatches = 8;  // seven fit some F always

  /// The candidates in random order, aligned.
  struct Pairs {
    span<std::uint32_t> feature;
    span<Vector2d> reference, current;          // undistorted pixels
    span<Vector3d> reference_ray, current_ray;  // z = 1
    std::size_t size() const noexcept { return feature.size(); }

    Pairs(std::size_t count, Workspace& workspace)
        : feature(workspace.take<std::uint32_t>(count)),
          reference(workspace.take<Vector2d>(count, Vector2d::Zero())),
          current(workspace.take<Vector2d>(count, Vector2d::Zero())),
          reference_ray(workspace.take<Vector3d>(count, Vector3d::Zero())),
          current_ray(workspace.take<Vector3d>(count, Vector3d::Zero())) {}

    /// Keeps those of the mask, in place.
    void keep(span<const std::uint8_t> mask) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0) continue;
        feature[kept] = feature[i];
        reference[kept] = reference[i];
        current[kept] = current[i];
        reference_ray[kept] = reference_ray[i];
        current_ray[kept] = current_ray[i];
        ++kept;
      }
      feature = feature.first(kept);
      reference = reference.first(kept);
      current = current.first(kept);
      reference_ray = reference_ray.first(kept);
      current_ray = current_ray.first(kept);
    }
  };

  template <class Camera>
  Pairs gather(const Matches& matches, span<const std::uint32_t> candidates, const Camera& camera,
               Workspace& workspace) const {
    Pairs pairs(candidates.size(), workspace);
    std::copy(candidates.begin(), candidates.end(), pairs.feature.begin());
    Random random(options.seed);
    shuffle(pairs.feature, random);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      pairs.reference[k] = matches.reference.undistorted[pairs.feature[k]];
      pairs.current[k] = matches.current.undistorted[pairs.feature[k]];
      pairs.reference_ray[k] = camera.back_project(pairs.reference[k], 1.0);
      pairs.current_ray[k] = camera.back_project(pairs.current[k], 1.0);
    }
    return pairs;
  }

  /// How far off a simpler motion may leave a match before that is parallax and not noise. F's own residuals tell the
  /// noise (median absolute deviation: half of the candidates may move), so that a step of millimetres is not taken for
  /// a rotation where the matches are good.
  /// @param f nothing: there is no F, and the threshold stands for the noise
  template <class Estimator>
  double noise_px(const Estimator& estimator, const Matrix3d* f, Workspace& workspace) const {
    constexpr double kLeastNoise_px = 0.01;  // single precision, and what an exact test scene leaves
    double sigma_px = options.threshold_px;
    if (f != nullptr) {
      const Workspace::Scope scope(workspace);
      const span<double> squared = workspace.take<double>(estimator.size());
      for (std::size_t i = 0; i < squared.size(); ++i) {
        const auto residual = static_cast<double>(estimator.squared_residual(*f, i));
        squared[i] = residual >= 0.0 ? residual : std::numeric_limits<double>::infinity();  // NaN on the epipole
      }
      sigma_px = kMadToSigma * std::sqrt(median_in_place(squared));
    }
    return std::min(options.noise_sigmas * std::max(sigma_px, kLeastNoise_px), options.min_parallax_px);
  }

  /// Matches that a rotation explains within `noise` pixels.
  template <class Camera>
  RansacReport<Matrix3d> rotation(const Pairs& pairs, const Camera& camera, double noise, Workspace& workspace) const {
    if (!(noise > 0.0)) return {};
    const RotationEstimator<Camera> estimator(pairs.reference_ray, pairs.current_ray, camera);
    RansacOptions settings = ransac_options(noise, options);
    settings.max_trials = std::min(settings.max_trials, required_trials(0.5, 2, options.confidence, 1000));
    return ransac<InlierCountSupport>(estimator, settings, workspace);
  }

  template <class Camera>
  void conclude_rotation(const Matches& matches, Pairs pairs, const RansacReport<Matrix3d>& rotation,
                         const Camera& camera, Motion& motion) const {
    pairs.keep(rotation.inlier);
    motion.status = Status::ok;
    motion.warnings = Warning::rotation_only;
    motion.inliers = static_cast<int>(rotation.inliers);
    motion.current_from_reference.linear() = rotation.model;
    PixelInformation<Camera> information(motion.current_from_reference, camera);
    for (std::size_t k = 0; k < pairs.size(); ++k)
      information.add_point(pairs.reference_ray[k], pairs.current_ray[k], matches.reference.depth_m[pairs.feature[k]]);
    motion.covariance = information.covariance(0.0);
  }

  /// Eq. 1 to 3. @param pairs a copy of views: narrowed to the inliers here
  template <class MinimalSolver, class Camera>
  void estimate_with(const Matches& matches, Pairs pairs, const Camera& camera, Motion& motion,
                     Workspace& workspace) const {
    const FundamentalEstimator<MinimalSolver> estimator(pairs.reference, pairs.current, workspace);
    const auto report = ransac(estimator, ransac_options(options.threshold_px, options), workspace);
    motion.inliers = static_cast<int>(report.inliers);
    motion.status = report.degenerate == report.trials ? Status::degenerate_geometry : Status::no_consensus;
    const double least = options.min_inlier_share * static_cast<double>(pairs.size());
    const bool found = report.inliers >= kLeastMatches && static_cast<double>(report.inliers) >= least;
    const double noise = noise_px(estimator, found ? &report.model : nullptr, workspace);
    const auto turn = rotation(pairs, camera, noise, workspace);
    const double enough = found ? options.rotation_share * explained(estimator, report.model, noise)
                                : 0.5 * static_cast<double>(pairs.size());
    if (turn.success && static_cast<double>(turn.inliers) >= enough)
      return conclude_rotation(matches, pairs, turn, camera, motion);
    if (!found) return;
    const Matrix3d f = estimator.in_pixels(report.model);
    pairs.keep(report.inlier);
    if (planar(pairs, f, std::min(noise, options.threshold_px), workspace)) {
      motion.status = Status::degenerate_geometry;
      return;
    }
    const Matrix3d k = camera.matrix();
    const Matrix3d e = options.printed_eq3 ? essential_as_printed(f, k) : essential_from_fundamental(f, k);
    const CheiralPose cheiral = choose_in_front(decompose_essential(e), pairs.reference_ray, pairs.current_ray);
    if (2 * cheiral.in_front <= pairs.size() && !options.printed_eq3) return;
    give_length(matches, pairs, cheiral.current_from_reference, camera, motion, workspace);
  }

  /// How many matches F explains within `noise` pixels.
  template <class Estimator>
  static double explained(const Estimator& estimator, const Matrix3d& model, double noise) {
    double count = 0.0;
    for (std::size_t i = 0; i < estimator.size(); ++i)
      count += static_cast<double>(estimator.squared_residual(model, i)) <= noise * noise ? 1.0 : 0.0;
    return count;
  }

  /// Does one plane's homography explain nearly all inliers within `noise` pixels? The wider that is, the more steps of
  /// a few millimetres in a room look flat, although their F is good enough for a pose.
  bool planar(const Pairs& pairs, const Matrix3d& f, double noise, Workspace& workspace) const {
    if (!(options.planar_share <= 1.0) || !(noise > 0.0)) return false;
    const Normalization from_reference{span<const Vector2d>(pairs.reference)};
    const Normalization from_current{span<const Vector2d>(pairs.current)};
    const span<Vector2d> reference = workspace.take<Vector2d>(pairs.size(), Vector2d::Zero());
    const span<Vector2d> current = workspace.take<Vector2d>(pairs.size(), Vector2d::Zero());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      reference[i] = from_reference(pairs.reference[i]);
      current[i] = from_current(pairs.current[i]);
    }
    const Matrix3d normalised = from_current.matrix().inverse().transpose() * f * from_reference.matrix().inverse();
    const PlaneEstimator estimator(reference, current, normalised / normalised.norm(), 1.0 / from_current.scale);
    RansacOptions settings = ransac_options(noise, options);
    settings.max_trials = std::min(settings.max_trials, required_trials(options.planar_share, 3, 0.9999, 1000));
    const auto report = ransac<InlierCountSupport>(estimator, settings, workspace);
    return static_cast<double>(report.inliers) >= options.planar_share * static_cast<double>(pairs.size());
  }

  template <class Camera>
  void give_length(const Matches& matches, const Pairs& inliers, Pose pose, const Camera& camera, Motion& motion,
                   Workspace& workspace) const {
    double length_sigma_m = std::numeric_limits<double>::infinity();
    if (!options.unit_translation) {
      const std::optional<MetricScale> scale = length(matches, inliers, pose, camera, workspace);
      if (!scale) {
        motion.status = Status::no_depth;
        return;
      }
      pose.translation() *= scale->metres;  // a negative one corrects a direction that triangulation could not tell
      length_sigma_m = scale->sigma_m;
    }
    motion.status = Status::ok;
    motion.current_from_reference = pose;
    PixelInformation<Camera> information(pose, camera);
    for (std::size_t k = 0; k < inliers.size(); ++k)
      information.add_epipolar(inliers.reference_ray[k], inliers.current_ray[k]);
    motion.covariance = information.covariance(length_sigma_m);
  }

  template <class Camera>
  std::optional<MetricScale> length(const Matches& matches, const Pairs& inliers, const Pose& pose,
                                    const Camera& camera, Workspace& workspace) const {
    const span<ScaleVote> votes = workspace.take<ScaleVote>(inliers.size());
    std::size_t count = 0;
    for (const std::uint32_t i : inliers.feature) {
      if (!matches.metric(i)) continue;
      const Vector3d turned = pose.linear() * matches.reference.point[i];
      votes[count++] =
          scale_vote(turned, matches.reference.depth_m[i], matches.reference.depth_sigma_m[i], matches.current.point[i],
                     matches.current.depth_sigma_m[i], pose.translation(), options.pixel_sigma_px / camera.fx());
    }
    return metric_scale(votes.first(count), options.min_depths);
  }
};

template <class Visit>
void each_option(EpipolarMotion& stage, Visit& visit) {
  each_option(stage.options, visit);
}

}  // namespace stillpoint
