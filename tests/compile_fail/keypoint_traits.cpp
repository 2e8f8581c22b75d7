// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host's own keypoint type that nobody has explained to the library.
// expected: stillpoint: specialise stillpoint::keypoint_traits<YourKeypoint> with static Vector2f pixel(const YourKeypoint&); see core/keypoint.hpp

#include "sound_policies.hpp"

struct HostKeypoint {
  float column, row;
};

#ifndef STILLPOINT_MISTAKE
template <>
struct stillpoint::keypoint_traits<HostKeypoint> {
  static Vector2f pixel(const HostKeypoint& keypoint) { return {keypoint.column, keypoint.row}; }
};
#endif

void filter_host_keypoints(stillpoint::FrameFilter<SoundPolicies>& filter) {
  filter.filter_frame(stillpoint::FrameView(), std::vector<HostKeypoint>(3));
}
