// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What lies in a hole of the depth image?   What the last frame measured there, if both images show the same.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/depth_shadow.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/depth/tile_motion.hpp"

namespace stillpoint {

/// Fills the holes that come and go from frame to frame, as those of active stereo do. A pixel without a depth takes
/// over the one that the last frame shows in the place of a static point, for a tenth of a second: moving objects are a
/// few pixels away by then, and mostly keep their own depth. Where the two images differ, something else has come.
/// Depth at an edge is not handed on, and shadows of the sensor stay holes: DepthShadow knows what lies there. Where
/// only a few pixels around one have lost their depth, as they always do at edges, nothing is filled.
/// docs/design/sweeps.md, "Holes that flicker".
class TemporalHoleFilling {
 public:
  bool is_enabled = true;  ///< false: holes stay holes; no option in files

  /// @param reference  the last frame, its holes filled
  /// @param current_from_reference  roughly
  /// @param noise  of the depth sensor, `double sigma(double depth_m)`
  /// @return  the current depth image, its holes filled; valid until the next call. One whose size or format is not
  ///          the last one's comes back as it is. A frame without a depth image, as every other one of a camera whose
  ///          colour is faster, has nothing but holes. O(pixels).
  template <class Camera, class Noise>
  DepthView fill(const FrameView& reference, const FrameView& as_it_came, const Pose& current_from_reference,
                 const Camera& camera, const Noise& noise) {
    const ImageView& before = reference.depth.image;
    const bool was_filled = std::exchange(filled_at_s_, kNever_s) == reference.timestamp_s;
    const double frames = (kLongest_s + kStampNoise_s) / (as_it_came.timestamp_s - reference.timestamp_s);
    if (!is_enabled || before.empty() || !(frames >= 1.0)) return as_it_came.depth;
    holes_.resize(before.width, before.height, before.format);  // nothing is ever written there: 0 is no depth
    FrameView current = as_it_came;
    if (current.depth.empty()) current.depth = DepthView(holes_.view(), reference.depth.factor);
    const ImageView& depth = current.depth.image;
    if (before.width != depth.width || before.height != depth.height || before.format != depth.format)
      return as_it_came.depth;
    filled_.resize(depth.width, depth.height, depth.format);  // all memory at once, not in the first frame with holes
    for (ImageBuffer* const age : {&age_, &age_before_}) age->resize(depth.width, depth.height, PixelFormat::gray8);
    if (!was_filled) clear(age_);
    most_age_ = static_cast<int>(std::min(frames, 255.0));
    if (depth.format == PixelFormat::depth16)
      find_tiles<std::uint16_t>(depth, before);
    else
      find_tiles<float>(depth, before);
    return tiles_.empty() ? current.depth : fill_tiles(reference, current, current_from_reference, camera, noise);
  }

  void reset() noexcept { filled_at_s_ = kNever_s; }

 private:
  static constexpr double kNever_s = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kLongest_s = 0.1;       // since a depth was measured …
  static constexpr double kStampNoise_s = 0.005;  // … by time stamps that jitter
  static constexpr int kFewestLost = 96;          // pixels of a tile of 256: at edges depth always comes and goes
  static constexpr float kSamePixel_px = 1.0f;    // the depth that is found is that of a point seen so near
  static constexpr int kReach_px = 2;             // the gray values around a pixel, so far to each side …
  static constexpr int kMostDifference = 18;      // … differ by no more on average

  static void clear(ImageBuffer& age) {
    const ImageView view = age.view();
    std::fill_n(age.row<std::uint8_t>(0), view.width * view.height, std::uint8_t{0});
  }

  struct Tile {
    int left, top;
  };

  template <class Depth>
  static bool is_lost(Depth now, Depth before) noexcept {
    return (static_cast<int>(!DepthView::is_depth(now)) & static_cast<int>(DepthView::is_depth(before))) != 0;
  }

  /// Those that lost depth; what is left of a tile at the right and lower border is not looked at. Counted by column
  /// first: that becomes vector instructions.
  template <class Depth>
  void find_tiles(const ImageView& depth, const ImageView& before) {
    constexpr int kSide = TileMotion::kSide_px;
    const auto width = static_cast<std::size_t>(depth.width);
    tiles_.clear();
    tiles_.reserve(width / kSide * static_cast<std::size_t>(depth.height / kSide));
    for (int top = 0; top + kSide <= depth.height; top += kSide) {
      lost_.assign(width, 0);
      for (int v = top; v < top + kSide; ++v) {
        const Depth *const now = depth.row<Depth>(v), *const then = before.row<Depth>(v);
        std::uint16_t* const lost = lost_.data();
        for (std::size_t u = 0; u < width; ++u)
          lost[u] = static_cast<std::uint16_t>(lost[u] + static_cast<int>(is_lost(now[u], then[u])));
      }
      for (int left = 0; left + kSide <= depth.width; left += kSide) {
        const auto first = lost_.begin() + left;
        if (std::accumulate(first, first + kSide, 0) >= kFewestLost) tiles_.push_back({left, top});
      }
    }
  }

