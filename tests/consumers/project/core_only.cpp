// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A host without OpenCV: it has tracks and a pose of its own, and a type of its own for pixels.

#include <cstdio>

#include "tripod_policies.hpp"

int main() {
  std::vector<std::uint8_t> pixels(64 * 48, 100);
  const stillpoint::ImageView gray(pixels.data(), 64, 48, 64, stillpoint::PixelFormat::gray8);
  const std::vector<stillpoint::Vector2f> keypoints = {{20, 20}, {40, 20}, {20, 30}, {40, 30}};

  stillpoint::FrameFilter<TripodPolicies> filter(stillpoint::Camera(60, 60, 32, 24, 64, 48));
  std::size_t kept = 0;
  for (const double time_s : {0.0, 0.1}) {
    filter.matcher.reference_pixels = keypoints;
    kept = filter.filter_frame({gray, stillpoint::ImageView(), time_s}, keypoints).kept_count();
  }
  std::printf("kept %zu of %zu\n", kept, keypoints.size());
}
