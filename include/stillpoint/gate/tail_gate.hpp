// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which disagreement is more than noise?   A score whose false-positive rate the user sets, learned from static
// features.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The scores of static points have an exponential tail: the share that the filter drops, P, falls by e with every
/// `kDecay` nats, P(level) = exp(−(level − s₁) / decay) / 100. Measured with the whole filter, clusters and memory
/// included, on a real recording without a mover (143 frames, 1000 keypoints): 1.2 % at 1.7, 0.9 % at 2.0, 0.6 % at
/// 2.3, 0.35 % at 2.8, 0.13 % at 3.3. The default s₁ keeps a margin of a third.
///
/// That is the prior. A room that shines more, a camera with a worse depth have a longer tail, which is learned from
/// what memory knows to stand: when more of it than the rate gets evidence of moving, the level rises, step by step
/// (Robbins and Monro, 1951), and sinks back when less does, to the prior's and no lower: nothing to be seen for a
/// while is no proof that nothing will be. What starts to move adds to the count for a few frames; a step is bounded.
class TailGate {
 public:
  using Needs = Capabilities<capability::log_likelihoods>;
  using Provides = Capabilities<capability::tail_threshold>;

  struct Options {
    double false_positive_rate = 0.01;  ///< share of static features that may be dropped, 1e-6 to 0.5
  };
  Options options;

  double gain =
      0.01;  ///< nats that the level sinks in a frame without any excess, 0 learns nothing; no option in files

  Threshold threshold(span<const FeatureScore>, const Regions&, Workspace&) const {
    return {kLevelOfOnePercent - kDecay * std::log(options.false_positive_rate / 0.01) + raised_};
  }

  /// Learns from the host's features that stood until now.
  /// @param labels  with the log-odds of this frame alone
  void learn(const Observations& observations, span<const Label> labels) {
    const Remembered& remembered = observations.remembered;
    std::size_t known = 0, exceeding = 0;
    for (std::size_t i = 0; i < observations.matches.host_count; ++i) {
      if (!(remembered.log_odds[i] < kStaticBelow) || !(remembered.static_prior[i] > kLeastStaticPrior)) continue;
      ++known;
      exceeding += labels[i].log_odds > 0;
    }
    if (known < kFewestStatic) return;
    const double times_the_rate =
        static_cast<double>(exceeding) / (options.false_positive_rate * static_cast<double>(known));
    raised_ += gain * (std::min(times_the_rate, kMostExcess) - 1.0);
    raised_ = std::clamp(raised_, 0.0, kMostRaised);
  }

  /// How far the level has been raised above the prior's, nats.
  double raised() const noexcept { return raised_; }

  void reset() noexcept { raised_ = 0.0; }

 private:
  static constexpr double kLevelOfOnePercent = 2.3;  // s₁, nats
  static constexpr double kDecay = 0.8;              // nats in which the tail falls by e
  static constexpr double kMostExcess = 2.0;         // times the rate that a frame may count; a mover is no noise
  static constexpr double kMostRaised = 3.0;         // nats
  static constexpr float kStaticBelow = -1.5f;       // remembered log-odds of what is known to be static, nats
  static constexpr float kLeastStaticPrior = 0.95f;  // nothing nearby moved before
  static constexpr std::size_t kFewestStatic = 50;   // of them in a frame; fewer teach nothing

  double raised_ = 0.0;
};

template <class Visit>
void each_option(TailGate& stage, Visit& visit) {
  visit("false_positive_rate", stage.options.false_positive_rate, OptionRange{1e-6, 0.5});
  if constexpr (sees_code_only<Visit>::value) visit("gain", stage.gain, OptionRange{0, 10});
}

}  // namespace stillpoint
