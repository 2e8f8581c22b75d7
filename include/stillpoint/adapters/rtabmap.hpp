// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// RTAB-Map takes depth with holes, or features that were found elsewhere.   Both go into its SensorData, without a
// patch.
//
//   features  compact_features            then SensorData::setFeatures: registration detects none of its own
//   depth     depth_0_drops               clouds and grids lose moving objects as well
//
// The host keeps what it is given in queues: both hand over memory of their own.

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/verdict/keep_floor.hpp"
#include "stillpoint/verdict/masked_depth.hpp"

namespace stillpoint::rtabmap {

/// Compacts the three arguments of SensorData::setFeatures together, in order. The last two may be empty, as there.
/// @param keep         one byte per keypoint, 0 drops
/// @param keypoints    pixels
/// @param keypoints3D  points in the camera's frame, as the host wants them
/// @param descriptors  one row a keypoint
/// @return how many are left
/// @throws Error that names the array if one has another size than `keep`; then nothing was changed. O(n).
template <class Keypoints, class Keypoints3D, class Descriptors>
std::size_t compact_features(span<const std::uint8_t> keep, Keypoints& keypoints, Keypoints3D& keypoints3D,
                             Descriptors& descriptors) {
  return compact_host_arrays("rtabmap", keep, host_array("keypoints", keypoints),
                             optional_host_array("keypoints3D", keypoints3D),
                             optional_host_array("descriptors", descriptors));
}

/// A copy of the depth with 0 where the mask drops, which Vis/DepthAsMask and Mem/DepthAsMask (both on by default) read
/// as "detect nothing here". The image's size must be a multiple of the depth's, or the host takes no mask of it.
/// @param depth  16 bit (millimetres) or float (metres)
/// @param mask   gray8 with the depth's field of view, of any size, 255 keeps
/// @throws Error if the depth has another type or the mask is no gray8 image
inline cv::Mat depth_0_drops(const cv::Mat& depth, const ImageView& mask) {
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1)
    throw Error("rtabmap: the depth has OpenCV's type " + std::to_string(depth.type()) +
                ", expected CV_16UC1 (millimetres) or CV_32FC1 (metres)");
  require_mask("rtabmap", mask);
  ImageBuffer masked;
  masked_depth(DepthView(depth), mask, masked);
  return as_mat(masked.view()).clone();
}

/// How much must be left for the host: Vis/MinInliers, 20, and once lost it stays lost (Odom/ResetCountdown 0). Twice
/// as many here, because not every feature finds its match.
inline KeepFloor::Options keep_floor() {
  KeepFloor::Options options;
  options.fewest_features = 40;
  return options;
}

}  // namespace stillpoint::rtabmap
