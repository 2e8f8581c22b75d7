// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move?   Robust against dynamic majorities: support by area, trust from memory, the recent past as
// the first hypothesis.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/kabsch.hpp"
#include "stillpoint/motion/reprojection_refinement.hpp"
#include "stillpoint/motion/small_linear_algebra.hpp"
#include "stillpoint/motion/support_constraints.hpp"

namespace stillpoint {

/// The ego-motion of `DefaultPolicies`. Two hypotheses compete: the motion expected from the past, pulled to the
/// nearest consensus, and the best of many minimal samples, drawn by trust. Where they differ, the past wins as long as
/// it explains enough (`consensus_inverted`): what moves with the majority may be a person before the camera.
class SupportMotion {
 public:
  struct Options {
    double inlier_sigmas = 4.0;     ///< beyond it a match supports a hypothesis no more
    int trials = 60;                ///< samples of three points; half static gives (1 − 0.5³)⁶⁰ < 4e-4 to miss
    double past_preference = 0.35;  ///< the past's hypothesis is kept while it has this share of the best one's support
    double same_motion_px = 1.0;    ///< hypotheses that move the matches less apart on average are one
    double least_support = 0.08;    ///< share of all weight that the motion must explain
    double undisputed_share = 0.985;  ///< suspects count in full while the trusted lose no more of their support
    std::size_t fewest_matches = 6;
    std::uint64_t seed = Random::kDefaultSeed;
  };
  Options options;
  SupportConstraints constraints;  ///< noise and weights of what supports a motion

  /// @return status ok, consensus_inverted, no_depth, too_few_matches or no_consensus.
  template <class Camera>
  Motion estimate(const Matches& matches, const Regions& regions, const Camera& camera, const MotionPrior& prior,
                  Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<std::uint32_t> features = workspace.take<std::uint32_t>(matches.size());
    const span<PointConstraint> points = constraints.from_matches(matches, regions, camera, features, workspace);
    Motion motion;
    motion.candidates = static_cast<int>(points.size());
    motion.status = Status::too_few_matches;
    if (points.size() < options.fewest_matches) return motion;

    const Pose expected = prior.current_from_reference ? prior.current_from_reference->inverse() : Pose::Identity();
    const Hypothesis past = polish(expected, points, camera);
    const Hypothesis sampled = best_sample(matches, points, features, camera, past.support, workspace);
    const bool differ =
        sampled.support > past.support && distance_px(sampled, past, points, camera) > options.same_motion_px;
    const bool inverted = differ && past.support > options.past_preference * sampled.support;
    const Hypothesis& trusted = sampled.support > past.support && !inverted ? sampled : past;
    const Hypothesis chosen = with_suspects(trusted, points, camera);

    double weight = 0;
    for (const PointConstraint& point : points) weight += point.weight;
    motion.status = any_depth(matches) ? Status::no_consensus : Status::no_depth;
    if (!(chosen.support > options.least_support * weight) || !any_depth(matches)) return motion;
    motion.status = inverted ? Status::consensus_inverted : Status::ok;
    const double limit = options.inlier_sigmas * options.inlier_sigmas;
    for (const PointConstraint& point : points)
      motion.inliers += squared_residual(point, chosen.reference_from_current, camera) < limit;
    motion.current_from_reference = orthonormalized(chosen.reference_from_current.inverse());
    motion.covariance = covariance(chosen.information);
    return motion;
  }

  /// Refines the motion against all older frames at once: their poses to each other are known, so that one small motion
  /// of the current camera moves them all.
  template <class Camera>
  void refine(Matches& matches, const Regions& regions, const Camera& camera, Motion& motion,
              Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<OlderFrame> frames = matches.sightings.frames();
    const span<PointConstraint> points = constraints.from_sightings(matches, regions, camera, workspace);
    const span<PlaneConstraint> planes = constraints.from_surfaces(matches, workspace);
    if (frames.empty() || points.size() < options.fewest_matches * frames.size()) return;
    const span<Pose> poses = workspace.take<Pose>(frames.size(), Pose::Identity());
    for (std::size_t f = 0; f < frames.size(); ++f) poses[f] = frames[f].reference_from_current;
    constexpr std::array<double, 3> kCutoffs{4.0, 3.0, 3.0};
    const span<Pose> with_suspects = workspace.take<Pose>(frames.size(), Pose::Identity());
    std::copy(poses.begin(), poses.end(), with_suspects.begin());
    Matrix6d information = refine_reprojection(points, planes, poses, kCutoffs, camera);
    if (information.isZero()) return;
    swap_trust(points, planes);
    const Matrix6d of_all = refine_reprojection(points, planes, with_suspects, kCutoffs, camera);
    swap_trust(points, planes);
    const double least = options.undisputed_share * support(poses, points, camera, 0.0);
    if (!of_all.isZero() && support(with_suspects, points, camera, 0.0) > least) {
      std::copy(with_suspects.begin(), with_suspects.end(), poses.begin());
      information = of_all;
    }
    const Pose step = poses[0].inverse() * frames[0].reference_from_current;  // new current from old current
    motion.current_from_reference = orthonormalized(step * motion.current_from_reference);
    motion.covariance = covariance(information);
    for (std::size_t f = 0; f < frames.size(); ++f) frames[f].reference_from_current = poses[f];
  }

 private:
  struct Hypothesis {
    Pose reference_from_current = Pose::Identity();
    Matrix6d information = Matrix6d::Zero();
    double support = 0;  ///< Σ weight · (1 − squared residual / limit) over the inliers
  };

