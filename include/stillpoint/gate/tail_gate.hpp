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

/// The scores of standing points have an exponential tail: the share that the filter drops, P, falls by e with every
/// `decay` nats, P(level) = exp(−(level − s₁) / decay) / 100. Measured with the whole filter, clusters and memory
/// included, on a real recording without a mover (143 frames, 1000 key points): 1.2 % at 1.7, 0.9 % at 2.0, 0.6 % at
/// 2.3, 0.35 % at 2.8, 0.13 % at 3.3. The default s₁ keeps a margin of a third: other rooms shine more.
class TailGate {
 public:
  struct Options {
    double false_positive_rate = 0.01;  ///< share of standing features that may be dropped, 1e-6 to 0.5
    double level_of_one_percent = 2.3;  ///< s₁, nats
    double decay = 0.8;                 ///< nats in which the tail falls by e
  };
  Options options;

  Threshold threshold(span<const FeatureScore>, const Regions&, Workspace&) const {
    const double rate = std::clamp(options.false_positive_rate, 1e-6, 0.5);
    return {options.level_of_one_percent - options.decay * std::log(rate / 0.01)};
  }
};

}  // namespace stillpoint
