// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Dropping features from the host's parallel arrays, beside copying the kept ones into new arrays, as hosts do by hand
// with OpenCV.

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/random.hpp"

namespace stillpoint::bench {
namespace {

/// Keypoints, descriptors of 32 bytes, and flags that drop a third.
struct Features {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  std::vector<std::uint8_t> keep;

  explicit Features(std::size_t count) : keypoints(count), keep(count) {
    Random random;
    descriptors.create(static_cast<int>(count), 32, CV_8U);
    for (std::size_t i = 0; i < count; ++i) {
      keypoints[i].pt = {static_cast<float>(random.uniform(0, 640)), static_cast<float>(random.uniform(0, 480))};
      keep[i] = random.uniform() < 0.67 ? 1 : 0;
      for (int c = 0; c < 32; ++c)
        descriptors.at<std::uint8_t>(static_cast<int>(i), c) = static_cast<std::uint8_t>(random.index(256));
    }
  }
};

void BM_Compact(benchmark::State& state) {
  const Features all(static_cast<std::size_t>(state.range(0)));
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat memory, descriptors;
  std::size_t kept = 0;
  for (auto _ : state) {
    keypoints = all.keypoints;  // both sides pay for fresh arrays: this one before, the other by writing new ones
    all.descriptors.copyTo(memory);
    descriptors = memory;
    kept = compact(all.keep, keypoints, descriptors);
    benchmark::DoNotOptimize(keypoints.data());
    benchmark::ClobberMemory();
  }
  state.counters["kept"] = static_cast<double>(kept);
}
BENCHMARK(BM_Compact)->ArgName("points")->Arg(1000)->Unit(benchmark::kMicrosecond);

void BM_Compact_OpenCV(benchmark::State& state) {
  const Features all(static_cast<std::size_t>(state.range(0)));
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  for (auto _ : state) {
    keypoints.clear();
    descriptors = cv::Mat();
    for (std::size_t i = 0; i < all.keep.size(); ++i) {
      if (all.keep[i] == 0) continue;
      keypoints.push_back(all.keypoints[i]);
      descriptors.push_back(all.descriptors.row(static_cast<int>(i)));
    }
    benchmark::DoNotOptimize(keypoints.data());
    benchmark::ClobberMemory();
  }
  state.counters["kept"] = static_cast<double>(keypoints.size());
}
BENCHMARK(BM_Compact_OpenCV)->ArgName("points")->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillpoint::bench
