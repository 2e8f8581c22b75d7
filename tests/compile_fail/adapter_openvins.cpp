// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A message whose masks are not cv::Mat.
// expected: stillpoint: an OpenVINS CameraData must have masks, a vector of cv::Mat; see adapters/openvins.hpp

#include <vector>

#include "stillpoint/adapters/openvins.hpp"

struct CameraData {
  std::vector<cv::Mat> images;
#ifdef STILLPOINT_MISTAKE
  std::vector<bool> masks;
#else
  std::vector<cv::Mat> masks;
#endif
};

void use(CameraData& message, const cv::Mat& mask) { stillpoint::openvins::set_masks_255_drops(message, {mask}); }
