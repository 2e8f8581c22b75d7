// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A backend that keeps its features to itself.
// expected: stillpoint: Backend must offer Features extract(const FrameView&); see stillpoint/filtered_tracker.hpp

#include "sound_tracker.hpp"

struct SilentBackend {
  void extract(const stillpoint::FrameView&) {}
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView&) { return std::nullopt; }
};

#ifdef STILLPOINT_MISTAKE
using Backend = SilentBackend;
#else
using Backend = SoundBackend;
#endif

template void use<stillpoint::NullFilter, Backend>();
