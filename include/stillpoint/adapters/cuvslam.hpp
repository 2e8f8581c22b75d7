// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// cuVSLAM takes a mask with each image (Odometry::Track), of inverse polarity: what is not 0 is dropped, and in RGB-D
// its depth is ignored, too. Of any resolution.

#include <opencv2/core/mat.hpp>

#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/image.hpp"

namespace stillpoint::cuvslam {

/// 255 where the host shall drop, else 0: one byte per pixel, rows without gaps.
/// @param mask  gray8, 255 keeps
/// @throws Error if it is empty or no gray8 image
inline cv::Mat mask_nonzero_drops(const ImageView& mask) { return mask_255_drops(mask); }

}  // namespace stillpoint::cuvslam
