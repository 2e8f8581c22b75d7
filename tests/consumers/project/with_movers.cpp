// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host that follows the objects that move: the same lines with the headers alone and with the compiled pipeline.

#include <cstdio>
#include <opencv2/core.hpp>
#include <stillpoint/policies/with_movers.hpp>
#include <stillpoint/stillpoint.hpp>
#include <vector>

int main() {
  const cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(90)), depth_m(gray.size(), CV_32FC1, cv::Scalar(2.0));
  const std::vector<cv::Point2f> pixels = {{100, 100}, {200, 100}, {100, 150}, {200, 150}};
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter(stillpoint::Camera(262, 262, 159.5, 119.5, 320, 240));
  const stillpoint::FrameResult& result = filter.filter_frame({gray, depth_m, 0.0}, pixels);
  for (const stillpoint::Mover& mover : result.movers()) std::printf("%.2f m/s\n", mover.velocity.norm());
  std::printf("kept %zu of %zu\n", result.kept_count(), result.size());
}
