// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is the depth image the right way round?   Where depth jumps, the image mostly changes, too.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/frame.hpp"

namespace stillpoint {

/// The mean gray step at the jumps of the depth image as it is and as it would be if it were turned over.
struct DepthOrientation {
  std::size_t jumps = 0;
  double as_is = 0, mirrored = 0, upside_down = 0, turned = 0;  ///< gray levels; turned by 180 degrees

  /// @param frame  with gray; the depth image may have another size
  static DepthOrientation of(const FrameView& frame) noexcept {
    DepthOrientation sums;
    const ImageView &gray = frame.gray, &depth = frame.depth.image;
    if (gray.empty() || depth.empty() || depth.width < 8 * kReach_px || gray.width < 8 * kReach_px) return sums;
    const int stride_px = std::max(depth.height / kRows, 1);
    for (int v = stride_px / 2; v < depth.height; v += stride_px) {
      float before_m = frame.depth.metres(0, v);
      for (int u = kReach_px; u < depth.width; u += kReach_px) {
        const float here_m = frame.depth.metres(u, v);
        const float nearer_m = std::min(before_m, here_m);
        if (nearer_m > 0 && std::abs(here_m - before_m) > kJump * nearer_m) sums.add(gray, depth, u - kReach_px / 2, v);
        before_m = here_m;
      }
    }
    if (sums.jumps == 0) return sums;
    for (double* sum : {&sums.as_is, &sums.mirrored, &sums.upside_down, &sums.turned})
      *sum /= static_cast<double>(sums.jumps);
    return sums;
  }

  /// Does depth jump in places enough?
  bool tells() const noexcept { return jumps >= kFewestJumps; }

  /// Would it fit clearly better the other way round?
  bool is_wrong() const noexcept { return tells() && std::max({mirrored, upside_down, turned}) > kClearly * as_is; }

 private:
  static constexpr int kRows = 60, kReach_px = 4;
  static constexpr float kJump = 0.1f;  // of the depth
  static constexpr double kClearly = 1.25;
  static constexpr std::size_t kFewestJumps = 30;

  void add(const ImageView& gray, const ImageView& depth, int u, int v) noexcept {
    const int x = u * gray.width / depth.width, y = v * gray.height / depth.height;
    const int other_x = gray.width - 1 - x, other_y = gray.height - 1 - y;
    ++jumps;
    as_is += step(gray, x, y);
    mirrored += step(gray, other_x, y);
    upside_down += step(gray, x, other_y);
    turned += step(gray, other_x, other_y);
  }

  /// Over some pixels: the two images are never aligned to one.
  static double step(const ImageView& gray, int x, int y) noexcept {
    const std::uint8_t* const row = gray.row<std::uint8_t>(std::clamp(y, 0, gray.height - 1));
    const int left = std::max(x - kReach_px, 0), right = std::min(x + kReach_px, gray.width - 1);
    return std::abs(static_cast<int>(row[right]) - static_cast<int>(row[left]));
  }
};

}  // namespace stillpoint
