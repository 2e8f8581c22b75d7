// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Depth of another time, of static and moving objects: each surface is where its corners have carried it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_scale.hpp"

namespace stillpoint {

/// Takes depth along with the corners around it, those of the camera's motion and those that move by themselves. Each
/// pixel asks the nearest corners: where did you take this pixel from, and was your surface there, as deep as you? The
/// nearest surface that answers yes hides the others. Where none does, and the depth there is that of a surface that
/// its corner took away, what lies behind has come to light: it is as deep as the next corner that is farther. Without
/// corners depth stays as it is. Keeps its buffer. docs/design/sweeps.md, "Depth of another time".
class CarriedDepth {
 public:
  /// @param as_it_came  its depth is older by `delay`, in times since the reference frame
  /// @param undone      that depth, moved as if all were static
  /// @param current     the depth image to mend: `undone`, some of its holes filled
  /// @param matches     where corners were in the reference frame
  /// @return  float metres; valid until the next call. O(pixels).
  DepthView operator()(const FrameView& as_it_came, const DepthView& undone, const DepthView& current, double delay,
                       const Matches& matches, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const DepthScale to_depth(as_it_came.gray, current.image);
    const span<const Corner> corners = find_corners(as_it_came, delay, to_depth, matches, workspace);
    const span<Vector2f> pixels = workspace.take<Vector2f>(corners.size(), Vector2f::Zero());
    for (std::size_t c = 0; c < corners.size(); ++c) pixels[c] = corners[c].pixel;
    const float reach_px = matches.pixel_scale * kReach_px;
    const PixelGrid grid(pixels, reach_px, workspace, [](std::size_t) { return true; });
    copy(as_it_came.depth, source_m_);
    copy(current, depth_m_);
    for (int top = 0; top < current.image.height; top += kCell_px)
      for (int left = 0; left < current.image.width; left += kCell_px) {
        const float half = 0.5f * static_cast<float>(kCell_px);
        const Vector2f middle(static_cast<float>(left) + half, static_cast<float>(top) + half);
        mend(left, top, Around(to_depth.inverse(middle), reach_px, grid, corners), undone);
      }
    return DepthView(depth_m_.view());
  }

 private:
  static constexpr int kCell_px = 8;         // of the depth image: its pixels ask the same corners …
  static constexpr std::size_t kAsked = 6;   // … so many …
  static constexpr float kReach_px = 48.0f;  // … so near
  static constexpr float kNothing_m = std::numeric_limits<float>::infinity();
  static constexpr float kSameSurface_m = 0.15f;  // as in older frames, where a nearer surface hides another

  struct Corner {
    Vector2f pixel = Vector2f::Zero();     // now
    int to_source_u = 0, to_source_v = 0;  // from a pixel of the depth image to where it was when depth was measured
    float depth_m = 0.0f;
  };

  /// The corners nearest to a cell, the nearest first.
  class Around {
   public:
    Around(const Vector2f& middle, float reach_px, const PixelGrid& grid, span<const Corner> corners) {
      grid.within(middle, reach_px, [&](std::size_t c, float squared) { insert({squared, &corners[c]}); });
    }
    const Corner* const* begin() const noexcept { return corner_.data(); }
    const Corner* const* end() const noexcept { return corner_.data() + count_; }

   private:
    void insert(std::pair<float, const Corner*> found) noexcept {
      std::size_t place = count_;
      while (place > 0 && squared_[place - 1] > found.first) --place;
      if (place == kAsked) return;
      count_ = std::min(count_ + 1, kAsked);
      for (std::size_t i = count_ - 1; i > place; --i) {
        squared_[i] = squared_[i - 1];
        corner_[i] = corner_[i - 1];
      }
      squared_[place] = found.first;
      corner_[place] = found.second;
    }

    std::array<float, kAsked> squared_{};
    std::array<const Corner*, kAsked> corner_{};
    std::size_t count_ = 0;
  };

