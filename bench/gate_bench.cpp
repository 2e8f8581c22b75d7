// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Which disagreement is more than noise?   The gate, beside the two sorts by which its medians would be had from
// OpenCV.

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/gate/mean_gate.hpp"

namespace stillpoint::bench {
namespace {

/// A tenth of the features moves.
std::vector<FeatureScore> make_scores(std::size_t count) {
  Random random;
  std::vector<FeatureScore> scores(count);
  for (std::size_t i = 0; i < count; ++i)
    scores[i].value = static_cast<float>((i % 10 == 0 ? 0.3 : 0.01) * std::abs(random.gaussian()));
  return scores;
}

void BM_MeanGate(benchmark::State& state) {
  const std::vector<FeatureScore> scores = make_scores(static_cast<std::size_t>(state.range(0)));
  Regions regions;
  regions.of_feature.resize(scores.size());
  Workspace workspace;
  const MeanGate gate;
  Threshold threshold;
  for (auto _ : state) {
    workspace.rewind();
    threshold = gate.threshold(scores, regions, workspace);
    benchmark::DoNotOptimize(threshold);
  }
  state.counters["threshold"] = threshold.level;
}
BENCHMARK(BM_MeanGate)->ArgName("points")->Arg(500)->Arg(1000)->Unit(benchmark::kMicrosecond);

void BM_MeanGate_OpenCV(benchmark::State& state) {
  const std::vector<FeatureScore> scores = make_scores(static_cast<std::size_t>(state.range(0)));
  const int count = static_cast<int>(scores.size());
  cv::Mat values(1, count, CV_64F), sorted, deviations;
  for (int i = 0; i < count; ++i) values.at<double>(i) = static_cast<double>(scores[static_cast<std::size_t>(i)].value);
  const auto median_of = [&](const cv::Mat& m) {
    cv::sort(m, sorted, cv::SORT_EVERY_ROW | cv::SORT_ASCENDING);
    return 0.5 * (sorted.at<double>((count - 1) / 2) + sorted.at<double>(count / 2));
  };
  double threshold = 0;
  for (auto _ : state) {
    const double middle = median_of(values);
    cv::absdiff(values, middle, deviations);
    const double limit = middle + MeanGate().options.outlier_sigmas * kMadToSigma * median_of(deviations);
    threshold = cv::mean(values, values <= limit)[0];
    benchmark::DoNotOptimize(threshold);
  }
  state.counters["threshold"] = threshold;
}
BENCHMARK(BM_MeanGate_OpenCV)->ArgName("points")->Arg(500)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillpoint::bench
