// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move?   Robust against dynamic majorities: support by area, a static prior from memory, the recent
// past as the first hypothesis.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/plausible_motion.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/ransac.hpp"
#include "stillpoint/motion/rigid/fixed_to_camera.hpp"
#include "stillpoint/motion/rigid/inertia.hpp"
#include "stillpoint/motion/rigid/minimal_sample.hpp"
#include "stillpoint/motion/rigid/slow_motion.hpp"
#include "stillpoint/motion/rigid/stationary_camera.hpp"
#include "stillpoint/motion/rigid/support_constraints.hpp"
#include "stillpoint/motion/rigid/support_problem.hpp"

namespace stillpoint {

/// The ego-motion of `DefaultPolicies`. Two hypotheses compete: the motion expected from the past, pulled to the
/// nearest consensus, and the best of many minimal samples, drawn by weight. Where they differ, the past wins as long
/// as it explains enough (`consensus_inverted`): the majority may be a person before the camera. What the host tells of
/// the motion is believed against more, if a consensus confirms it. A stationary camera has no motion at all.
class SupportMotion {
 public:
  using Needs = Capabilities<capability::matches, capability::metric_depth>;
  using Provides = Capabilities<capability::metric_motion, capability::subpixel_motion>;

  struct Options {
    double inlier_sigmas = 4.0;   ///< beyond it a match supports a hypothesis no more
    std::size_t max_trials = 60;  ///< samples of three points: half static are missed with (1 − 0.5³)⁶⁰ < 4e-4
    std::uint64_t seed = Random::kDefaultSeed;
  };
  Options options;
  SupportConstraints constraints;      ///< noise and weights of what supports a motion
  StationaryCamera stationary_camera;  ///< when has the camera no motion at all?
  FixedToCamera fixed_to_camera;       ///< what says nothing of the world?
  Inertia inertia;                     ///< what its velocity knows

  // No option in files.
  double past_preference = 0.35;  ///< the past's hypothesis is kept while it has this share of the best one's support
  bool measures_noise = true;     ///< of pixels and depths in each frame; false: it is as assumed

  /// @return status ok (perhaps with the warning consensus_inverted), no_depth, too_few_matches or no_consensus.
  template <class Camera>
  Motion estimate(const Observations& observations, const Camera& camera, const MotionPrior& prior,
                  Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const Matches& matches = observations.matches;
    const span<PointConstraint> points = constraints.from_matches(observations, camera, workspace);
    Motion motion;
    motion.candidates = static_cast<int>(points.size());
    motion.status = Status::too_few_matches;
    if (points.size() < kFewestMatches) return motion;
    fixed_to_camera.down_weight(points, matches.size(), camera, workspace);

    const span<const OlderFrame> frames = matches.past_observations.frames();
    auto problem =
        problem_of(points, frames.first(std::min<std::size_t>(frames.size(), 1)), observations, camera, workspace);
    const Selection selection = select(prior, matches, problem, workspace);
    motion.pixel_sigma = selection.noise.pixel_sigma;
    motion.depth_noise = selection.noise.depth_scale;
    problem.set_pixel_sigma(motion.pixel_sigma);
    motion.stationary = stationary_camera.since_last_frame(observations, prior.stationary) &&
                        !has_slow_motion(resting(points, matches, workspace), camera, options.inlier_sigmas,
                                         least_noise(), most_noise(), workspace);
    const Hypothesis chosen =
        motion.stationary ? at_rest(problem) : with_all_points(selection.hypothesis, selection.cutoffs, problem);

    motion.status = matches.current.any_depth() ? Status::no_consensus : Status::no_depth;
    const double explained = problem.point_support(chosen.reference_from_current) / problem.total_weight();
    if (!(explained > kLeastSupport) || motion.status == Status::no_depth) return motion;
    const Pose current_from_reference = orthonormalized(inverted(chosen.reference_from_current));
    if (!is_plausible_motion(current_from_reference)) return motion;  // what is kilometres away fits any
    motion.status = Status::ok;
    const std::size_t corners = matches.size() - matches.host_count;  // of the matcher's own, found again or not
    const bool are_few_found = static_cast<double>(points.size()) < kFewFound * static_cast<double>(corners);
    motion.doubtful = (are_few_found && motion.depth_noise >= kDoubtfulDepthNoise) ||
                      (motion.depth_noise >= kMostDepthNoise && explained < kSureSupport);
    if (selection.is_inverted) motion.warnings = Warning::consensus_inverted;
    motion.inliers = problem.inliers(chosen.reference_from_current);
    set_pose(current_from_reference, chosen.information, prior, motion);
    return motion;
  }

