// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A Frame of a fork that keeps its depths under another name.
// expected: stillpoint: an ORB-SLAM Frame must have mvDepth, one float per keypoint; see adapters/orb_slam.hpp

#include <vector>

#include "stillpoint/adapters/orb_slam.hpp"

struct Frame {
  std::vector<cv::KeyPoint> mvKeys, mvKeysUn;
  std::vector<float> mvuRight;
#ifndef STILLPOINT_MISTAKE
  std::vector<float> mvDepth;
#endif
  cv::Mat mDescriptors;
  int N = 0;
};

std::size_t use(const std::vector<std::uint8_t>& keep, Frame& frame) {
  return stillpoint::orb_slam::compact_after_depth(keep, frame);
}
