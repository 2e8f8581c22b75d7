// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// 03_custom_stage: a stage of your own in the pipeline, and what it changes. The stage is a gate: it says from which
// score on a feature counts as moving. docs/extending.md has the contract of each stage.

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <opencv2/features2d.hpp>
#include <stillpoint/evaluation/feature_score.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/synthetic/renderer.hpp>
#include <stillpoint/synthetic/scenes.hpp>
#include <type_traits>
#include <vector>

namespace {

/// Hampel's rule: dynamic is what scores more than some standard deviations above the frame's own median, both
/// estimated robustly. `TailGate`, the default, has a level for a false-positive rate instead.
struct MedianGate {
  struct Options {
    double sigmas = 3.0;  ///< above the median, 0 to 100
  };
  Options options;  // a stage is a public member of the filter: filter.gate.options.sigmas = 4.0

  /// Required. Called once per frame, when each feature has its score and before any has a verdict.
  /// @param scores     one a feature; NaN where it could not be scored
  /// @param regions    which features lie in a detector's boxes: this gate does not ask
  /// @param workspace  scratch memory that allocates nothing once it has grown
  /// @return           infinity, "nothing is dynamic", where no feature has a score
  stillpoint::Threshold threshold(stillpoint::span<const stillpoint::FeatureScore> scores, const stillpoint::Regions&,
                                  stillpoint::Workspace& workspace) const {
    const stillpoint::Workspace::Scope scope(workspace);
    const stillpoint::span<double> values = workspace.take<double>(scores.size());
    std::size_t count = 0;
    for (const stillpoint::FeatureScore& score : scores)
      if (score.scored()) values[count++] = static_cast<double>(score.value);
    if (count == 0) return {};
    const stillpoint::span<double> scored = values.first(count);
    const double median = stillpoint::median_in_place(scored);
    for (double& value : scored) value = std::abs(value - median);
    return {median + options.sigmas * stillpoint::kMadToSigma * stillpoint::median_in_place(scored)};
  }
};

/// Optional: names and ranges of the options. A frame is `invalid_options` while one is out of its range.
template <class Visit>
void each_option(MedianGate& stage, Visit& visit) {
  visit("sigmas", stage.options.sigmas, stillpoint::OptionRange{0, 100});
}

// The form of the contract. FrameFilter checks it too and says which member is missing.
static_assert(stillpoint::is_gate<MedianGate>::value);
// `learn` and `reset` are optional: this gate remembers nothing, so that there is nothing to learn or to forget.
static_assert(!stillpoint::learns<MedianGate>::value && !stillpoint::resets<MedianGate>::value);

// [policies]
struct MyPolicies : stillpoint::DefaultPolicies {
  using Gate = MedianGate;
};
// [policies]

using Keypoints = std::vector<cv::KeyPoint>;

/// How a filter did, and what it had to say at last.
struct Record {
  stillpoint::FilterScore score;
  const char* hint = "";
};

/// Adds what a filter says of a frame whose truth is known.
template <class Filter>
void judge(Filter& filter, const stillpoint::SyntheticFrame& frame, const Keypoints& keypoints, Record& record) {
  const stillpoint::FrameResult& result = filter.filter_frame(frame.view(), keypoints);
  std::vector<stillpoint::Vector2f> pixels;
  for (const cv::KeyPoint& keypoint : keypoints) pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
  record.score.add_frame(frame.labels.view(), pixels, result.keep());
  record.hint = result.hint();
}

void print(const char* name, const Record& record) {
  std::printf("%-22s recall %.3f, false-positive rate %.4f %s\n", name, record.score.recall().value_or(0.0),
              record.score.false_positive_rate().value_or(0.0), record.hint);
}

}  // namespace

int main() {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::demo());
  stillpoint::FrameFilter<> usual(sequence.camera());
  stillpoint::FrameFilter<MyPolicies> strict(sequence.camera()), lenient(sequence.camera());
  lenient.gate.options.sigmas = 6.0;

  Record of_usual, of_strict, of_lenient;
  stillpoint::SyntheticFrame frame;
  Keypoints keypoints;
  const auto orb = cv::ORB::create(500);
  for (int i = 0; i < sequence.size(); ++i) {
    sequence.render(i, frame);
    orb->detect(stillpoint::as_mat(frame.gray.view()), keypoints);
    judge(usual, frame, keypoints, of_usual);
    judge(strict, frame, keypoints, of_strict);
    judge(lenient, frame, keypoints, of_lenient);
  }
  print("TailGate", of_usual);
  print("MedianGate, 3 sigmas", of_strict);
  print("MedianGate, 6 sigmas", of_lenient);

  lenient.gate.options.sigmas = -1.0;
  std::printf("refused: %s\n", lenient.options_error().c_str());
}
