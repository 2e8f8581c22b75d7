// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A tracker in the manner of VINS that does not count how long it has followed a point.
// expected: stillpoint: a VINS FeatureTracker must have track_cnt, one a tracked pixel; see adapters/vins.hpp

#include <opencv2/core/types.hpp>
#include <vector>

#include "stillpoint/adapters/vins.hpp"

struct FeatureTracker {
  std::vector<cv::Point2f> cur_pts;
  std::vector<int> ids;
#ifndef STILLPOINT_MISTAKE
  std::vector<int> track_cnt;
#endif
};

std::size_t use(const std::vector<std::uint8_t>& keep, FeatureTracker& tracker) {
  return stillpoint::vins::compact_tracks(keep, tracker);
}
