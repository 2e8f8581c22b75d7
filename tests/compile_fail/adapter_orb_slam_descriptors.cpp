// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// At the hook after extraction, something that is no Frame.
// expected: stillpoint: an ORB-SLAM Frame must have mDescriptors, one row a keypoint; see adapters/orb_slam.hpp

#include <vector>

#include "stillpoint/adapters/orb_slam.hpp"

struct Frame {
  std::vector<cv::KeyPoint> mvKeys;
#ifndef STILLPOINT_MISTAKE
  cv::Mat mDescriptors;
#endif
};

std::size_t use(const std::vector<std::uint8_t>& keep, Frame& frame) {
  return stillpoint::orb_slam::compact_after_extraction(keep, frame);
}
