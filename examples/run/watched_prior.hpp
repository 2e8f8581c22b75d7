// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A prior that remembers which regions it gave the filter, for the report.

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/async_detector.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/prior/propagated_prior.hpp"
#include "used_region.hpp"

namespace stillpoint_run {

/// @tparam Prior  `BoxPrior` or what is built on it
template <class Prior>
class WatchedPrior : public Prior {
 public:
  /// Hands over what the detector says, before the filter looks at the frame. A prior that does not carry boxes holds
  /// the last answer until the next.
  /// @param answer  null: nothing new
  void prepare(double timestamp_s, const stillpoint::DetectorAnswer* answer) {
    is_of_this_frame_ = answer != nullptr && answer->timestamp_s == timestamp_s;
    used_.clear();
    if (answer == nullptr) return;
    if (is_of_this_frame_)
      for (const stillpoint::Detection& detection : answer->detections) used_.push_back({detection, false});
    if constexpr (std::is_base_of_v<stillpoint::PropagatedPrior, Prior>)
      this->detected(answer->timestamp_s, answer->detections);
    else
      this->detections = answer->detections;
  }

  void regions(const stillpoint::FrameView& frame, stillpoint::Regions& regions) {
    const auto handed_over = static_cast<std::size_t>(
        std::count_if(this->detections.begin(), this->detections.end(),
                      [this](const stillpoint::Detection& detection) { return this->is_valid(detection); }));
    Prior::regions(frame, regions);
    used_.clear();
    for (std::size_t i = 0; i < regions.detections.size(); ++i)
      used_.push_back({regions.detections[i], !(is_of_this_frame_ && i < handed_over)});
  }

  /// Of the last frame. Of one that was not judged: what was seen in it.
  const std::vector<UsedRegion>& used() const { return used_; }

 private:
  bool is_of_this_frame_ = false;
  std::vector<UsedRegion> used_;
};

/// A policy set whose prior can be looked at; its filter answers as without.
template <class Policies>
struct Watched : Policies {
  using Prior = WatchedPrior<typename Policies::Prior>;
};

}  // namespace stillpoint_run