  /// Refines the motion against all older frames at once: their poses to each other are known, so that one small motion
  /// of the current camera moves them all.
  template <class Camera>
  void refine(Observations& observations, const Camera& camera, const MotionPrior& prior, Motion& motion,
              Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    if (motion.stationary && stationary_camera.since_older_frames(observations)) return;
    motion.stationary = false;
    const span<OlderFrame> frames = observations.matches.past_observations.frames();
    const span<PointConstraint> points = constraints.from_past_observations(observations, camera, workspace);
    if (frames.empty() || points.size() < kFewestMatches * frames.size()) return;
    fixed_to_camera.down_weight(points, observations.matches.size(), camera, workspace);
    auto problem = problem_of(points, frames, observations, camera, workspace);
    problem.calibrate(frames[0].reference_from_current, least_noise(), most_noise(), workspace);
    Hypothesis weighted;
    weighted.reference_from_current = frames[0].reference_from_current;
    weighted.information = problem.refine(weighted.reference_from_current, kNearCutoffs);
    if (weighted.information.isZero()) return;
    weighted.support = problem.support(weighted.reference_from_current);
    const Hypothesis chosen = with_all_points(weighted, kNearCutoffs, problem);
    const Pose step = composed(inverted(chosen.reference_from_current), frames[0].reference_from_current);
    const Pose estimated = motion.current_from_reference, refined = orthonormalized(composed(step, estimated));
    if (!is_plausible_motion(refined)) return;
    set_pose(refined, chosen.information, prior, motion);
    const Pose back = composed(estimated, inverted(motion.current_from_reference));  // old current camera from the new
    for (OlderFrame& frame : frames)
      frame.reference_from_current = orthonormalized(composed(frame.reference_from_current, back));
  }

 private:
  static constexpr double kConfidence = 0.9996;   // of not missing what explains more than the past
  static constexpr double kSameMotion_px = 1.0;   // hypotheses that move the matches less apart on average are one
  static constexpr double kSameAsTold_px = 1.5;   // a motion that the host tells is confirmed by a consensus so near
  static constexpr double kToldPreference = 0.1;  // then it is kept with less support than the past's
  static constexpr double kLeastSupport = 0.08;   // share of all weight that the motion must explain
  static constexpr double kFewFound = 0.2;  // of the matcher's corners: where the image has jumped, most are lost …
  static constexpr double kDoubtfulDepthNoise = 2.0;  // … and what is left fits by chance, but for its depths
  static constexpr double kSureSupport = 0.4;         // less is doubtful where depths do not fit near what is expected
  static constexpr double kMostPriorLoss = 12.6;    // 95 % quantile of χ²₆: what all points at full weight may cost
  static constexpr double kFinerNoise = 0.7;        // of the past's: with less, both hypotheses are compared
  static constexpr double kLeastPixelSigma = 0.1;   // of the measured noise; the most is `constraints.pixel_sigma`
  static constexpr double kMostDepthNoise = 4.0;    // of the measured depth noise over the assumed; the least is 1
  static constexpr std::size_t kFewestMatches = 6;  // twice a minimal sample

  static constexpr std::array<double, 3> kFarCutoffs{12.0, 6.0, 4.0};  // from a pose that is a guess
  static constexpr std::array<double, 2> kAgainCutoffs{12.0, 4.0};     // from one that was refined already
  static constexpr std::array<double, 2> kNearCutoffs{4.0, 3.0};

  using Hypothesis = MotionHypothesis;
  /// The hypothesis that wins.
  struct Selection {
    Hypothesis hypothesis;
    span<const double> cutoffs;  ///< with which it is refined further
    SupportNoise noise;
    bool is_inverted;  ///< the past wins although a sample explains more
  };

