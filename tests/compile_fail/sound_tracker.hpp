// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The least that keeps the contract of FilteredTracker. A file replaces one part by one that does not.

#include <cstdint>
#include <optional>
#include <vector>

#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/null_filter.hpp"

struct SoundFeatures {
  std::vector<stillpoint::Vector2f> keypoints;
  void compact(stillpoint::span<const std::uint8_t>) {}
};

template <class Features>
struct SoundBackendOf {
  Features extract(const stillpoint::FrameView&) { return {}; }
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView&, const Features&) { return std::nullopt; }
};
using SoundBackend = SoundBackendOf<SoundFeatures>;

template <class Filter, class Backend>
void use() {
  stillpoint::FilteredTracker<Filter, Backend> tracker(Filter{}, Backend{});
  tracker.track(stillpoint::FrameView());
}