  static span<const Corner> find_corners(const FrameView& as_it_came, double delay, const DepthScale& to_depth,
                                         const Matches& matches, Workspace& workspace) {
    const span<Corner> corners = workspace.take<Corner>(matches.size());
    const ImageView& image = as_it_came.depth.image;
    std::size_t count = 0;
    for (std::size_t i = matches.first_flow(); i < matches.size(); ++i) {
      if (!matches.matched(i)) continue;
      const Vector2f here = matches.current.pixel[i];
      const Vector2f to_source = static_cast<float>(delay) * (matches.reference.pixel[i] - here);
      const Vector2f source = to_depth(here + to_source);
      if (!(image.border_distance_px(source.x(), source.y()) >= 0.0f)) continue;
      const float depth_m = as_it_came.depth.metres(rounded(source.x()), rounded(source.y()));
      if (depth_m > 0.0f)
        corners[count++] = {here, rounded(to_source.x() * to_depth.x), rounded(to_source.y() * to_depth.y), depth_m};
    }
    return corners.first(count);
  }

  static void copy(const DepthView& depth, ImageBuffer& metres) {
    metres.resize(depth.image.width, depth.image.height, PixelFormat::depth32f);
    for (int v = 0; v < depth.image.height; ++v) {
      float* const row = metres.row<float>(v);
      for (int u = 0; u < depth.image.width; ++u) row[u] = depth.metres(u, v);
    }
  }

  void mend(int left, int top, const Around& around, const DepthView& undone) {
    const ImageView image = depth_m_.view();
    const int columns = std::min(kCell_px, image.width - left);
    for (int v = top; v < std::min(top + kCell_px, image.height); ++v) {
      const Row carried_m = carried_to(left, v, around);
      float* const row = depth_m_.row<float>(v) + left;
      for (int i = 0; i < columns; ++i) {
        const float undone_m = undone.metres(left + i, v);
        if (carried_m[static_cast<std::size_t>(i)] < kNothing_m)
          row[i] = carried_m[static_cast<std::size_t>(i)];
        else if (is_as_deep(undone_m, around))
          row[i] = behind(undone_m, around);
      }
    }
  }

  static bool is_same(float a_m, float b_m) noexcept { return std::abs(a_m - b_m) <= kSameSurface_m; }

  using Row = std::array<float, kCell_px>;

  /// The nearest surface that a corner has carried to each pixel of a cell's row. Eight pixels at once, without
  /// branches.
  Row carried_to(int left, int v, const Around& around) const noexcept {
    Row nearest_m;
    nearest_m.fill(kNothing_m);
    const ImageView source = source_m_.view();
    for (const Corner* const corner : around) {
      const int from_u = left + corner->to_source_u, from_v = v + corner->to_source_v;
      if (from_v < 0 || from_v >= source.height) continue;
      const float* const from = source.row<float>(from_v);
      const int last = std::min(kCell_px, source.width - from_u);
      for (int i = std::max(0, -from_u); i < last; ++i) {
        const float depth_m = from[from_u + i];
        float& so_far_m = nearest_m[static_cast<std::size_t>(i)];
        const bool is_nearest =
            (static_cast<int>(depth_m > 0.0f) & static_cast<int>(is_same(depth_m, corner->depth_m)) &
             static_cast<int>(depth_m < so_far_m - kSameSurface_m)) != 0;
        so_far_m = is_nearest ? depth_m : so_far_m;
      }
    }
    return nearest_m;
  }

  /// Is it the depth of a corner?
  static bool is_as_deep(float depth_m, const Around& around) noexcept {
    return depth_m > 0.0f && std::any_of(around.begin(), around.end(),
                                         [&](const Corner* corner) { return is_same(depth_m, corner->depth_m); });
  }

  /// 0 where no corner is farther.
  static float behind(float depth_m, const Around& around) noexcept {
    for (const Corner* const corner : around)
      if (corner->depth_m > depth_m + kSameSurface_m) return corner->depth_m;
    return 0.0f;
  }

  ImageBuffer source_m_, depth_m_;
};

}  // namespace stillpoint
