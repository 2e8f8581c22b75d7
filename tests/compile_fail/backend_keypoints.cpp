// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Features that call their keypoints something else.
// expected: stillpoint: Backend::extract must return features with a public, contiguous `keypoints` whose element has stillpoint::keypoint_traits; see core/keypoint.hpp

#include "sound_tracker.hpp"

struct CornerFeatures {
  std::vector<stillpoint::Vector2f> corners;
  void compact(stillpoint::span<const std::uint8_t>) {}
};

#ifdef STILLPOINT_MISTAKE
using Backend = SoundBackendOf<CornerFeatures>;
#else
using Backend = SoundBackend;
#endif

template void use<stillpoint::NullFilter, Backend>();