  /// To the weights as if nothing were suspect; a second call goes back.
  static void swap_trust(span<PointConstraint> points, span<PlaneConstraint> planes) noexcept {
    for (PointConstraint& point : points) std::swap(point.weight, point.trusted_weight);
    for (PlaneConstraint& plane : planes) std::swap(plane.weight, plane.trusted_weight);
  }

  /// The motion with suspects in full, where the trusted do not object: what was seen moving is parked, and its points
  /// are as good as any. Where they object, the trusted hypothesis as it is.
  template <class Camera>
  Hypothesis with_suspects(const Hypothesis& trusted, span<PointConstraint> points, const Camera& camera) const {
    swap_trust(points, {});
    Hypothesis all = polish(trusted.reference_from_current, points, camera);
    swap_trust(points, {});
    all.support = support(span<const Pose>(&all.reference_from_current, 1), points, camera, 0.0);
    return all.support > options.undisputed_share * trusted.support ? all : trusted;
  }

  static bool any_depth(const Matches& matches) noexcept {
    return std::any_of(matches.current.depth_m.begin(), matches.current.depth_m.end(), [](double d) { return d > 0; });
  }

  template <class Camera>
  Hypothesis polish(Pose reference_from_current, span<const PointConstraint> points, const Camera& camera) const {
    constexpr std::array<double, 6> kCutoffs{12.0, 8.0, 6.0, 4.0, 4.0, 4.0};
    Hypothesis hypothesis;
    hypothesis.information = refine_reprojection(points, {}, span<Pose>(&reference_from_current, 1), kCutoffs, camera);
    hypothesis.reference_from_current = reference_from_current;
    hypothesis.support = support(span<const Pose>(&reference_from_current, 1), points, camera, 0.0);
    return hypothesis;
  }

  /// @param to_beat  counting ends where this cannot be reached any more
  template <class Camera>
  double support(span<const Pose> poses, span<const PointConstraint> points, const Camera& camera,
                 double to_beat) const {
    const double limit = options.inlier_sigmas * options.inlier_sigmas;
    double left = 0, sum = 0;
    for (const PointConstraint& point : points) left += point.weight;
    for (const PointConstraint& point : points) {
      sum += point.weight * std::max(0.0, 1.0 - squared_residual(point, poses[point.frame], camera) / limit);
      left -= point.weight;
      if (sum + left < to_beat) return 0.0;
    }
    return sum;
  }

  /// The best motion of three points, polished; no support where none beats `to_beat`.
  template <class Camera>
  Hypothesis best_sample(const Matches& matches, span<const PointConstraint> points, span<const std::uint32_t> features,
                         const Camera& camera, double to_beat, Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<std::size_t> metric = workspace.take<std::size_t>(points.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (matches.metric(features[k])) metric[count++] = k;
    if (count < 3) return {};
    Random random(options.seed);
    std::optional<Pose> best;
    for (int trial = 0; trial < options.trials; ++trial) {
      const std::optional<Pose> pose = sample(matches, points, features, metric.first(count), random);
      if (!pose) continue;
      const double found = support(span<const Pose>(&*pose, 1), points, camera, to_beat);
      if (!(found > to_beat)) continue;
      to_beat = found;
      best = pose;
    }
    return best ? polish(*best, points, camera) : Hypothesis{};
  }

  /// Three metric matches, each accepted with the probability of its weight.
  std::optional<Pose> sample(const Matches& matches, span<const PointConstraint> points,
                             span<const std::uint32_t> features, span<const std::size_t> metric, Random& random) const {
    constexpr int kAttempts = 100;
    std::array<Vector3d, 3> current, reference;
    std::array<std::size_t, 3> chosen{};
    std::size_t count = 0;
    for (int attempt = 0; attempt < kAttempts && count < 3; ++attempt) {
      const std::size_t k = metric[random.index(metric.size())];
      const bool again = std::find(chosen.begin(), chosen.begin() + count, k) != chosen.begin() + count;
      if (again || !(random.uniform() < points[k].weight)) continue;
      current[count] = matches.current.point[features[k]];
      reference[count] = matches.reference.point[features[k]];
      chosen[count++] = k;
    }
    if (count < 3) return std::nullopt;
    return kabsch(span<const Vector3d>(current.data(), 3), span<const Vector3d>(reference.data(), 3));
  }

  /// How far apart two hypotheses put the matches, on average; one that is wild counts ten pixels.
  template <class Camera>
  double distance_px(const Hypothesis& a, const Hypothesis& b, span<const PointConstraint> points,
                     const Camera& camera) const {
    constexpr double kFar_px = 10.0;
    double sum = 0;
    for (const PointConstraint& point : points) {
      const Vector3d pa = a.reference_from_current * point.point, pb = b.reference_from_current * point.point;
      const bool both = pa.z() > detail::kNearestDepth_m && pb.z() > detail::kNearestDepth_m;
      sum += both ? std::min((camera.project(pa) - camera.project(pb)).norm(), kFar_px) : kFar_px;
    }
    return sum / static_cast<double>(points.size());
  }

  static Matrix6d covariance(const Matrix6d& information) {
    constexpr double kHold = 1e-6;  // what nothing is known of gets a kilometre
    return Cholesky<6>(information + kHold * Matrix6d::Identity()).inverse();
  }
};

}  // namespace stillpoint
