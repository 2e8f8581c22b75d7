// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Features that nothing can be dropped from.
// expected: stillpoint: Backend::extract must return features with void compact(span<const std::uint8_t> keep); see core/compact.hpp

#include "sound_tracker.hpp"

struct RigidFeatures {
  std::vector<stillpoint::Vector2f> keypoints;
};

#ifdef STILLPOINT_MISTAKE
using Backend = SoundBackendOf<RigidFeatures>;
#else
using Backend = SoundBackend;
#endif

template void use<stillpoint::NullFilter, Backend>();
