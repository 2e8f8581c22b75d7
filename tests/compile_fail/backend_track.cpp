// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A backend whose pose nobody can use.
// expected: stillpoint: Backend must offer std::optional<Pose> track(const FrameView&, const Features&); see stillpoint/filtered_tracker.hpp

#include "sound_tracker.hpp"

struct PoselessBackend {
  SoundFeatures extract(const stillpoint::FrameView&) { return {}; }
  bool track(const stillpoint::FrameView&, const SoundFeatures&) { return false; }
};

#ifdef STILLPOINT_MISTAKE
using Backend = PoselessBackend;
#else
using Backend = SoundBackend;
#endif

template void use<stillpoint::NullFilter, Backend>();
