// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is it worth to count on?   Early rejection of RANSAC's wrong models.
// Source: Matas and Chum, "Randomized RANSAC with Sequential Probability Ratio Test", ICCV 2005.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint::detail {

/// Wald's test, block by block: is a model no better than chance?
class SequentialTest {
 public:
  /// Probability at most that a good model is thrown away.
  static constexpr double kMiss = 0.01;

  /// From here on a good model explains at least this share of the data.
  void expect(double inlier_share) noexcept {
    good_ = std::min(inlier_share, 0.95);
    update();
  }
  bool rejects(std::size_t inliers, std::size_t tested) const noexcept {
    return active_ &&
           static_cast<double>(inliers) * inlier_weight_ + static_cast<double>(tested - inliers) * outlier_weight_ >
               -kLogMiss;
  }
  /// What a thrown-away model explained tells how much a wrong one does by chance.
  void learn(std::size_t inliers, std::size_t tested) noexcept {
    wrong_inliers_ += static_cast<double>(inliers);
    wrong_tested_ += static_cast<double>(tested);
    update();
  }

 private:
  static constexpr double kLogMiss = -4.605170185988091;  // log(kMiss)

  void update() noexcept {
    const double wrong = wrong_inliers_ / wrong_tested_;
    active_ = wrong < 0.8 * good_;  // nearer together, the test would take as long as a full count
    if (!active_) return;
    inlier_weight_ = std::log(wrong / good_);
    outlier_weight_ = std::log((1.0 - wrong) / (1.0 - good_));
  }

  double good_ = 0.0;
  double wrong_inliers_ = 5.0, wrong_tested_ = 100.0;  // 5 % before anything is known
  double inlier_weight_ = 0.0, outlier_weight_ = 0.0;
  bool active_ = false;
};

}  // namespace stillpoint::detail
