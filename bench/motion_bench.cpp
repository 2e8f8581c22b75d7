// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// How did the camera move?   RANSAC beside OpenCV's on the same scenes, with the pose errors of both. One iteration is
// one scene; the scenes take turns.

#include <benchmark/benchmark.h>

#include <cstddef>
#include <deque>
#include <vector>

#include "pairs.hpp"
#include "quantiles.hpp"
#include "stillpoint/motion/epipolar/epipolar_motion.hpp"
#include "two_views.hpp"

namespace stillpoint::bench {
namespace {

constexpr std::size_t kScenes = 20;

std::vector<TwoViews> make_scenes(const benchmark::State& state, double noise_px) {
  TwoViewOptions options;
  options.points = static_cast<std::size_t>(state.range(0));
  options.outlier_share = 0.01 * static_cast<double>(state.range(1));
  options.noise_px = noise_px;
  return make_two_views(options, kScenes);
}

/// Medians over all scenes. A fundamental matrix is not metric: it leaves the length of t open.
void count_errors(benchmark::State& state, const std::vector<PoseError>& errors, bool metric) {
  std::vector<double> rotation_deg, direction_deg, translation_mm;
  for (const PoseError& error : errors) {
    rotation_deg.push_back(error.rotation_deg);
    direction_deg.push_back(error.direction_deg);
    translation_mm.push_back(1e3 * error.translation_m);
  }
  state.counters["rotation_deg"] = median(rotation_deg);
  state.counters["direction_deg"] = median(direction_deg);
  if (metric) state.counters["translation_mm"] = median(translation_mm);
}

/// Times `run(pair)`; then once more over all scenes for the errors, however few iterations there were.
template <class Pair, class Run, class Error>
void run_pairs(benchmark::State& state, std::deque<Pair>& pairs, bool metric, const Run& run, const Error& error) {
  std::size_t i = 0;
  for (auto _ : state) {
    run(pairs[i]);
    benchmark::ClobberMemory();
    i = (i + 1) % pairs.size();
  }
  std::vector<PoseError> errors;
  for (Pair& pair : pairs) {
    run(pair);
    errors.push_back(error(pair));
  }
  count_errors(state, errors, metric);
}

/// The arguments: points, outliers in percent, noise and threshold in hundredths of a pixel.
void two_views(benchmark::internal::Benchmark* b) {
  b->ArgNames({"points", "outliers", "noise_cpx", "threshold_cpx"})->Unit(benchmark::kMicrosecond);
  for (const int points : {500, 1000})
    for (const int outliers : {10, 40}) b->Args({points, outliers, 50, 150});
  b->Args({1000, 40, 10, 10});  // the paper's threshold and a good tracker's noise: few inliers
}

std::deque<EpipolarPair> make_epipolar(const std::vector<TwoViews>& scenes, const benchmark::State& state) {
  std::deque<EpipolarPair> pairs;
  for (const TwoViews& scene : scenes) pairs.emplace_back(scene, 0.01 * static_cast<double>(state.range(3)));
  return pairs;
}

void BM_EpipolarRansac(benchmark::State& state) {
  const std::vector<TwoViews> scenes = make_scenes(state, 0.01 * static_cast<double>(state.range(2)));
  std::deque<EpipolarPair> pairs = make_epipolar(scenes, state);
  run_pairs(
      state, pairs, false, [](EpipolarPair& pair) { pair.ours(); },
      [](const EpipolarPair& pair) { return pair.our_error(); });
  double trials = 0;
  for (const EpipolarPair& pair : pairs) trials += static_cast<double>(pair.our_trials());
  state.counters["trials"] = trials / static_cast<double>(pairs.size());
}
BENCHMARK(BM_EpipolarRansac)->Apply(two_views);

void BM_EpipolarRansac_OpenCV(benchmark::State& state) {
  const std::vector<TwoViews> scenes = make_scenes(state, 0.01 * static_cast<double>(state.range(2)));
  std::deque<EpipolarPair> pairs = make_epipolar(scenes, state);
  run_pairs(
      state, pairs, false, [](EpipolarPair& pair) { pair.theirs(); },
      [](const EpipolarPair& pair) { return pair.their_error(); });
}
BENCHMARK(BM_EpipolarRansac_OpenCV)->Apply(two_views);

void BM_RigidMotion(benchmark::State& state) {
  const std::vector<TwoViews> scenes = make_scenes(state, 0.5);
  std::deque<RigidPair> pairs(scenes.begin(), scenes.end());
  run_pairs(
      state, pairs, true, [](RigidPair& pair) { pair.ours(); }, [](const RigidPair& pair) { return pair.our_error(); });
}
BENCHMARK(BM_RigidMotion)
    ->ArgNames({"points", "outliers"})
    ->ArgsProduct({{500, 1000}, {10, 40}})
    ->Unit(benchmark::kMicrosecond);

void BM_RigidMotion_OpenCVAffine3D(benchmark::State& state) {
  const std::vector<TwoViews> scenes = make_scenes(state, 0.5);
  std::deque<RigidPair> pairs(scenes.begin(), scenes.end());
  run_pairs(
      state, pairs, true, [](RigidPair& pair) { pair.theirs(); },
      [](const RigidPair& pair) { return pair.their_error(); });
}
BENCHMARK(BM_RigidMotion_OpenCVAffine3D)
    ->ArgNames({"points", "outliers"})
    ->ArgsProduct({{500, 1000}, {10, 40}})
    ->Unit(benchmark::kMicrosecond);

/// The whole stage: is it a rotation, F, is it a plane, E, the length of t.
void BM_EpipolarMotion(benchmark::State& state) {
  struct Scene {
    const TwoViews* views;
    Motion motion;
  };
  const std::vector<TwoViews> scenes = make_scenes(state, 0.01 * static_cast<double>(state.range(2)));
  EpipolarMotion ego_motion;
  ego_motion.options.threshold_px = 0.01 * static_cast<double>(state.range(3));
  Workspace workspace;
  std::deque<Scene> runs;
  for (const TwoViews& scene : scenes) runs.push_back({&scene, {}});
  run_pairs(
      state, runs, true,
      [&](Scene& scene) {
        workspace.rewind();
        const TwoViews& views = *scene.views;
        scene.motion = ego_motion.estimate(views.observations, views.camera, MotionPrior{}, workspace);
      },
      [](const Scene& scene) {
        return PoseError(scene.motion.current_from_reference, scene.views->current_from_reference);
      });
}
BENCHMARK(BM_EpipolarMotion)->Apply(two_views);

}  // namespace
}  // namespace stillpoint::bench
