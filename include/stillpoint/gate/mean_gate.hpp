// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which score is too high?   The paper's φ, Eq. 10: the mean score of what is thought static.

#include <cmath>
#include <cstddef>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// φ = mean of Th over the features outside dynamic boxes, outliers removed (Eq. 10). The paper names no outlier rule;
/// ours: a score more than `outlier_sigmas` × 1.4826 MAD above the median is left out. Only above: what is trimmed is a
/// mover that no box covers, and nothing disagrees too little.
class MeanGate {
 public:
  using Provides = Capabilities<>;

  struct Options {
    double outlier_sigmas = 3.0;
  };
  Options options;

  /// @return infinity where no feature outside dynamic boxes has a score: then nothing is dynamic.
  Threshold threshold(span<const FeatureScore> scores, const Regions& regions, Workspace& workspace) const {
    const Workspace::Scope scope(workspace);
    const span<double> all = workspace.take<double>(scores.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < scores.size(); ++i)
      if (scores[i].scored() && !regions.of_feature[i].in_dynamic) all[count++] = static_cast<double>(scores[i].value);
    if (count == 0) return {};
    return {trimmed_mean(all.first(count), workspace)};
  }

 private:
  double trimmed_mean(span<double> values, Workspace& workspace) const {
    const double median = median_in_place(values);
    const span<double> deviations = workspace.take<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) deviations[i] = std::abs(values[i] - median);
    const double limit = median + options.outlier_sigmas * kMadToSigma * median_in_place(deviations);
    double sum = 0;
    std::size_t count = 0;
    for (const double value : values) {
      if (value > limit) continue;
      sum += value;
      ++count;
    }
    return sum / static_cast<double>(count);
  }
};

template <class Visit>
void each_option(MeanGate& stage, Visit& visit) {
  visit("outlier_sigmas", stage.options.outlier_sigmas, OptionRange{0, 1000});
}

}  // namespace stillpoint
