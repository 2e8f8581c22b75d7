// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a list of errors says as a whole, and how much smaller one figure is than another.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Summary of a list of errors, in the errors' unit. Everything but `count` is NaN when the list is empty.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = std::numeric_limits<double>::quiet_NaN();
  double mean = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();  ///< of an even count: half-way between the middle two
  double std = std::numeric_limits<double>::quiet_NaN();     ///< of the errors themselves (divided by N, not N − 1)
  double min = std::numeric_limits<double>::quiet_NaN();
  double max = std::numeric_limits<double>::quiet_NaN();
};

/// Summarises errors. A NaN among them makes every figure NaN.   Cost O(N log N).
inline ErrorStatistics error_statistics(span<const double> errors) {
  ErrorStatistics result;
  result.count = errors.size();
  if (errors.empty()) return result;
  for (const double error : errors)
    if (std::isnan(error)) return result;

  const double count = static_cast<double>(errors.size());
  double sum = 0.0, sum_of_squares = 0.0, squared_deviations = 0.0;
  for (const double error : errors) {
    sum += error;
    sum_of_squares += error * error;
  }
  result.mean = sum / count;
  result.rmse = std::sqrt(sum_of_squares / count);
  for (const double error : errors) squared_deviations += (error - result.mean) * (error - result.mean);
  result.std = std::sqrt(squared_deviations / count);

  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  result.median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  result.min = sorted.front();
  result.max = sorted.back();
  return result;
}

/// Improvement η = (β − γ) / β · 100 % of an error γ over the error β without the filter (Eq. 17). Positive is better.
/// @return        empty where β is not positive or one of the two is not finite: there is nothing to compare with.
inline std::optional<double> improvement_percent(double error_without, double error_with) {
  if (!std::isfinite(error_without) || !std::isfinite(error_with) || !(error_without > 0)) return std::nullopt;
  return (error_without - error_with) / error_without * 100.0;
}

}  // namespace stillpoint
