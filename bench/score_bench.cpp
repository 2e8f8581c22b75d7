// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// How badly does each feature disagree with the camera's motion?   OpenCV has no counterpart.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "quantiles.hpp"
#include "stillpoint/score/offset_score.hpp"
#include "two_views.hpp"

namespace stillpoint::bench {
namespace {

void BM_OffsetScore(benchmark::State& state) {
  TwoViewOptions options;
  options.points = static_cast<std::size_t>(state.range(0));
  const TwoViews scene(options);
  Motion motion;
  motion.status = Status::ok;
  motion.current_from_reference = scene.current_from_reference;
  std::vector<FeatureScore> scores(options.points);
  const OffsetScore scorer;
  for (auto _ : state) {
    scorer.score(scene.observations, motion, scene.camera, scores);
    benchmark::DoNotOptimize(scores.data());
    benchmark::ClobberMemory();
  }
  std::vector<double> still, moving;
  for (std::size_t i = 0; i < options.points; ++i)
    (scene.outlier[i] != 0 ? moving : still).push_back(static_cast<double>(scores[i].value));
  state.counters["static"] = median(still);
  state.counters["moving"] = median(moving);
}
BENCHMARK(BM_OffsetScore)->ArgName("points")->Arg(500)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillpoint::bench
