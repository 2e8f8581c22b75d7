// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A filter whose classifier says what the test tells it.

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/opencv.hpp"
#include "unit/pipeline/mock_policies.hpp"

namespace stillpoint::told_result {

/// A classifier that gives each feature what the test says.
struct ToldClassifier {
  std::vector<Label> told;
  void classify(const Observations& observations, const Evidence&, span<Label> labels, Workspace&) const {
    for (std::size_t i = 0; i < observations.size(); ++i) labels[i] = told[i];
  }
};
struct ToldPolicies : mock::Policies {
  using Classifier = ToldClassifier;
};

inline Label label(bool keep, float probability) {
  Label result;
  result.keep = keep;
  result.verdict = keep ? Verdict::kept : Verdict::dynamic;
  result.probability = probability;
  return result;
}

/// The result of a frame of 8 × 6 pixels.
class ToldResult : public testing::Test {
 protected:
  const FrameResult& judge(const std::vector<Vector2f>& pixels, const std::vector<Label>& labels) {
    filter.classifier.told = labels;
    filter.filter_frame(FrameView(gray, DepthView(), 1.0), pixels);
    return filter.filter_frame(FrameView(gray, DepthView(), 1.1), pixels);
  }

  FrameFilter<ToldPolicies> filter{Camera(10, 10, 3.5, 2.5, 8, 6)};
  cv::Mat gray = cv::Mat(6, 8, CV_8UC1, cv::Scalar(0));
};

}  // namespace stillpoint::told_result
