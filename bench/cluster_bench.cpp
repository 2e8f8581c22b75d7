// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What moves together?   K-means beside OpenCV's (same start, same number of iterations), and the whole classifier.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "pairs.hpp"
#include "stillpoint/cluster/region_clusters.hpp"
#include "two_views.hpp"

namespace stillpoint::bench {
namespace {

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"points", "clusters"})->Args({100, 10})->Args({300, 30})->Args({1000, 100});
  b->Unit(benchmark::kMicrosecond);
}

KMeansPair make_pair(const benchmark::State& state) {
  return {static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1))};
}

void BM_KMeans(benchmark::State& state) {
  KMeansPair pair = make_pair(state);
  for (auto _ : state) {
    pair.ours();
    benchmark::DoNotOptimize(pair.our_cost());
  }
  state.counters["cost"] = pair.our_cost();
  state.counters["iterations"] = pair.iterations();
}
BENCHMARK(BM_KMeans)->Apply(sizes);

void BM_KMeans_OpenCV(benchmark::State& state) {
  KMeansPair pair = make_pair(state);
  for (auto _ : state) {
    pair.theirs();
    benchmark::DoNotOptimize(pair.their_cost());
  }
  state.counters["cost"] = pair.their_cost();
  state.counters["iterations"] = pair.iterations();
}
BENCHMARK(BM_KMeans_OpenCV)->Apply(sizes);

void BM_RegionClusters(benchmark::State& state) {
  TwoViewOptions options;
  options.points = static_cast<std::size_t>(state.range(0));
  TwoViews scene(options);
  for (Membership& feature : scene.observations.regions.of_feature) feature.in_dynamic = true;
  std::vector<FeatureScore> scores(options.points);
  for (std::size_t i = 0; i < options.points; ++i) scores[i].value = scene.outlier[i] != 0 ? 0.1f : 0.01f;
  std::vector<Label> labels(options.points);
  Workspace workspace;
  const RegionClusters classifier;
  for (auto _ : state) {
    workspace.rewind();
    classifier.classify(scene.observations, {scores, {0.03}}, labels, workspace);
    benchmark::DoNotOptimize(labels.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(BM_RegionClusters)->ArgName("points")->Arg(300)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillpoint::bench
