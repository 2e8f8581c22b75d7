// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// RANSAC: the model that most of the data agree on, when some of the data are wrong.
// Sources: Fischler and Bolles, "Random Sample Consensus", 1981; Torr and Zisserman, "MLESAC", 2000 (the MSAC support);
// Chum, Matas and Kittler, "Locally Optimized RANSAC", 2003; Matas and Chum, "Randomized RANSAC with Sequential
// Probability Ratio Test", 2005 (early rejection).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "stillpoint/core/random.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/motion/sequential_test.hpp"

namespace stillpoint {

// What an Estimator offers. All calls are const; one run, one thread.
// clang-format off
// | member                                                          | meaning                                           |
// |-----------------------------------------------------------------|---------------------------------------------------|
// | `using Model`                                                   | default-constructible, copyable                   |
// | `static constexpr std::size_t kSampleSize`                      | data in a minimal sample                          |
// | `static constexpr std::size_t kMaxModels`                       | most models that one sample can have              |
// | `std::size_t size() const`                                      | number of data, in random order (see `shuffle`):  |
// |                                                                 | early rejection looks at the first of them        |
// | `std::size_t solve(span<const std::size_t> sample,              | models through the sample, written to the front   |
// |                    span<Model> models) const`                   | of `models`; 0: the sample is degenerate          |
// | `float squared_residual(const Model&, std::size_t datum) const` | in the square of the threshold's unit; NaN is an  |
// |                                                                 | outlier. Called most; keep it free of branches    |
// | optional: `bool refine(span<const std::uint32_t> inliers,       | improves the model on its inliers; false: can't.  |
// |                        Model& model) const`                     | Without it there is no local optimisation         |
// clang-format on
template <class E, class = void>
struct is_ransac_estimator : std::false_type {};
template <class E>
struct is_ransac_estimator<
    E, std::void_t<typename E::Model, decltype(E::kSampleSize), decltype(E::kMaxModels),
                   decltype(std::size_t{std::declval<const E&>().size()}),
                   decltype(std::size_t{std::declval<const E&>().solve(std::declval<span<const std::size_t>>(),
                                                                       std::declval<span<typename E::Model>>())}),
                   decltype(static_cast<float>(std::declval<const E&>().squared_residual(
                       std::declval<const typename E::Model&>(), std::size_t{})))>> : std::true_type {};

template <class E, class = void>
struct has_refinement : std::false_type {};
template <class E>
struct has_refinement<E, std::void_t<decltype(bool{std::declval<const E&>().refine(
                             std::declval<span<const std::uint32_t>>(), std::declval<typename E::Model&>())})>>
    : std::true_type {};

/// Support of a datum whose squared residual is `ratio` times the squared threshold: in [0, 1], 0 for an outlier or
/// NaN.
struct MsacSupport {
  static float gain(float ratio) noexcept { return ratio <= 1.0f ? 1.0f - ratio : 0.0f; }
};
/// Plain counting of inliers, as Fischler and Bolles had it.
struct InlierCountSupport {
  static float gain(float ratio) noexcept { return ratio <= 1.0f ? 1.0f : 0.0f; }
};

struct RansacOptions {
  explicit RansacOptions(double inlier_threshold) : threshold(inlier_threshold) {}

