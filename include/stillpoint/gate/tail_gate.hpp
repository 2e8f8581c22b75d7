// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which disagreement is more than noise?   A score whose false-positive rate the user sets.

#include <algorithm>
#include <cmath>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The scores of standing points have an exponential tail, P(score > s) = exp(−(s − s₁) / decay) / 100. Both figures
/// come from static recordings and scenes (docs/benchmarks.md); the level is where the tail falls to the wanted rate.
class TailGate {
 public:
  struct Options {
    double false_positive_rate = 0.01;  ///< share of standing features that may be dropped, 1e-6 to 0.5
    double level_of_one_percent = 4.0;  ///< s₁, nats: what 1 % of standing features exceed
    double decay = 1.3;                 ///< nats in which the tail falls by e
  };
  Options options;

  Threshold threshold(span<const FeatureScore>, const Regions&, Workspace&) const {
    const double rate = std::clamp(options.false_positive_rate, 1e-6, 0.5);
    return {options.level_of_one_percent - options.decay * std::log(rate / 0.01)};
  }
};

}  // namespace stillpoint
