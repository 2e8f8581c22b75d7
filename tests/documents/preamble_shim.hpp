// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the code in shim/README.md takes for granted, in C++11.

#include <opencv2/core.hpp>
#include <stillpoint_shim.hpp>
#include <vector>

namespace documents {

extern const cv::Mat gray, depth;
extern const double time;
extern std::vector<cv::KeyPoint> keypoints;
extern cv::Mat descriptors;
extern std::vector<float> depths;
extern stillpoint_shim::Filter filter;

}  // namespace documents
