// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The answer for hosts that weigh features instead of dropping them.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/frame_result.hpp"

namespace stillpoint {

/// The weight of each feature in an estimate: 1 − the probability that it moves, times its static prior, so that an
/// object that has moved before and is parked now can't drag a pose when it starts again. Where there is no
/// probability, it is the static prior of a feature that is kept and 0 for one that is dropped. The prior errs: it
/// counts as at least 0.35, so that static features with a wrong prior still hold a pose where little else is left
/// (docs/design/sweeps.md).
/// @param weights  becomes one entry per feature, 0 to 1, in the order of the keypoints. A feature that only the
///                 keep-floor kept has the small weight that it deserves.
inline void weights(const FrameResult& result, std::vector<float>& weights) {
  constexpr float kLeastStaticPrior = 0.35f;
  weights.resize(result.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Label& label = result.label(i);
    const float stands = label.probability >= 0.0f ? 1.0f - std::min(label.probability, 1.0f)
                         : label.keep              ? 1.0f
                                                   : 0.0f;
    weights[i] = stands * std::max(label.static_prior, kLeastStaticPrior);
  }
}

}  // namespace stillpoint
