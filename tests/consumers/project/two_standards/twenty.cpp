// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#if __cplusplus != 202002L
#error "this file is C++20"
#endif

#include "../tripod_policies.hpp"

using Filter = stillpoint::FrameFilter<TripodPolicies>;

Filter make_filter();

/// The filter was made by a file of the other standard.
std::size_t count_kept() {
  Filter filter = make_filter();
  const std::vector<std::uint8_t> pixels(64 * 48, 100);
  const stillpoint::ImageView gray(pixels.data(), 64, 48, 64, stillpoint::PixelFormat::gray8);
  const std::vector<stillpoint::Vector2f> keypoints = {{20, 20}, {40, 20}, {20, 30}, {40, 30}};
  return filter.filter_frame({gray, stillpoint::ImageView(), 0.0}, keypoints).kept_count();
}
