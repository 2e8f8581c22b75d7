// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Lengths in pixels scale with the focal length: an option of 8 px means the same angle in every camera.

#include "stillpoint/core/geometry.hpp"

namespace stillpoint {

/// Focal length over 525 px, a Kinect's.
template <class Camera>
float pixel_scale(const Camera& camera) noexcept {
  constexpr double kFocal_px = 525.0;
  return static_cast<float>(camera.fx() / kFocal_px);
}

/// A length that options give for a focal length of 525 px, in whole pixels of this camera.
template <class Camera>
int scaled_px(int length_px, const Camera& camera) noexcept {
  return rounded(pixel_scale(camera) * static_cast<float>(length_px));
}

}  // namespace stillpoint
