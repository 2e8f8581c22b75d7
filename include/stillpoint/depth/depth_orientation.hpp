// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is the depth image the right way round?   Where depth jumps, the image mostly changes, too.

#include <algorithm>
#include <cstddef>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/depth/depth_jumps.hpp"

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
    for_each_depth_jump(frame.depth, kRows, [&](int u, int v, float) { sums.add(gray, depth, u, v); });
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
  static constexpr int kRows = 60;
  static constexpr int kReach_px = kDepthJumpReach_px;  // the two images are never aligned to one pixel
  static constexpr double kClearly = 1.25;
  static constexpr std::size_t kFewestJumps = 30;

  void add(const ImageView& gray, const ImageView& depth, int u, int v) noexcept {
    const int x = u * gray.width / depth.width, y = v * gray.height / depth.height;
    const int other_x = gray.width - 1 - x, other_y = gray.height - 1 - y;
    ++jumps;
    as_is += gray_step(gray, x, y, kReach_px);
    mirrored += gray_step(gray, other_x, y, kReach_px);
    upside_down += gray_step(gray, x, other_y, kReach_px);
    turned += gray_step(gray, other_x, other_y, kReach_px);
  }
};

}  // namespace stillpoint