  /// Lets the motion expected from the past compete with the best sample, and measures the noise.
  template <class Camera>
  Selection select(const MotionPrior& prior, const Matches& matches, SupportProblem<Camera>& problem,
                   Workspace& workspace) const {
    const Pose expected = prior.current_from_reference ? inverted(*prior.current_from_reference) : Pose::Identity();
    Hypothesis past = problem.refined(expected, kFarCutoffs);
    const SupportNoise noise = problem.calibrate(past.reference_from_current, least_noise(), most_noise(), workspace);
    const std::optional<Hypothesis> told = prior.is_told ? consensus_at(expected, problem) : std::nullopt;
    past = told ? *told : problem.refined(past.reference_from_current, kAgainCutoffs);
    const span<const double> cutoffs = told ? span<const double>(kNearCutoffs) : kAgainCutoffs;
    const double preference = told ? kToldPreference : past_preference;
    const Rivals rivals = rivals_of(past, noise.pixel_sigma, cutoffs, matches, problem, workspace);
    const bool explains_more = rivals.sampled.support > rivals.past.support;
    const bool is_inverted =
        explains_more && prior.current_from_reference && are_two_motions(rivals, preference, problem, workspace);
    if (!explains_more || is_inverted) return {past, cutoffs, noise, is_inverted};
    return {rivals.sampled, cutoffs, {rivals.pixel_sigma, noise.depth_scale}, false};
  }

  /// The consensus at a motion that the host tells, if there is one.
  template <class Camera>
  static std::optional<Hypothesis> consensus_at(const Pose& told, const SupportProblem<Camera>& problem) {
    const Hypothesis near = problem.refined(told, kNearCutoffs);
    if (!(problem.distance_px(near.reference_from_current, told) < kSameAsTold_px)) return std::nullopt;
    return near;
  }

  /// Points, and the surfaces that were found in these frames, if there are any.
  template <class Camera>
  SupportProblem<Camera> problem_of(span<PointConstraint> points, span<const OlderFrame> frames,
                                    const Observations& observations, const Camera& camera,
                                    Workspace& workspace) const {
    const std::size_t count = std::max<std::size_t>(frames.size(), 1);
    const span<Pose> poses = workspace.take<Pose>(count, Pose::Identity());
    const span<Pose> links = workspace.take<Pose>(count, Pose::Identity());
    for (std::size_t f = 0; f < frames.size(); ++f) poses[f] = frames[f].reference_from_current;
    return {points, constraints.from_surfaces(observations, frames, workspace),
            poses,  links,
            camera, options.inlier_sigmas};
  }

  span<PointConstraint> resting(span<const PointConstraint> points, const Matches& matches,
                                Workspace& workspace) const {
    const span<PointConstraint> found = workspace.take<PointConstraint>(points.size());
    const auto end = std::copy_if(points.begin(), points.end(), found.begin(), [&](const PointConstraint& point) {
      return stationary_camera.at_rest(matches, point.feature);
    });
    return found.first(static_cast<std::size_t>(end - found.begin()));
  }

  /// No motion, as well known as the support allows.
  template <class Camera>
  Hypothesis at_rest(const SupportProblem<Camera>& problem) const {
    Hypothesis hypothesis = problem.refined(Pose::Identity(), span<const double>(kNearCutoffs).first(1));
    hypothesis.reference_from_current = Pose::Identity();
    return hypothesis;
  }

  /// The motion with all points at full weight, where the support weighted by the static prior hardly falls: objects
  /// that moved before are parked, and their points are as good as any. Else the weighted hypothesis as it is: an
  /// object that has just started would take the motion along. Of static points the loss is distributed as χ²₆.
  template <class Camera>
  Hypothesis with_all_points(const Hypothesis& weighted, span<const double> cutoffs,
                             SupportProblem<Camera>& problem) const {
    Hypothesis all = weighted;
    problem.swap_weights();
    all.information = problem.refine(all.reference_from_current, cutoffs);
    problem.swap_weights();
    if (all.information.isZero()) return weighted;
    all.support = problem.support(all.reference_from_current);
    return problem.squared_residuals_of(weighted.support - all.support) < kMostPriorLoss ? all : weighted;
  }

