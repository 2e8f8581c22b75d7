// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// How long does a detector take?   The same published network by each library that runs it, one thread each. Skipped
// where the networks are not.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#ifdef STILLPOINT_BENCH_DNN
#include "stillpoint/detectors/opencv_dnn.hpp"
#endif
#ifdef STILLPOINT_BENCH_ONNXRUNTIME
#include "stillpoint/detectors/onnxruntime.hpp"
#endif

namespace stillpoint::bench {
namespace {

template <class Detector>
[[maybe_unused]] void BM_Detector(benchmark::State& state) {
  const std::filesystem::path models = STILLPOINT_SHARED_MODELS;
  const cv::Mat image = cv::imread((models / "two_people.jpg").string());
  if (image.empty() || !std::filesystem::exists(models / "yolox_nano.onnx"))
    return state.SkipWithError("no published networks");
  Detector detector(models / "yolox_nano.onnx");
  std::vector<Detection> found;
  for (auto _ : state) detector.detect(image, found);
  state.counters["found"] = static_cast<double>(found.size());
}
#ifdef STILLPOINT_BENCH_DNN
BENCHMARK_TEMPLATE(BM_Detector, OpenCvDetector)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
#endif
#ifdef STILLPOINT_BENCH_ONNXRUNTIME
BENCHMARK_TEMPLATE(BM_Detector, OnnxRuntimeDetector)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
#endif

}  // namespace
}  // namespace stillpoint::bench
