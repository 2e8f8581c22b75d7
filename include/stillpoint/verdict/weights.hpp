// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The answer for hosts that weigh features instead of dropping them.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/frame_result.hpp"

namespace stillpoint {

/// How much each feature may say in an estimate: 1 − the probability that it moves, times its trust, so that what has
/// moved before and is parked now can't drag a pose when it starts again. Where nobody gives a probability it is the
/// trust of a feature that is kept and 0 for one that is dropped. Suspicion errs: no trust below 0.35, so that
/// what was wrongly suspected still holds a pose where little else is left (docs/design/sweeps.md).
/// @param weights  becomes one entry per feature, 0 to 1, in the order of the keypoints. A feature that only the
///                 keep-floor kept has the small weight that it deserves.
inline void weights(const FrameResult& result, std::vector<float>& weights) {
  constexpr float kLeastTrust = 0.35f;
  weights.resize(result.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Label& label = result.label(i);
    const float stands = label.probability >= 0.0f ? 1.0f - std::min(label.probability, 1.0f)
                         : label.keep              ? 1.0f
                                                   : 0.0f;
    weights[i] = stands * std::max(label.trust, kLeastTrust);
  }
}

}  // namespace stillpoint
