// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How a host's keypoints are read: one trait, so that no host must convert its own.

#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Specialise for your keypoint type with `static Vector2f pixel(const Keypoint&)`: its position in the image as it is
/// (distorted, as detected), pixels, integer coordinates at pixel centres. Eigen's 2-vectors are here, OpenCV's types
/// in opencv.hpp.
template <class Keypoint, class = void>
struct keypoint_traits;

template <class Scalar>
struct keypoint_traits<Eigen::Matrix<Scalar, 2, 1>> {
  static Vector2f pixel(const Eigen::Matrix<Scalar, 2, 1>& keypoint) { return to_float(keypoint); }
};

namespace detail {
template <class Keypoint, class = void>
struct has_keypoint_traits : std::false_type {};
template <class Keypoint>
struct has_keypoint_traits<Keypoint,
                           std::void_t<decltype(keypoint_traits<Keypoint>::pixel(std::declval<const Keypoint&>()))>> {
  using Pixel = std::decay_t<decltype(keypoint_traits<Keypoint>::pixel(std::declval<const Keypoint&>()))>;
  // Eigen lets a vector of doubles pass for one of floats, and fails within itself.
  static constexpr bool value = std::is_convertible_v<Pixel, Vector2f> && !std::is_same_v<Pixel, Vector2d>;
};

template <class Range, class = void>
struct is_contiguous : std::false_type {};
template <class Range>
struct is_contiguous<Range, std::void_t<decltype(span(std::declval<const Range&>()))>> : std::true_type {};
}  // namespace detail

/// @param keypoints  any contiguous range of a type with `keypoint_traits`
/// @param pixels     overwritten; its memory is reused
template <class Keypoints>
span<const Vector2f> read_pixels(const Keypoints& keypoints, std::vector<Vector2f>& pixels) {
  static_assert(detail::is_contiguous<Keypoints>::value,
                "stillpoint: keypoints must be contiguous in memory, as std::vector, std::array or an array is; "
                "copy others, such as std::deque, into a std::vector");
  pixels.clear();
  if constexpr (detail::is_contiguous<Keypoints>::value) {
    using Keypoint = typename decltype(span(keypoints))::value_type;
    static_assert(detail::has_keypoint_traits<Keypoint>::value,
                  "stillpoint: specialise stillpoint::keypoint_traits<YourKeypoint> with static Vector2f pixel(const "
                  "YourKeypoint&); see core/keypoint.hpp");
    if constexpr (detail::has_keypoint_traits<Keypoint>::value)
      for (const Keypoint& keypoint : keypoints) pixels.push_back(keypoint_traits<Keypoint>::pixel(keypoint));
  }
  return pixels;
}

}  // namespace stillpoint
