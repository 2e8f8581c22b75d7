// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// `DefaultPolicies` with stages that can be told, while the program runs, to do what the paper does instead.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/match/lucas_kanade.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint_run {

/// Support by the host's keypoints, followed by Lucas-Kanade, in place of corners one a cell.
struct SwitchedMatcher : stillpoint::PatchMatcher {
  bool supports_by_area = true;
  stillpoint::LucasKanade key_points;

  void match(const stillpoint::FrameView& reference, const stillpoint::FrameView& current,
             stillpoint::Matches& matches) {
    if (supports_by_area) return stillpoint::PatchMatcher::match(reference, current, matches);
    const std::size_t count = matches.host_count;
    matches.resize(2 * count);  // behind the host's features stand copies: those of the support
    std::copy_n(matches.current.pixel.begin(), count,
                matches.current.pixel.begin() + static_cast<std::ptrdiff_t>(count));
    key_points.match(reference, current, matches);
    for (std::size_t i = 0; i < count; ++i)
      if (matches.matched(i)) matches.state[i] = stillpoint::MatchState::lost;
  }

  void reset() noexcept {
    stillpoint::PatchMatcher::reset();
    key_points.reset();
  }
};

/// One of three ego-motions.
struct SwitchedMotion {
  enum class Kind { support, rigid, epipolar };
  Kind kind = Kind::support;
  stillpoint::SupportMotion support;
  stillpoint::RigidMotion rigid;
  stillpoint::EpipolarMotion epipolar;

  template <class Camera>
  stillpoint::Motion estimate(const stillpoint::Observations& observations, const Camera& camera,
                              const stillpoint::MotionPrior& prior, stillpoint::Workspace& workspace) const {
    if (kind == Kind::rigid) return rigid.estimate(observations, camera, prior, workspace);
    if (kind == Kind::epipolar) return epipolar.estimate(observations, camera, prior, workspace);
    return support.estimate(observations, camera, prior, workspace);
  }

  template <class Camera>
  void refine(stillpoint::Observations& observations, const Camera& camera, const stillpoint::MotionPrior& prior,
              stillpoint::Motion& motion, stillpoint::Workspace& workspace) const {
    if (kind == Kind::support) support.refine(observations, camera, prior, motion, workspace);
  }
};

/// Options in files are those of the default motion.
template <class Visit>
void each_option(SwitchedMotion& motion, Visit& visit) {
  each_option(motion.support, visit);
}

/// Eq. 9 of each older frame in which a feature was found, the mean of the two greatest (half of it where there is
/// one), in place of likelihoods.
struct SwitchedScore : stillpoint::ReprojectionScore {
  bool is_whitened = true;
  stillpoint::OffsetScore offset;

  /// The fairest scale that two numbers can be: median and 99th percentile of static features in
  /// synthetic::static_room become those that likelihoods have there.
  double scaled(double value) const noexcept {
    constexpr double kMedian = 0.0102, kOnePercent = 0.0306, kLikelihoodMedian = -0.94, kLikelihoodOnePercent = 3.06;
    return kLikelihoodMedian +
           (value - kMedian) * (kLikelihoodOnePercent - kLikelihoodMedian) / (kOnePercent - kMedian);
  }

  template <class Camera>
  void score(const stillpoint::Observations& observations, const stillpoint::Motion& motion, const Camera& camera,
             stillpoint::span<stillpoint::FeatureScore> scores) const {
    if (is_whitened) return stillpoint::ReprojectionScore::score(observations, motion, camera, scores);
    const stillpoint::Matches& matches = observations.matches;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      double most = 0, second = 0;
      bool is_seen = false;
      for (const stillpoint::OlderFrame& frame : matches.past_observations.frames()) {
        const stillpoint::Observation& observation = frame.of_feature[i];
        if (!std::isfinite(observation.dissimilarity) || !(observation.depth_m > 0)) continue;
        is_seen = true;
        const double value = offset.offset(frame.reference_from_current * matches.current.point[i],
                                           camera.back_project(observation.found.cast<double>(), observation.depth_m));
        second = std::max(second, std::min(most, value));
        most = std::max(most, value);
      }
      if (is_seen) scores[i].value = static_cast<float>(scaled(0.5 * (most + second)));
    }
  }
};

/// The mean of static features in place of the tail of its scores.
struct SwitchedGate : stillpoint::TailGate {
  bool is_calibrated = true;
  float lowest = 0;  ///< the classifier's: it judges scores below as this one, and so does the mean
  stillpoint::MeanGate mean;

  stillpoint::Threshold threshold(stillpoint::span<const stillpoint::FeatureScore> scores,
                                  const stillpoint::Regions& regions, stillpoint::Workspace& workspace) const {
    if (is_calibrated) return stillpoint::TailGate::threshold(scores, regions, workspace);
    const stillpoint::Workspace::Scope scope(workspace);
    const auto held = workspace.take<stillpoint::FeatureScore>(scores.size());
    for (std::size_t i = 0; i < scores.size(); ++i)
      if (scores[i].scored()) held[i].value = std::max(scores[i].value, lowest);
    return mean.threshold(held, regions, workspace);
  }
};

/// Features in dynamic regions alone are tested, where the prior is all that says where to look.
struct SwitchedClusters : stillpoint::SurfaceClusters {
  bool tests_all = true;

  void classify(const stillpoint::Observations& observations, const stillpoint::Evidence& evidence,
                stillpoint::span<stillpoint::Label> labels, stillpoint::Workspace& workspace) const {
    stillpoint::SurfaceClusters::classify(observations, evidence, labels, workspace);
    if (tests_all) return;
    for (std::size_t i = 0; i < observations.size(); ++i)
      if (!observations.regions.of_feature[i].in_dynamic) labels[i].log_odds = std::min(labels[i].log_odds, kAlone);
  }
};

/// The depth at the rounded pixel in place of one whose neighbours agree.
struct SwitchedDepth : stillpoint::GuardedDepth {
  bool is_guarded = true;

  template <class Noise = stillpoint::KinectNoise>
  double at(const stillpoint::DepthView& depth, const stillpoint::Vector2f& pixel, const Noise& noise = {}) const {
    return is_guarded ? stillpoint::GuardedDepth::at(depth, pixel, noise) : stillpoint::RoundedDepth().at(depth, pixel);
  }
};

/// As `DefaultPolicies`, byte for byte, until something is switched.
struct SwitchedPolicies : stillpoint::DefaultPolicies {
  using DepthLookup = SwitchedDepth;
  using Matcher = SwitchedMatcher;
  using EgoMotion = SwitchedMotion;
  using Scorer = SwitchedScore;
  using Gate = SwitchedGate;
  using Classifier = SwitchedClusters;
};

}  // namespace stillpoint_run
