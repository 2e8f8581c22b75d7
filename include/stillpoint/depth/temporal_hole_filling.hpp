// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What lies in a hole of the depth image?   What the last frame measured there, if both images show the same.
// "There" is where a static point was, or where the corners around came from.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/depth_shadow.hpp"
#include "stillpoint/depth/filled_depth.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/depth/tile_motion.hpp"

namespace stillpoint {

/// Fills the holes that come and go from frame to frame, as those of active stereo do. A pixel without a depth takes
/// over the one that the last frame shows in the place of a static point, for a tenth of a second. Where the two images
/// differ, something else has come: moving objects are a few pixels away by then, and features on them take their depth
/// along once it is known how they moved. Depth at an edge is not handed on, and a static shadow of the sensor stays a
/// hole: DepthShadow knows what lies there. Where only a few pixels around one have lost their depth, as they always do
/// at edges, nothing is filled. docs/design/sweeps.md, "Holes that flicker".
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
    filled_.reserve_like(depth);
    if (!was_filled) filled_.forget_ages();
    most_age_ = static_cast<int>(std::min(frames, 255.0));
    const bool is_anything_lost = depth.format == PixelFormat::depth16 ? find_lost_tiles<std::uint16_t>(depth, before)
                                                                       : find_lost_tiles<float>(depth, before);
    return is_anything_lost ? fill_tiles(reference, current, current_from_reference, camera, noise) : current.depth;
  }

  /// After the matches, and after `fill`: a feature in a hole moved as that corner around it along whose flow both
  /// images are most alike, and takes its depth along, with the pixels around it.
  /// @param reference  the last frame, its holes filled
  /// @param current    its depth image is what `fill` returned
  /// @param matches    where corners were in the reference frame
  /// @return  that depth image, its holes filled; valid until the next call. O(features · corners around one).
  template <class Noise>
  DepthView fill_along_flow(const FrameView& reference, const FrameView& current, const Matches& matches,
                            const Noise& noise, Workspace& workspace) {
    if (!(filled_at_s_ == current.timestamp_s)) return current.depth;
    const Workspace::Scope scope(workspace);
    const span<const Vector2f> pixel = matches.current.pixel;
    const auto is_corner = [&](std::size_t i) { return i >= matches.first_flow() && matches.matched(i); };
    const PixelGrid corners(pixel, matches.pixel_scale * kFlowReach_px, workspace, is_corner);
    const DepthScale to_depth(current.gray, current.depth.image);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches.state[i] == MatchState::outside) continue;
      const Vector2f here = to_depth(pixel[i]);
      if (!is_in_lost_tile(here) || GuardedDepth().at(current.depth, here, noise) > 0.0) continue;
      const std::optional<Vector2f> before = place_along_flow(i, corners, matches, reference.gray, current.gray);
      if (!before || !(GuardedDepth().at(reference.depth, to_depth(*before), noise) > 0.0)) continue;
      const int reach = rounded(matches.pixel_scale * kFlowBlock_px * to_depth.x);
      fill_block(here, to_depth(*before), reach, to_depth, reference, current);
    }
    return current.depth;
  }

  void reset() noexcept { filled_at_s_ = kNever_s; }

 private:
  static constexpr double kNever_s = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kLongest_s = 0.1;       // since a depth was measured …
  static constexpr double kStampNoise_s = 0.005;  // … by time stamps that jitter
  static constexpr int kFewestLost = 96;          // pixels of a tile of 256: at edges depth always comes and goes
  static constexpr float kSamePixel_px = 1.0f;    // the depth that is found is that of a point seen so near
  static constexpr int kReach_px = 2;             // the gray values around a pixel, so far to each side …
  static constexpr int kCompared = (2 * kReach_px + 1) * (2 * kReach_px + 1);
  static constexpr int kMostDifference = 18;     // … differ by no more on average
  static constexpr float kFlowReach_px = 48.0f;  // how far away a corner may be whose flow a feature follows: two cells
  static constexpr float kFlowBlock_px = 12.0f;  // how far around a feature its flow fills: half a cell

  std::size_t tiles_in_row() const noexcept {
    return static_cast<std::size_t>(filled_.view().width / TileMotion::kSide_px);
  }

  bool is_lost_tile(int column, int row) const noexcept {
    const std::size_t tile = static_cast<std::size_t>(row) * tiles_in_row() + static_cast<std::size_t>(column);
    return static_cast<std::size_t>(column) < tiles_in_row() && tile < is_lost_tile_.size() && is_lost_tile_[tile] != 0;
  }

  /// @param pixel  in the depth image
  bool is_in_lost_tile(const Vector2f& pixel) const noexcept {
    return is_lost_tile(rounded(pixel.x()) / TileMotion::kSide_px, rounded(pixel.y()) / TileMotion::kSide_px);
  }

  template <class Depth>
  static bool is_lost(Depth now, Depth before) noexcept {
    return (static_cast<int>(!DepthView::is_depth(now)) & static_cast<int>(DepthView::is_depth(before))) != 0;
  }

  /// Those that lost depth; what is left of a tile at the right and lower border is not looked at. Counted by column
  /// first: that becomes vector instructions.
  /// @return  are there any?
  template <class Depth>
  bool find_lost_tiles(const ImageView& depth, const ImageView& before) {
    constexpr int kSide = TileMotion::kSide_px;
    const auto width = static_cast<std::size_t>(depth.width);
    is_lost_tile_.assign(tiles_in_row() * static_cast<std::size_t>(depth.height / kSide), 0);
    bool is_any_lost = false;
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
        if (std::accumulate(first, first + kSide, 0) < kFewestLost) continue;
        is_any_lost = true;
        is_lost_tile_[static_cast<std::size_t>(top / kSide) * tiles_in_row() + static_cast<std::size_t>(left / kSide)] =
            1;
      }
    }
    return is_any_lost;
  }

  template <class Camera, class Noise>
  DepthView fill_tiles(const FrameView& reference, const FrameView& current, const Pose& current_from_reference,
                       const Camera& camera, const Noise& noise) {
    const ImageView& depth = current.depth.image;
    filled_.assign(depth);
    filled_at_s_ = current.timestamp_s;
    const DepthScale to_depth(current.gray, depth);
    const DepthShadow shadow(current, camera);
    constexpr int kSide = TileMotion::kSide_px;
    for (int top = 0; top + kSide <= depth.height; top += kSide)
      for (int left = 0; left + kSide <= depth.width; left += kSide) {
        if (!is_lost_tile(left / kSide, top / kSide)) continue;
        const TileMotion motion(depth, left, top, to_depth, current_from_reference, camera);
        for (int v = top; v < top + kSide; ++v)
          for (int u = left; u < left + kSide; ++u)
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
    const int age = filled_.age_before(before_u, before_v);
    if (age >= most_age_) return;
    const TileMotion::Place there = motion(before.x(), before.y(), depth_between_m(reference.depth, before));
    const Vector2f off = Vector2f(there.u, there.v) - here;
    if (!(std::max(std::abs(off.x()), std::abs(off.y())) <= kSamePixel_px)) return;
    const Vector2f pixel = to_depth.inverse(here);
    if (shadow.farther_m(pixel) > 0.0) return;
    if (difference_of(reference.gray, to_depth.inverse(before), current.gray, pixel) > kMostDifference * kCompared)
      return;
    filled_.set(u, v, there.depth_m, current.depth.factor, age + 1);
  }

  /// Where a feature was in the reference image, if it moved as one of the corners around it: as that along whose flow
  /// the images are most alike. None where nothing there is alike.
  static std::optional<Vector2f> place_along_flow(std::size_t feature, const PixelGrid& corners, const Matches& matches,
                                                  const ImageView& reference, const ImageView& current) {
    const Vector2f pixel = matches.current.pixel[feature];
    std::optional<Vector2f> place;
    int least = kMostDifference * kCompared + 1;
    corners.within(pixel, matches.pixel_scale * kFlowReach_px, [&](std::size_t corner, float) {
      const Vector2f along = pixel + matches.reference.pixel[corner] - matches.current.pixel[corner];
      const int difference = difference_of(reference, along, current, pixel);
      if (difference >= least) return;
      least = difference;
      place = along;
    });
    return place;
  }

  /// The holes around `here` take over what lies around `there`, pixel by pixel where the gray values are alike.
  void fill_block(const Vector2f& here, const Vector2f& there, int reach, const DepthScale& to_depth,
                  const FrameView& reference, const FrameView& current) {
    const int u0 = rounded(here.x()), v0 = rounded(here.y());
    const int before_u = rounded(there.x()) - u0, before_v = rounded(there.y()) - v0;
    const ImageView depth = filled_.view();
    const int top = std::max(v0 - reach, std::max(0, -before_v));
    const int bottom = std::min(v0 + reach + 1, depth.height - std::max(0, before_v));
    const int left = std::max(u0 - reach, std::max(0, -before_u));
    const int right = std::min(u0 + reach + 1, depth.width - std::max(0, before_u));
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u) {
        if (current.depth.has_depth(u, v) || !reference.depth.has_depth(u + before_u, v + before_v)) continue;
        const int age = filled_.age_before(u + before_u, v + before_v);
        if (age >= most_age_ || !is_alike_at(u, v, before_u, before_v, to_depth, reference.gray, current.gray))
          continue;
        filled_.set(u, v, reference.depth.metres(u + before_u, v + before_v), current.depth.factor, age + 1);
      }
  }

  static bool is_alike_at(int u, int v, int before_u, int before_v, const DepthScale& to_depth,
                          const ImageView& reference, const ImageView& current) noexcept {
    const auto gray = [&](const ImageView& image, int x, int y) {
      const Vector2f pixel = to_depth.inverse(Vector2f(static_cast<float>(x), static_cast<float>(y)));
      const int column = std::clamp(rounded(pixel.x()), 0, image.width - 1);
      return int{image.row<std::uint8_t>(std::clamp(rounded(pixel.y()), 0, image.height - 1))[column]};
    };
    return std::abs(gray(current, u, v) - gray(reference, u + before_u, v + before_v)) <= kMostDifference;
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

  /// Sum of the absolute differences of `kCompared` gray values; more than any where some are outside an image.
  static int difference_of(const ImageView& a, const Vector2f& at_a, const ImageView& b,
                           const Vector2f& at_b) noexcept {
    constexpr float kInside_px = kReach_px + 0.5f;  // rounding may go outwards
    constexpr int kOutside = std::numeric_limits<int>::max();
    if (!(a.border_distance_px(at_a.x(), at_a.y()) >= kInside_px)) return kOutside;
    if (!(b.border_distance_px(at_b.x(), at_b.y()) >= kInside_px)) return kOutside;
    const int left_a = rounded(at_a.x()) - kReach_px, left_b = rounded(at_b.x()) - kReach_px;
    int sum = 0;
    for (int j = -kReach_px; j <= kReach_px; ++j) {
      const std::uint8_t* const row_a = a.row<std::uint8_t>(rounded(at_a.y()) + j) + left_a;
      const std::uint8_t* const row_b = b.row<std::uint8_t>(rounded(at_b.y()) + j) + left_b;
      for (int i = 0; i <= 2 * kReach_px; ++i) sum += std::abs(int{row_a[i]} - int{row_b[i]});
    }
    return sum;
  }

  std::vector<std::uint16_t> lost_;         // by column of a row of tiles
  std::vector<std::uint8_t> is_lost_tile_;  // of all tiles of the image, row by row
  FilledDepth filled_;
  ImageBuffer holes_;              // of a frame without a depth image
  double filled_at_s_ = kNever_s;  // the frame of `filled_`
  int most_age_ = 0;
};

}  // namespace stillpoint