  double threshold;               ///< largest residual of an inlier, in the estimator's unit; hence no default
  double confidence = 0.99;       ///< of having drawn one sample without an outlier (OpenCV's default)
  std::size_t min_trials = 0;     ///< samples to draw at least
  std::size_t max_trials = 1000;  ///< samples to draw at most (OpenCV's default)
  bool early_rejection = true;    ///< sequential test; needs the data in random order
  std::uint64_t seed = Random::kDefaultSeed;
};

/// The options of a stage that has `confidence`, `max_trials` and `seed`.
template <class StageOptions>
RansacOptions ransac_options(double inlier_threshold, const StageOptions& stage) {
  RansacOptions options(inlier_threshold);
  options.confidence = stage.confidence;
  options.max_trials = stage.max_trials;
  options.seed = stage.seed;
  return options;
}

/// All figures belong to `model`: they are computed once, from it.
template <class Model>
struct RansacReport {
  bool success = false;        ///< some sample gave a model with more support than none
  std::size_t trials = 0;      ///< samples drawn
  std::size_t degenerate = 0;  ///< of them, those without a model
  std::size_t inliers = 0;
  double support = 0.0;
  Model model{};
  span<std::uint8_t> inlier;  ///< one byte a datum; lives in the caller's workspace scope
};

/// Samples to draw until one is free of outliers with the given confidence: log(1 − confidence) / log(1 − wᵐ), rounded
/// up, at least 1. Source: Fischler and Bolles, 1981, section II.B.
/// @param inlier_share w, in [0, 1]
/// @param pass         probability that a good model passes an early test
/// @return             `limit` where more would be needed
inline std::size_t required_trials(double inlier_share, std::size_t sample_size, double confidence, std::size_t limit,
                                   double pass = 1.0) {
  const double good = pass * std::pow(inlier_share, static_cast<double>(sample_size));
  if (good >= 1.0) return std::min<std::size_t>(1, limit);
  const double trials = std::ceil(std::log1p(-confidence) / std::log1p(-good));
  if (!(trials < static_cast<double>(limit))) return limit;  // infinite or NaN too
  return std::max<std::size_t>(1, static_cast<std::size_t>(trials));
}

/// Puts the elements into random order, each equally likely (Fisher and Yates).
template <class T>
void shuffle(span<T> elements, Random& random) noexcept {
  for (std::size_t i = elements.size(); i > 1; --i) std::swap(elements[i - 1], elements[random.index(i)]);
}

namespace detail {

template <class Estimator, class Support>
class RansacRun {
  static_assert(is_ransac_estimator<Estimator>::value,
                "stillpoint: a RANSAC estimator must offer Model, kSampleSize, kMaxModels, size(), solve(span<const "
                "std::size_t>, span<Model>) and squared_residual(const Model&, std::size_t); see motion/ransac.hpp");
  using Model = typename Estimator::Model;

 public:
  RansacRun(const Estimator& estimator, const RansacOptions& options, Workspace& workspace)
      : estimator_(estimator),
        options_(options),
        workspace_(workspace),
        size_(estimator.size()),
        per_squared_threshold_(static_cast<float>(1.0 / (options.threshold * options.threshold))) {}

  RansacReport<Model> run() {
    RansacReport<Model> report;
    report.inlier = workspace_.take<std::uint8_t>(size_);
    if (size_ < Estimator::kSampleSize) return report;
    Random random(options_.seed);
    std::array<std::size_t, Estimator::kSampleSize> sample;
    std::array<Model, Estimator::kMaxModels> models;
    std::size_t limit = options_.max_trials;
    while (report.trials < limit) {
      ++report.trials;
      random.distinct(sample, size_);
      const std::size_t count = estimator_.solve(sample, models);
      report.degenerate += count == 0;
      for (std::size_t m = 0; m < count; ++m) {
        const Score score = evaluate(models[m], options_.early_rejection);
        if (!(score.support > best_.support)) continue;
        accept(models[m], score);
        if constexpr (has_refinement<Estimator>::value) optimise_locally(kLocalInliers);
        const double share = static_cast<double>(best_.inliers) / static_cast<double>(size_);
        test_.expect(share);
        const double pass = options_.early_rejection ? 1.0 - SequentialTest::kMiss : 1.0;
        limit = required_trials(share, Estimator::kSampleSize, options_.confidence, options_.max_trials, pass);
        limit = std::min(std::max(limit, options_.min_trials), options_.max_trials);
      }
    }
    report.success = best_.support > 0.0;
    if constexpr (has_refinement<Estimator>::value)
      if (report.success) optimise_locally(size_);
    if (report.success) conclude(report);
    return report;
  }

 private:
  struct Score {
    double support = 0.0;
    std::size_t inliers = 0;
  };

  /// A constant length lets the compiler use vector instructions.
  static constexpr std::size_t kBlock = 16;

