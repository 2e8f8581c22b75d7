// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host that leaves the pipeline to the library: the same lines as with the headers alone.

#include <cstdio>
#include <opencv2/core.hpp>
#include <stillpoint/stillpoint.hpp>
#include <utility>
#include <vector>

int main() {
  cv::Mat gray(480, 640, CV_8UC1);
  for (int v = 0; v < gray.rows; ++v)
    for (int u = 0; u < gray.cols; ++u)
      gray.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(37 * (u / 8 + v / 8 * 5));
  const cv::Mat depth_m(gray.size(), CV_32FC1, cv::Scalar(2.0));
  std::vector<cv::KeyPoint> keypoints = {{200, 200, 7}, {400, 200, 7}, {200, 300, 7}, {400, 300, 7}};
  cv::Mat descriptors(4, 32, CV_8UC1, cv::Scalar(1));

  stillpoint::FrameFilter<> made(stillpoint::Camera(525, 525, 319.5, 239.5, 640, 480));
  made.gate.options.false_positive_rate = 0.02;
  stillpoint::FrameFilter<> filter = std::move(made);
  filter.filter_frame({gray, depth_m, 0.0}, keypoints);
  const stillpoint::FrameResult& result = filter.filter_frame({gray, depth_m, 0.1}, keypoints);
  stillpoint::compact(result.keep(), keypoints, descriptors);
  std::printf("kept %zu of 4, %s\n", keypoints.size(), stillpoint::to_string(result.status()));
}