  SupportNoise least_noise() const noexcept { return {measures_noise ? kLeastPixelSigma : constraints.pixel_sigma, 1}; }
  SupportNoise most_noise() const noexcept { return {constraints.pixel_sigma, measures_noise ? kMostDepthNoise : 1.0}; }

  /// The two hypotheses as they are compared.
  struct Rivals {
    Hypothesis past, sampled;
    double pixel_sigma;
  };

  /// A past that is a blend of two motions looks noisy, and explains with that noise what the right one does without:
  /// where the best sample has clearly less, both are refined and compared with it. Else a sample is a rival only if
  /// it explains more points than the past even before it is refined.
  template <class Camera>
  Rivals rivals_of(const Hypothesis& past, double pixel_sigma, span<const double> cutoffs, const Matches& matches,
                   SupportProblem<Camera>& problem, Workspace& workspace) const {
    const double to_beat = problem.point_support(past.reference_from_current);
    const bool may_be_finer = kFinerNoise * pixel_sigma > kLeastPixelSigma;
    // What explains more than the past does has at least its share of inliers.
    const double share = to_beat / problem.total_weight();
    const std::size_t trials = required_trials(share, 3, kConfidence, options.max_trials);
    Random random(options.seed);
    const Hypothesis sample = best_sample(trials, may_be_finer ? 0.0 : to_beat, matches, problem, random, workspace);
    if (!(sample.support > 0)) return {past, {}, pixel_sigma};
    const Hypothesis sampled = problem.refined(sample.reference_from_current, kFarCutoffs);
    const Pose& by_sample = sampled.reference_from_current;
    const double sampled_px =
        may_be_finer ? problem.noise_at(by_sample, least_noise(), most_noise(), workspace).pixel_sigma : pixel_sigma;
    if (!(sampled_px < kFinerNoise * pixel_sigma))
      return {past, sample.support > to_beat ? sampled : Hypothesis{}, pixel_sigma};
    problem.set_pixel_sigma(sampled_px);
    return {problem.refined(past.reference_from_current, cutoffs), problem.refined(by_sample, kNearCutoffs),
            sampled_px};
  }

  /// A wrong local minimum explains nothing that the right motion does not explain as well; a second motion does.
  /// @param preference  what the past alone explains is more than this share of what the sample alone explains
  template <class Camera>
  static bool are_two_motions(const Rivals& rivals, double preference, const SupportProblem<Camera>& problem,
                              Workspace& workspace) {
    const Pose &by_past = rivals.past.reference_from_current, &by_sample = rivals.sampled.reference_from_current;
    if (!(problem.distance_px(by_sample, by_past) > kSameMotion_px)) return false;
    const ExclusiveSupport exclusive = problem.exclusive_support(by_past, by_sample, workspace);
    return exclusive.one > preference * exclusive.other;
  }

  /// Writes a pose that was found and its covariance, with what the camera's velocity knows.
  void set_pose(const Pose& current_from_reference, Matrix6d information, const MotionPrior& prior,
                Motion& motion) const {
    constexpr double kHold = 1e-6;  // what nothing is known of gets kilometres
    motion.current_from_reference = !motion.stationary && inertia.applies(prior)
                                        ? inertia.fuse(current_from_reference, information, prior)
                                        : current_from_reference;
    motion.correlation = Inertia::kCorrelated;
    motion.covariance = Inertia::kCorrelated * Cholesky<6>(damped(information, kHold)).inverse();
  }
};

template <class Visit>
void each_option(SupportMotion& stage, Visit& visit) {
  visit("inlier_sigmas", stage.options.inlier_sigmas, OptionRange{0.1, 100});
  visit("max_trials", stage.options.max_trials, OptionRange{0, 1e4});
  visit.seed("seed", stage.options.seed);
  if constexpr (sees_code_only<Visit>::value) visit("past_preference", stage.past_preference, OptionRange{0, 1e6});
  visit("constraints", stage.constraints);
  visit("inertia", stage.inertia);
}

}  // namespace stillpoint