  float ratio(const Model& model, std::size_t datum) const {
    return static_cast<float>(estimator_.squared_residual(model, datum)) * per_squared_threshold_;
  }

  /// The support of a model, or none as soon as it can't be (or, by the sequential test, is not) the best.
  Score evaluate(const Model& model, bool sequential) {
    Score score;
    for (std::size_t begin = 0; begin < size_; begin += kBlock) {
      const std::size_t count = std::min(kBlock, size_ - begin);
      std::array<float, kBlock> ratios;
      if (count == kBlock) {
        for (std::size_t k = 0; k < kBlock; ++k) ratios[k] = ratio(model, begin + k);
      } else {
        ratios.fill(2.0f);  // an outlier
        for (std::size_t k = 0; k < count; ++k) ratios[k] = ratio(model, begin + k);
      }
      float gain = 0.0f;
      int inliers = 0;
      for (std::size_t k = 0; k < kBlock; ++k) {
        gain += Support::gain(ratios[k]);
        inliers += ratios[k] <= 1.0f ? 1 : 0;
      }
      score.support += static_cast<double>(gain);
      score.inliers += static_cast<std::size_t>(inliers);
      const std::size_t tested = begin + count;
      if (!(score.support + static_cast<double>(size_ - tested) > best_.support)) return {};
      if (sequential && test_.rejects(score.inliers, tested)) {
        test_.learn(score.inliers, tested);
        return {};
      }
    }
    return score;
  }

  void accept(const Model& model, const Score& score) {
    best_ = score;
    best_model_ = model;
  }

  /// Refines the best model on the data near it, wide at first and then narrower, as the first inliers of a minimal
  /// sample's model lie around that sample only. Source: Lebeda, Matas and Chum, "Fixing the Locally Optimized RANSAC",
  /// 2012, with their limit on how many inliers take part.
  void optimise_locally(std::size_t most_inliers) {
    const Workspace::Scope scope(workspace_);
    const span<std::uint32_t> inliers = workspace_.take<std::uint32_t>(std::min(size_, most_inliers));
    Model model = best_model_;
    for (const float width : kSquaredWidths) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < size_ && count < inliers.size(); ++i) {
        inliers[count] = static_cast<std::uint32_t>(i);
        count += static_cast<std::size_t>(ratio(model, i) <= width);
      }
      if (count < Estimator::kSampleSize || !estimator_.refine(inliers.first(count), model)) return;
      const Score score = evaluate(model, false);
      if (score.support > best_.support) accept(model, score);
    }
  }

  void conclude(RansacReport<Model>& report) const {
    report.model = best_model_;
    for (std::size_t i = 0; i < size_; ++i) {
      const float r = ratio(best_model_, i);
      report.inlier[i] = r <= 1.0f ? 1 : 0;
      report.inliers += report.inlier[i];
      report.support += static_cast<double>(Support::gain(r));
    }
  }

  static constexpr std::array<float, 4> kSquaredWidths = {9.0f, 4.0f, 1.0f, 1.0f};
  static constexpr std::size_t kLocalInliers = 16 * Estimator::kSampleSize;

  const Estimator& estimator_;
  const RansacOptions& options_;
  Workspace& workspace_;
  std::size_t size_;
  float per_squared_threshold_;
  Score best_;
  Model best_model_{};
  SequentialTest test_;
};

}  // namespace detail

/// Finds the model with the most support. Equal data, options and seed give equal reports.
/// @tparam Support   `MsacSupport` or `InlierCountSupport`, or another with `static float gain(float ratio)`
/// @param workspace  holds the report's mask, and scratch that is given back
/// @return           `success` false: fewer data than a sample, or no model with an inlier.
template <class Support = MsacSupport, class Estimator>
RansacReport<typename Estimator::Model> ransac(const Estimator& estimator, const RansacOptions& options,
                                               Workspace& workspace) {
  return detail::RansacRun<Estimator, Support>(estimator, options, workspace).run();
}

}  // namespace stillpoint
