// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A filter that does not say what it keeps.
// expected: stillpoint: Filter must offer filter_frame(const FrameView&, const Keypoints&), whose result has keep() -> span<const std::uint8_t>; see stillpoint/null_filter.hpp

#include "sound_tracker.hpp"

struct SilentFilter {
  template <class Keypoints>
  void filter_frame(const stillpoint::FrameView&, const Keypoints&) {}
};

#ifdef STILLPOINT_MISTAKE
using Filter = SilentFilter;
#else
using Filter = stillpoint::NullFilter;
#endif

template void use<Filter, SoundBackend>();
