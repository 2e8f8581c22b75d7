// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What the adapters share: masks of the polarity that a host wants. They hold 0 and 255 only, because hosts disagree
// about what lies between.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/mask.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {

/// @param user   begins the message
/// @param mask   what is looked at
/// @param width  pixels of the image
/// @param height pixels of the image
/// @throws Error unless the mask is gray8 and of this size
inline void require_mask_of_size(const char* user, const ImageView& mask, int width, int height) {
  require_mask(user, mask);
  if (mask.width != width || mask.height != height)
    throw Error(std::string(user) + ": the mask has " + std::to_string(mask.width) + "x" + std::to_string(mask.height) +
                " pixels, expected the image's " + std::to_string(width) + "x" + std::to_string(height));
}

/// A mask for hosts in which 255 keeps (or "free", "detect here") and 0 drops, with pixels of its own, so that a host
/// may hold on to it.
/// @param mask  gray8; what is not 0 keeps
/// @throws Error unless the mask is gray8
inline cv::Mat mask_255_keeps(const ImageView& mask) {
  require_mask("mask_255_keeps", mask);
  return as_mat(mask) != 0;
}

/// The inverse, for hosts in which 255 drops and 0 keeps.
/// @param mask  gray8; what is not 0 keeps, as everywhere in stillpoint
/// @throws Error unless the mask is gray8
inline cv::Mat mask_255_drops(const ImageView& mask) {
  require_mask("mask_255_drops", mask);
  return as_mat(mask) == 0;
}

}  // namespace stillpoint
