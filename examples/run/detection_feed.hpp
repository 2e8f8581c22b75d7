// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the detector says of each frame: all that the sequence knows, or as much as a slow or careless one would find.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "frame_record.hpp"
#include "frame_source.hpp"
#include "options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/prior/mobility_table.hpp"

namespace stillpoint_run {

/// Answers for every n-th frame, with a share of the boxes left out at random.
class DetectionFeed {
 public:
  explicit DetectionFeed(const Options& options)
      : every_(static_cast<std::size_t>(options.detect_every)),
        dropped_share_(options.drop_boxes),
        random_(options.seed) {}

  /// The detector's answer for the next frame; none where it was not asked, or nobody detects.
  std::optional<std::vector<stillpoint::Detection>> next(const SourceFrame& frame) {
    if (frame_++ % every_ != 0) return std::nullopt;
    std::vector<stillpoint::Detection> found = detections_of(frame, mobility_);
    const auto is_missed = [&](const stillpoint::Detection&) {
      return dropped_share_ > 0 && random_.uniform() < dropped_share_;
    };
    found.erase(std::remove_if(found.begin(), found.end(), is_missed), found.end());
    return found;
  }

 private:
  std::size_t every_, frame_ = 0;
  double dropped_share_;
  stillpoint::Random random_;
  stillpoint::MobilityTable mobility_;
};

}  // namespace stillpoint_run
