// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// OpenVINS takes a mask with each image, of inverse polarity: what is over 127 is dropped.   It ends tracks there and
// begins none. It tests tracked points with the mask of their own image; new corners are found in the last image under
// the last mask. It has no depth: the filter needs a prior, or a depth camera beside it. No header of the host is
// included: members are meant by name.

#include <cstddef>
#include <initializer_list>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>

#include "stillpoint/adapters/host_arrays.hpp"
#include "stillpoint/adapters/host_masks.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/verdict/keep_floor.hpp"

namespace stillpoint::openvins {

namespace detail {

// clang-format off
/// What `set_masks_255_drops` touches. One message, for the first member that is missing.
template <class CameraData>
struct CameraDataContract {
  static constexpr bool kImages = offers<CameraData>([](auto& m) -> decltype(void(m.images.size())) {});
  static constexpr bool kMasks = kImages && offers<CameraData>([](auto& m) -> decltype(m.masks.push_back(cv::Mat())) {});
  static_assert(kImages, "stillpoint: an OpenVINS CameraData must have images, a vector of cv::Mat; see adapters/openvins.hpp");
  static_assert(!kImages || kMasks, "stillpoint: an OpenVINS CameraData must have masks, a vector of cv::Mat; see adapters/openvins.hpp");
  static constexpr bool holds = kMasks;
};
// clang-format on

}  // namespace detail

/// Fills `masks` of a message with one mask for each of its images: 255 where the host shall drop, else 0. Each has
/// pixels of its own, because the host looks at the last frame's mask again. Where the host halves images
/// (downsample_cameras), pyrDown blurs a mask's edge by some two pixels: keep a margin around moving objects.
/// @param message  CameraData with its images; what `masks` held is given up
/// @param masks    one for each image: gray8 of its size, 255 keeps; an empty one drops nothing
/// @throws Error if the number of masks or a mask's size or format is another; then `masks` of the message is unchanged
template <class CameraData>
void set_masks_255_drops(CameraData& message, std::initializer_list<ImageView> masks) {
  if constexpr (detail::CameraDataContract<CameraData>::holds) {
    if (masks.size() != message.images.size())
      throw Error("openvins: " + std::to_string(masks.size()) + " masks, expected one for each of the " +
                  std::to_string(message.images.size()) + " images");
    decltype(message.masks) inverse;
    for (const ImageView& mask : masks) {
      const cv::Mat& image = message.images[inverse.size()];
      if (!mask.empty()) require_mask_of_size("openvins", mask, image.cols, image.rows);
      inverse.push_back(mask.empty() ? cv::Mat(cv::Mat::zeros(image.rows, image.cols, CV_8UC1)) : mask_255_drops(mask));
    }
    message.masks = std::move(inverse);
  }
}

/// How much must be left for the host: below 10 points it forgets all tracks. More here, because its own checks take
/// some of them.
inline KeepFloor::Options keep_floor() {
  KeepFloor::Options options;
  options.fewest_features = 20;
  return options;
}

}  // namespace stillpoint::openvins
