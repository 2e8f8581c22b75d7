// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A pixel of doubles, which Eigen would refuse in words of its own.
// expected: stillpoint: specialise stillpoint::keypoint_traits<YourKeypoint> with static Vector2f pixel(const YourKeypoint&); see core/keypoint.hpp

#include "sound_policies.hpp"

struct HostKeypoint {
  double column, row;
};

template <>
struct stillpoint::keypoint_traits<HostKeypoint> {
#ifdef STILLPOINT_MISTAKE
  static Vector2d pixel(const HostKeypoint& keypoint) { return {keypoint.column, keypoint.row}; }
#else
  static Vector2f pixel(const HostKeypoint& keypoint) {
    return {static_cast<float>(keypoint.column), static_cast<float>(keypoint.row)};
  }
#endif
};

void filter_host_keypoints(stillpoint::FrameFilter<SoundPolicies>& filter) {
  filter.filter_frame(stillpoint::FrameView(), std::vector<HostKeypoint>(3));
}
