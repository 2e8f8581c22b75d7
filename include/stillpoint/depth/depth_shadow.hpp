// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which holes of a depth image are shadows of its sensor, and so lie on the farther surface beside them?

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// A sensor with a projector, or with two lenses, measures what is seen from two places, a baseline B apart. Beside a
/// nearer surface, on one side, a strip of the farther one has no depth: f B (1 / z_near − 1 / z_far) pixels wide. Of
/// one sensor all strips have one baseline; holes that hair, dark cloth or glass leave have any. So B is measured in
/// every frame: most jumps of depth to one side must have such a strip. A sensor without shadows has no B, and nothing
/// is said of its holes.
class DepthShadow {
 public:
  /// Measures B for both sides. One pass over every eighth row; allocates nothing.
  /// @param camera  of the gray image
  template <class Camera>
  DepthShadow(const FrameView& frame, const Camera& camera)
      : depth_(frame.depth),
        to_depth_(frame.gray, frame.depth.image),
        focal_px_(camera.fx() * static_cast<double>(to_depth_.x)) {
    if (depth_.empty()) return;
    if (depth_.image.format == PixelFormat::depth16)
      measure<std::uint16_t>();
    else
      measure<float>();
  }

  /// Metres; 0: that side has no shadows.
  double baseline_on_left_m() const noexcept { return baseline_m_[kFarOnLeft]; }
  double baseline_on_right_m() const noexcept { return baseline_m_[kFarOnRight]; }

  /// @param pixel  of the gray image
  /// @return       the depth of the surface that the pixel lies on, metres, if it lies in a shadow; else 0
  double farther_m(const Vector2f& pixel) const noexcept {
    if (!(std::max(baseline_m_[kFarOnLeft], baseline_m_[kFarOnRight]) > 0)) return 0.0;
    const Vector2f at = to_depth_(pixel);
    if (!(depth_.image.border_distance_px(at.x(), at.y()) >= 0.0f)) return 0.0;
    return farther_m(rounded(at.x()), rounded(at.y()));
  }

 private:
  enum Side : std::size_t { kFarOnLeft, kFarOnRight };

  static constexpr int kRowStep = 8;  // rows that are measured
  static constexpr int kBins = 25;    // of the measured baselines, a centimetre each
  static constexpr double kBin_m = 0.01;
  static constexpr double kLeastPxPerMetre = 100.0;  // jumps that measure B to a bin: a hole's width is whole pixels
  static constexpr int kFewestJumps = 20;
  static constexpr double kMostly = 0.5;     // share of the jumps to a side that must have a shadow of one baseline
  static constexpr double kJump = 0.1;       // of the depth
  static constexpr double kNearest_m = 0.4;  // nearer surfaces have wider shadows than are looked for

  // A shadow ends where the farther surface is seen again, and no hole is much wider than it. Corners at the nearer
  // surface's very edge are its own: hair and sleeves end there. docs/design/sweeps.md, "Shadows of the sensor".
  static constexpr int kOccludersEdge_px = 2;
  static constexpr double kEnd_px = 1.0, kWidest = 1.25, kWidest_px = 3.0;

  /// How many pixels the shadow of a baseline of one metre is wide; 0 where depth does not jump.
  double px_per_metre(float depth_on_left_m, float depth_on_right_m) const noexcept {
    const auto left_m = static_cast<double>(depth_on_left_m), right_m = static_cast<double>(depth_on_right_m);
    const double nearer_m = std::min(left_m, right_m), farther_m = std::max(left_m, right_m);
    return farther_m > (1.0 + kJump) * nearer_m ? focal_px_ * (1.0 / nearer_m - 1.0 / farther_m) : 0.0;
  }

  template <class Depth>
  void measure() noexcept {
    std::array<std::array<int, kBins>, 2> jumps{};  // the last bin: all that is wider
    for (int v = kRowStep / 2; v < depth_.image.height; v += kRowStep) {
      const Depth* const row = depth_.image.row<Depth>(v);
      int last = -1;
      for (int u = 0; u < depth_.image.width; ++u) {
        if (!DepthView::is_depth(row[u])) continue;
        const double px = last >= 0 && may_jump(row[last], row[u])
                              ? px_per_metre(depth_.metres(row[last]), depth_.metres(row[u]))
                              : 0.0;
        if (px > kLeastPxPerMetre) {
          const auto bin = static_cast<std::size_t>((u - last - 1) / (kBin_m * px) + 0.5);
          ++jumps[row[last] > row[u] ? kFarOnLeft : kFarOnRight][std::min(bin, jumps[0].size() - 1)];
        }
        last = u;
      }
    }
    for (const Side side : {kFarOnLeft, kFarOnRight}) baseline_m_[side] = most_common_m(jumps[side]);
  }

  /// A smaller step is none for sure: most pixels need no division.
  template <class Depth>
  static bool may_jump(Depth a, Depth b) noexcept {
    return static_cast<float>(std::max(a, b)) > 1.05f * static_cast<float>(std::min(a, b));
  }

  /// The mean of the three adjacent bins that hold most.
  static double most_common_m(const std::array<int, kBins>& jumps) noexcept {
    int all = 0, most = 0;
    double bins = 0;
    for (const int count : jumps) all += count;
    for (std::size_t b = 1; b + 2 < jumps.size(); ++b) {  // not the last, which holds any that is wider
      const int below = b > 1 ? jumps[b - 1] : 0;         // the first bin: jumps without a hole
      const int count = below + jumps[b] + jumps[b + 1];
      if (count <= most) continue;
      most = count;
      bins = static_cast<double>(b) + static_cast<double>(jumps[b + 1] - below) / count;
    }
    return all >= kFewestJumps && most > kMostly * all ? kBin_m * bins : 0.0;
  }

  double farther_m(int u, int v) const noexcept {
    if (depth_.has_depth(u, v)) return 0.0;
    const double baseline_m = std::max(baseline_m_[kFarOnLeft], baseline_m_[kFarOnRight]);
    const int reach_px = static_cast<int>(kWidest * baseline_m * focal_px_ / kNearest_m + kWidest_px);
    const int leftmost = std::max(u - reach_px, 0), rightmost = std::min(u + reach_px, depth_.image.width - 1);
    int left = u, right = u;
    while (left >= leftmost && !depth_.has_depth(left, v)) --left;
    while (right <= rightmost && !depth_.has_depth(right, v)) ++right;
    if (left < leftmost || right > rightmost) return 0.0;
    const float left_m = depth_.metres(left, v), right_m = depth_.metres(right, v);
    const Side side = left_m > right_m ? kFarOnLeft : kFarOnRight;
    const double width_px = baseline_m_[side] * px_per_metre(left_m, right_m);
    const int from_far_px = side == kFarOnLeft ? u - left : right - u, hole_px = right - left - 1;
    const int from_near_px = hole_px + 1 - from_far_px;
    const bool is_shadow = width_px > 0 && hole_px <= kWidest * width_px + kWidest_px &&
                           from_far_px <= width_px + kEnd_px && from_near_px > kOccludersEdge_px;
    return is_shadow ? static_cast<double>(std::max(left_m, right_m)) : 0.0;
  }

  DepthView depth_;
  DepthScale to_depth_;
  double focal_px_;                     // of the depth image
  std::array<double, 2> baseline_m_{};  // by `Side`, 0 none
};

}  // namespace stillpoint
