// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the code in README.md and docs/ takes for granted: the names of things that a host has at hand. What one page
// alone needs is told on that page, in a line `<!-- given: CODE -->`.

#include <filesystem>
#include <opencv2/core.hpp>
#include <stillpoint/detectors/async_detector.hpp>
#include <stillpoint/policies.hpp>
#include <stillpoint/stillpoint.hpp>
#include <vector>

namespace documents {

extern const stillpoint::Camera camera;
extern const cv::Mat gray, bgr, depth;
extern const double time, timestamp_s;
extern const stillpoint::FrameView frame;
extern std::vector<cv::KeyPoint> keypoints;
extern cv::Mat descriptors;
extern std::vector<float> depths;
extern stillpoint::FrameFilter<> filter;
extern const stillpoint::FrameResult& result;

extern const std::filesystem::path model;
extern const std::vector<stillpoint::Detection> detections;
struct MyDetector {
  void detect(const stillpoint::ImageView& image, std::vector<stillpoint::Detection>& found);
};

}  // namespace documents
