// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The whole filter, beside ORB on the same frames: what a tracker computes anyway. One iteration is one frame.

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "clip.hpp"
#include "filter_run.hpp"

namespace stillpoint::bench {
namespace {

constexpr std::size_t kFrames = 10;

/// The argument: whether the clip is the recording kitchen_walk, or the synthetic scene.
void both_clips(benchmark::internal::Benchmark* b) {
  b->ArgName("recorded")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
}

/// Null, and the benchmark says so, where there is no recording.
const Clip* clip(benchmark::State& state) {
  static const Clip kSyntheticClip = synthetic_clip(kFrames);
  static const std::filesystem::path kFolder = STILLPOINT_SHARED_DATA "/kitchen_walk";
  static const std::optional<Clip> kRecordedClip =
      is_recorded_clip(kFolder) ? std::optional(recorded_clip(kFolder, kFrames)) : std::nullopt;
  if (state.range(0) == 0) return &kSyntheticClip;
  if (kRecordedClip) return &*kRecordedClip;
  state.SkipWithError(("skipped: no camera.yaml and boxes.txt in " + kFolder.string()).c_str());
  return nullptr;
}

template <class Policies>
void BM_FilterFrame(benchmark::State& state) {
  const Clip* const frames = clip(state);
  if (frames == nullptr) return;
  FilterRun<Policies> run(*frames);
  run.begin();
  std::size_t i = 0;
  double judged_frames = 0, kept = 0, features = 0, without_matching_ms = 0;
  for (auto _ : state) {
    if (++i == frames->frames.size()) {
      state.PauseTiming();
      run.begin();
      i = 1;
      state.ResumeTiming();
    }
    const FrameResult& result = run.filter(i);
    judged_frames += judged(result.status()) ? 1 : 0;
    kept += static_cast<double>(result.kept_count());
    features += static_cast<double>(result.size());
    without_matching_ms += result.timings().total_ms() - result.timings()[Stage::match];
  }
  const auto average = benchmark::Counter::kAvgIterations;
  state.counters["judged"] = benchmark::Counter(judged_frames, average);
  state.counters["kept_share"] = kept / features;
  state.counters["without_matching_ms"] = benchmark::Counter(without_matching_ms, average);
}
BENCHMARK_TEMPLATE(BM_FilterFrame, DefaultPolicies)->Apply(both_clips);
BENCHMARK_TEMPLATE(BM_FilterFrame, PaperPolicies)->Apply(both_clips);
BENCHMARK_TEMPLATE(BM_FilterFrame, PaperRigidPolicies)->Apply(both_clips);

void BM_Orb_OpenCV(benchmark::State& state) {
  const Clip* const frames = clip(state);
  if (frames == nullptr) return;
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  std::size_t i = 0;
  for (auto _ : state) {
    i = i + 1 < frames->frames.size() ? i + 1 : 1;
    orb->detectAndCompute(frames->frames[i].gray, cv::noArray(), keypoints, descriptors);
    benchmark::DoNotOptimize(keypoints.data());
  }
}
BENCHMARK(BM_Orb_OpenCV)->Apply(both_clips);

}  // namespace
}  // namespace stillpoint::bench
