// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Keypoints that do not lie side by side in memory.
// expected: stillpoint: keypoints must be contiguous in memory, as std::vector, std::array or an array is; copy others, such as std::deque, into a std::vector

#include <deque>

#include "sound_policies.hpp"

#ifdef STILLPOINT_MISTAKE
using Keypoints = std::deque<stillpoint::Vector2f>;
#else
using Keypoints = std::vector<stillpoint::Vector2f>;
#endif

void filter_host_keypoints(stillpoint::FrameFilter<SoundPolicies>& filter) {
  filter.filter_frame(stillpoint::FrameView(), Keypoints(3));
}
