// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Robust statistics over spans, and means that forget.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Makes the median absolute deviation a standard deviation where the values are normal: 1 / Φ⁻¹(3/4).
inline constexpr double kMadToSigma = 1.4826;

/// The median (lower one of an even count). Reorders `values`. O(n). At least one value, none NaN.
template <class Scalar>
Scalar median_in_place(span<Scalar> values) {
  Scalar* const middle = values.begin() + (values.size() - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The q-quantile by the nearest-rank rule, q in [0, 1]. Reorders `values`. O(n). At least one value, none NaN.
template <class Scalar>
Scalar quantile_in_place(span<Scalar> values, double q) {
  const double rank = std::ceil(q * static_cast<double>(values.size())) - 1.0;
  const auto index = static_cast<std::size_t>(std::max(rank, 0.0));
  Scalar* const nth = values.begin() + std::min(index, values.size() - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The share of a new value in a mean that forgets with a time constant: 1 − exp(−Δt / τ), for steps of any length.
inline double exponential_share(double elapsed_s, double time_constant_s) noexcept {
  return 1.0 - std::exp(-elapsed_s / time_constant_s);
}

}  // namespace stillpoint
