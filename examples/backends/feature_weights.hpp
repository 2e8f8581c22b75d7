// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How much each feature of a frame may say in its pose.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/span.hpp"

namespace examples {

/// One number per feature, 0 to 1; none at all: each counts in full.
class FeatureWeights {
 public:
  void assign(stillpoint::span<const float> weights) { weights_.assign(weights.begin(), weights.end()); }

  void compact(stillpoint::span<const std::uint8_t> keep) {
    if (!weights_.empty()) stillpoint::compact(keep, weights_);
  }

  /// Not 0 for what the filter has kept, be it by its keep-floor alone: where nothing else is left, it decides.
  double operator[](std::size_t i) const {
    constexpr float kLeast = 0.01f;
    return weights_.empty() ? 1.0 : static_cast<double>(weights_[i] > kLeast ? weights_[i] : kLeast);
  }

 private:
  std::vector<float> weights_;
};

}  // namespace examples
