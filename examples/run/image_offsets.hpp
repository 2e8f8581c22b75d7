// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How far each feature is from where it would be if it stood still: for drawings alone.

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "frame_record.hpp"
#include "frame_source.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/match/lucas_kanade.hpp"

namespace stillpoint_run {

/// How far each feature is from where it would be if it stood still, in the image. For the drawing alone: the filter's
/// own matches are not public, so that this looks for the features again.
class ImageOffsets {
 public:
  /// Frames are kept for as long as a motion may refer back to them.
  void remember(SourceFrame frame) {
    constexpr std::size_t kLongestHistory = 16;
    history_.push_back(std::move(frame));
    if (history_.size() > kLongestHistory) history_.pop_front();
  }

  /// Pixels; NaN where a feature has no match, no depth, or the frame no motion.
  std::vector<stillpoint::Vector2f> of(const SourceFrame& frame, const FrameRecord& record,
                                       const stillpoint::Camera& camera) const {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    std::vector<stillpoint::Vector2f> offsets(record.pixels.size(), {kNaN, kNaN});
    const stillpoint::Motion& motion = record.summary.motion;
    const auto reference = std::find_if(history_.begin(), history_.end(), [&motion](const SourceFrame& past) {
      return past.timestamp_s == motion.reference_timestamp_s;
    });
    if (!motion.usable() || reference == history_.end()) return offsets;

    stillpoint::Matches matches;
    matches.begin(record.pixels);
    stillpoint::LucasKanade().match(reference->view(), frame.view(), matches);
    stillpoint::lift(reference->view(), stillpoint::RoundedDepth{}, camera, stillpoint::KinectNoise{},
                     matches.reference);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      if (!matches.matched(i) || !matches.reference.has_depth(i)) continue;
      const stillpoint::Vector3d moved = motion.current_from_reference * matches.reference.point[i];
      if (!(moved.z() > 0)) continue;
      offsets[i] = record.pixels[i] - camera.distort(camera.project(moved)).cast<float>();
    }
    return offsets;
  }

 private:
  std::deque<SourceFrame> history_;
};

}  // namespace stillpoint_run
