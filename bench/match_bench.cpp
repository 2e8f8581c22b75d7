// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Where was each feature before?   Lucas-Kanade forth and back, beside the plain calls of OpenCV.

#include <benchmark/benchmark.h>

#include <cstddef>

#include "pairs.hpp"

namespace stillpoint::bench {
namespace {

const Clip& clip() {
  static const Clip kClip = synthetic_clip(10);
  return kClip;
}

/// One iteration is one frame of the clip, which begins anew at its end.
template <class Run, class Count>
void run_frames(benchmark::State& state, const Run& run, const Count& count_matches) {
  LucasKanadePair pair(clip());
  std::size_t i = 1;
  for (auto _ : state) {
    run(pair, i);
    benchmark::ClobberMemory();
    i = i + 1 < clip().frames.size() ? i + 1 : 1;
  }
  double matches = 0;
  for (i = 1; i < clip().frames.size(); ++i) {
    run(pair, i);
    matches += static_cast<double>(count_matches(pair, i));
  }
  state.counters["matches"] = matches / static_cast<double>(clip().frames.size() - 1);
}

void BM_LucasKanade(benchmark::State& state) {
  run_frames(
      state, [](LucasKanadePair& pair, std::size_t i) { pair.ours(i); },
      [](const LucasKanadePair& pair, std::size_t) { return pair.our_matches(); });
}
BENCHMARK(BM_LucasKanade)->Unit(benchmark::kMillisecond);

void BM_LucasKanade_OpenCV(benchmark::State& state) {
  run_frames(
      state, [](LucasKanadePair& pair, std::size_t i) { pair.theirs(i); },
      [](const LucasKanadePair& pair, std::size_t i) { return pair.their_matches(i); });
}
BENCHMARK(BM_LucasKanade_OpenCV)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stillpoint::bench
