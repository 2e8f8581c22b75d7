// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where was each feature in past frames?   Tracks from one frame to the next, chained.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// The track of each feature of the newest frame, one undistorted pixel per past frame, back to where it begins. Memory
/// is reused: no allocation once the fullest frame has been seen.
class TrackHistory {
 public:
  /// Past frames of `FrameHistory` in which feature i was seen without a gap: ages 1 to length(i). 0: it is new.
  std::size_t length(std::size_t i) const noexcept { return newest_.length[i]; }

  /// The undistorted pixel of feature i in `FrameHistory::back(age)`, 1 ≤ age ≤ length(i).
  const Vector2f& pixel(std::size_t i, std::size_t age) const noexcept {
    return newest_.tracks[i * capacity_ + age - 1];
  }

  /// Takes the matches of the next frame with the last one. A feature carries on the track of the last frame's feature
  /// that is nearest to its reference pixel; its track begins there where none lies within `same_point_px`, or where
  /// the depths are of two surfaces.
  /// @param history  of past frames, the last of which is the reference
  void push(const Matches& matches, const FrameHistory& history, float same_point_px, Workspace& workspace) {
    const std::size_t capacity = history.capacity(), skipped = history.skips_second_last() ? 1 : 0;
    const Workspace::Scope scope(workspace);
    if (capacity != capacity_) reset();
    capacity_ = capacity;
    const std::size_t count = matches.host_count;
    next_.resize(count, capacity);
    const PixelGrid last(newest_.pixels, kCell_px, workspace, [](std::size_t) { return true; });
    for (std::size_t i = 0; i < count; ++i) {
      next_.pixels[i] = matches.current.pixel[i];
      next_.undistorted[i] = to_float(matches.current.undistorted[i]);
      next_.depth_m[i] = matches.current.depth_m[i];
      next_.length[i] = 0;
      if (!matches.matched(i)) continue;
      Vector2f* const track = next_.tracks.data() + i * capacity;
      track[0] = to_float(matches.reference.undistorted[i]);
      next_.length[i] = 1;
      const std::size_t parent = nearest(last, matches.reference, i, same_point_px);
      if (parent == PixelGrid::kNone) continue;
      if (newest_.length[parent] < skipped) continue;
      const std::size_t inherited = std::min(newest_.length[parent] - skipped, capacity - 1);
      const Vector2f* const older = newest_.tracks.data() + parent * capacity + skipped;
      const Vector2f beside = track[0] - newest_.undistorted[parent];
      for (std::size_t k = 0; k < inherited; ++k) track[k + 1] = older[k] + beside;
      next_.length[i] += inherited;
    }
    std::swap(newest_, next_);
  }

  void reset() noexcept { newest_.resize(0, 0); }

 private:
  static constexpr float kCell_px = 8.0f;

  struct Tracks {
    std::vector<Vector2f> pixels;  ///< of the features in their own frame, in the image as it is
    std::vector<Vector2f> undistorted;
    std::vector<double> depth_m;
    std::vector<Vector2f> tracks;  ///< capacity entries per feature, the newest first
    std::vector<std::size_t> length;

    void resize(std::size_t count, std::size_t capacity) {
      pixels.resize(count);
      undistorted.resize(count);
      depth_m.resize(count);
      tracks.resize(count * capacity);
      length.resize(count);
    }
  };

  template <class View>
  std::size_t nearest(const PixelGrid& grid, const View& before, std::size_t i, float reach_px) const {
    constexpr float kSame_sq_px = 0.25f;  // nearer than half a pixel it is the same point, whatever its depth
    const double depth_m = before.depth_m[i], tolerance_m = DepthTolerance().at(before.depth_sigma_m[i]);
    return grid.nearest(before.pixel[i], reach_px, [&](std::size_t index, float squared) {
      const double theirs_m = newest_.depth_m[index];
      const bool of_one_kind = (depth_m > 0) == (theirs_m > 0);
      return !(squared > kSame_sq_px) || (of_one_kind && std::abs(depth_m - theirs_m) <= tolerance_m);
    });
  }

  Tracks newest_, next_;
  std::size_t capacity_ = 0;
};

}  // namespace stillpoint
