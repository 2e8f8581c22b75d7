// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// An estimator whose residual is not squared, or so it is called.
// expected: stillpoint: a RANSAC estimator must offer Model, kSampleSize, kMaxModels, size(), solve(span<const std::size_t>, span<Model>) and squared_residual(const Model&, std::size_t); see motion/ransac.hpp

#include "stillpoint/motion/ransac.hpp"

struct MeanOfOne {
  using Model = double;
  static constexpr std::size_t kSampleSize = 1, kMaxModels = 1;
  std::size_t size() const { return 10; }
  std::size_t solve(stillpoint::span<const std::size_t> sample, stillpoint::span<double> models) const {
    models[0] = static_cast<double>(sample[0]);
    return 1;
  }
#ifdef STILLPOINT_MISTAKE
  double residual(double model, std::size_t i) const { return model - static_cast<double>(i); }
#else
  double squared_residual(double model, std::size_t i) const {
    return (model - static_cast<double>(i)) * (model - static_cast<double>(i));
  }
#endif
};

void estimate(stillpoint::Workspace& workspace) {
  stillpoint::ransac(MeanOfOne(), stillpoint::RansacOptions(1.0), workspace);
}
