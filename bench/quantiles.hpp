// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// One definition of the median and of the 95th percentile, for all that bench/ prints.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "stillpoint/evaluation/error_statistics.hpp"

namespace stillpoint::bench {

/// Of an even count half-way between the middle two; NaN of none.
inline double median(const std::vector<double>& values) { return error_statistics(values).median; }

/// The smallest value that 95 % do not exceed; empty of none.
inline std::optional<double> percentile_95(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + rank - 1, values.end());
  return values[static_cast<std::size_t>(rank - 1)];
}

}  // namespace stillpoint::bench
