// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The frame where its observation is wanted.
// expected: stillpoint: a stella_vslam frame_observation must have descriptors_, undist_keypts_, bearings_, stereo_x_right_, depths_ and keypt_indices_in_cells_; see adapters/stella_vslam.hpp

#include <vector>

#include "stillpoint/adapters/stella_vslam.hpp"

struct Observation {
  cv::Mat descriptors_;
  std::vector<cv::KeyPoint> undist_keypts_;
  std::vector<Eigen::Vector3d> bearings_;
  std::vector<float> stereo_x_right_, depths_;
  std::vector<std::vector<std::vector<unsigned int>>> keypt_indices_in_cells_;
};
struct Frame {
  Observation frm_obs_;
};

std::size_t use(const std::vector<std::uint8_t>& keep, Frame& frame, std::vector<int>& old_to_new) {
#ifdef STILLPOINT_MISTAKE
  return stillpoint::stella_vslam::compact_observation(keep, frame, old_to_new);
#else
  return stillpoint::stella_vslam::compact_observation(keep, frame.frm_obs_, old_to_new);
#endif
}