  template <class Camera, class Noise>
  DepthView fill_tiles(const FrameView& reference, const FrameView& current, const Pose& current_from_reference,
                       const Camera& camera, const Noise& noise) {
    const ImageView& depth = current.depth.image;
    std::swap(age_, age_before_);
    clear(age_);
    filled_.assign(depth);
    filled_at_s_ = current.timestamp_s;
    const DepthScale to_depth(current.gray, depth);
    const DepthShadow shadow(current, camera);
    for (const Tile& tile : tiles_) {
      const TileMotion motion(depth, tile.left, tile.top, to_depth, current_from_reference, camera);
      for (int v = tile.top; v < tile.top + TileMotion::kSide_px; ++v)
        for (int u = tile.left; u < tile.left + TileMotion::kSide_px; ++u)
          if (!current.depth.has_depth(u, v) && reference.depth.has_depth(u, v))
            fill_pixel(u, v, motion, to_depth, shadow, reference, current, noise);
    }
    return DepthView(filled_.view(), current.depth.factor);
  }

  template <class Noise>
  void fill_pixel(int u, int v, const TileMotion& motion, const DepthScale& to_depth, const DepthShadow& shadow,
                  const FrameView& reference, const FrameView& current, const Noise& noise) {
    // What a static scene shows here was in the last frame where what was here then came from.
    const Vector2f here(static_cast<float>(u), static_cast<float>(v));
    const TileMotion::Place step = motion(here.x(), here.y(), reference.depth.metres(u, v));
    const Vector2f before = 2.0f * here - Vector2f(step.u, step.v);
    if (!(GuardedDepth().at(reference.depth, before, noise) > 0.0)) return;
    const int before_u = rounded(before.x()), before_v = rounded(before.y());
    const int age = age_before_.row<std::uint8_t>(before_v)[before_u];
    if (age >= most_age_) return;
    const TileMotion::Place there = motion(before.x(), before.y(), depth_between_m(reference.depth, before));
    const Vector2f off = Vector2f(there.u, there.v) - here;
    if (!(std::max(std::abs(off.x()), std::abs(off.y())) <= kSamePixel_px)) return;
    const Vector2f pixel = to_depth.inverse(here);
    if (shadow.farther_m(pixel) > 0.0 || !are_alike(reference.gray, to_depth.inverse(before), current.gray, pixel))
      return;
    set_depth(u, v, there.depth_m, current.depth.factor);
    age_.row<std::uint8_t>(v)[u] = static_cast<std::uint8_t>(age + 1);
  }

  /// Of one surface, between its pixels: on a floor a half of one is centimetres.
  static float depth_between_m(const DepthView& depth, const Vector2f& at) noexcept {
    const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
    const float above[] = {depth.metres(u, v), depth.metres(u + 1, v)};
    const float below[] = {depth.metres(u, v + 1), depth.metres(u + 1, v + 1)};
    if (!(std::min(std::min(above[0], above[1]), std::min(below[0], below[1])) > 0.0f))
      return depth.metres(rounded(at.x()), rounded(at.y()));
    const float x = at.x() - static_cast<float>(u), y = at.y() - static_cast<float>(v);
    const float above_m = (1.0f - x) * above[0] + x * above[1];
    const float below_m = (1.0f - x) * below[0] + x * below[1];
    return (1.0f - y) * above_m + y * below_m;
  }

  static bool are_alike(const ImageView& a, const Vector2f& at_a, const ImageView& b, const Vector2f& at_b) noexcept {
    constexpr float kInside_px = kReach_px + 0.5f;  // rounding may go outwards
    if (!(a.border_distance_px(at_a.x(), at_a.y()) >= kInside_px)) return false;
    if (!(b.border_distance_px(at_b.x(), at_b.y()) >= kInside_px)) return false;
    const int left_a = rounded(at_a.x()) - kReach_px, left_b = rounded(at_b.x()) - kReach_px;
    constexpr int kSide = 2 * kReach_px + 1;
    int sum = 0;
    for (int j = -kReach_px; j <= kReach_px; ++j) {
      const std::uint8_t* const row_a = a.row<std::uint8_t>(rounded(at_a.y()) + j) + left_a;
      const std::uint8_t* const row_b = b.row<std::uint8_t>(rounded(at_b.y()) + j) + left_b;
      for (int i = 0; i < kSide; ++i) sum += std::abs(int{row_a[i]} - int{row_b[i]});
    }
    return sum <= kMostDifference * kSide * kSide;
  }

  void set_depth(int u, int v, float depth_m, double factor) noexcept {
    if (filled_.view().format == PixelFormat::depth32f)
      filled_.row<float>(v)[u] = depth_m;
    else
      filled_.row<std::uint16_t>(v)[u] =
          static_cast<std::uint16_t>(std::clamp(static_cast<double>(depth_m) * factor + 0.5, 1.0, 65535.0));
  }

  std::vector<std::uint16_t> lost_;  // by column of a row of tiles
  std::vector<Tile> tiles_;
  ImageBuffer filled_, holes_;
  ImageBuffer age_, age_before_;   // frames since a pixel's depth was measured, by pixel; 0: now
  double filled_at_s_ = kNever_s;  // the frame of `age_`
  int most_age_ = 0;
};

}  // namespace stillpoint
