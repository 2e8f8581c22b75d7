// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Is the depth image as old as the image?   If it is older, its edges lie where those of the image were before.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/depth/depth_jumps.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/moved_depth.hpp"

namespace stillpoint {

/// Measures how late depth is, in intervals between frames, and undoes it. Each of nine delays moves the edges of the
/// depth image along with the camera's motion; at the right delay they lie on edges of the gray image. A constant shift
/// between the two images is left free, so that poor registration is no delay. At a constant velocity in the image a
/// delay looks like a shift, and none is found. Edges beside dynamic features are left out, as these move by
/// themselves; `undo` moves them as if they were static. docs/design/sweeps.md, "Depth of another time".
class DepthDelay {
 public:
  bool is_enabled = true;  ///< false: depth is used as it comes; no option in files

  /// The depth image at the image's time: the frame's own, unless it is known to be of another time.
  /// @param current_from_reference  roughly, from the last frame to this one
  /// @return  valid until the next call
  template <class Camera>
  DepthView undo(const FrameView& frame, const Pose& current_from_reference, const Camera& camera) {
    if (!is_enabled || frames_ == 0.0 || frame.depth.empty()) return frame.depth;
    return moved_(frame, scaled(current_from_reference, frames_), camera);
  }

  /// Measures at every second frame.
  /// @param frame     as it came
  /// @param features  its features …
  /// @param labels    … and which of them are kept
  /// @param motion    from the last frame to this one
  template <class Camera>
  void observe(const FrameView& frame, const FrameFeatures& features, span<const Label> labels, const Motion& motion,
               const Camera& camera) {
    if (!is_enabled) return reset();  // what was found is of a sensor that nobody watches any more
    if (!motion.metric || frame.depth.empty() || frame_++ % kLookEvery != 0) return;
    find_dynamic(features, labels);
    find_jumps(frame, motion.current_from_reference, camera);
    if (jumps_.size() < kFewestJumps || !camera_moves(frame.gray.width)) return;
    add_fits(frame.gray);
    decide();
  }

  /// By how many intervals between frames depth is older than its image; below 0, newer. 0: less than half an interval,
  /// or not known, or not enabled.
  double frames() const noexcept { return is_enabled ? frames_ : 0.0; }

  void reset() noexcept {
    frames_ = 0.0;
    frame_ = 0;
    jumps_seen_ = 0.0f;
    for (auto& of_delay : step_) std::fill(std::begin(of_delay), std::end(of_delay), 0.0f);
  }

 private:
  static constexpr std::size_t kLookEvery = 2;        // frame
  static constexpr int kRows = 30;                    // of the depth image
  static constexpr std::size_t kFewestJumps = 20;     // in a frame
  static constexpr std::size_t kMostJumps = 400;      // more are thinned out
  static constexpr int kDelays = 9;                   // from one frame too new to one too old …
  static constexpr double kDelayStep = 0.25;          // … of frames
  static constexpr int kNoDelay = kDelays / 2;        // the one in the middle
  static constexpr int kShifts_x = 9, kShifts_y = 7;  // 8 px and 6 px to each side, where the image has 640 columns
  static constexpr float kFading = 0.98f;             // of what was seen, with each look
  static constexpr float kClearly = 0.15f;            // a delay is better than none by this share …
  static constexpr float kDeviations = 3.5f;          // … and by this over the square root of the number of jumps …
  static constexpr float kStill = 0.03f;              // … and what was found holds while it is better by this
  static constexpr double kLeastDelay = 0.5;          // less is left as it is …
  static constexpr double kLeastHeld = 0.25;          // … unless more was found before
  static constexpr float kReachShare = 0.1f;          // of the width: so near to a dynamic feature …
  static constexpr double kSameObject_m = 0.3;        // … and about as deep, a jump is that object's

  using Fits = float[kDelays][kShifts_x * kShifts_y];

  struct DynamicFeature {
    Vector2f pixel;
    double depth_m;
  };
  struct Jump {
    Vector2f pixel;  ///< of the gray image
    Vector2f flow;   ///< of the camera's motion since the last frame, pixels
  };

  void find_dynamic(const FrameFeatures& features, span<const Label> labels) {
    dynamic_.clear();
    dynamic_.reserve(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (!labels[i].keep && is_finite(features.pixel[i])) dynamic_.push_back({features.pixel[i], features.depth_m[i]});
  }

  bool is_dynamic(const Vector2f& pixel, double depth_m, float reach_px) const {
    return std::any_of(dynamic_.begin(), dynamic_.end(), [&](const DynamicFeature& feature) {
      return (feature.pixel - pixel).squaredNorm() < reach_px * reach_px &&
             !(feature.depth_m > 0.0 && std::abs(feature.depth_m - depth_m) > kSameObject_m);
    });
  }

  template <class Camera>
  void find_jumps(const FrameView& frame, const Pose& current_from_reference, const Camera& camera) {
    jumps_.clear();
    jumps_.reserve(static_cast<std::size_t>(2 * kRows * frame.depth.image.width / kDepthJumpReach_px));
    const DepthScale to_depth(frame.gray, frame.depth.image);
    const float reach_px = kReachShare * static_cast<float>(frame.gray.width);
    for_each_depth_jump(frame.depth, kRows, [&](int u, int v, float nearer_m) {
      const Vector2f pixel = to_depth.inverse({depth_jump_at(frame.depth, u, v), static_cast<float>(v)});
      if (is_dynamic(pixel, static_cast<double>(nearer_m), reach_px)) return;
      const Vector3d before = point_at_depth(camera, pixel, static_cast<double>(nearer_m));
      const Vector3d after = current_from_reference * before;
      if (!(after.z() > 0.1 * before.z())) return;
      // Both by the lens: beyond its range `undistort` has no inverse.
      const Vector2d flow = camera.distort(camera.project(after)) - camera.distort(camera.project(before));
      jumps_.push_back({pixel, to_float(flow)});
    });
  }

  /// Far enough for a delay to be seen: by 2 pixels in a mean jump, where the image has 640 columns.
  bool camera_moves(int width) const noexcept {
    float sum_px = 0.0f;
    for (const Jump& jump : jumps_) sum_px += jump.flow.norm();
    return sum_px * 320.0f > static_cast<float>(jumps_.size()) * static_cast<float>(width);
  }

  /// Adds the mean gray step at the moved jumps, over that of all delays and shifts.
  void add_fits(const ImageView& gray) {
    const int step_px = std::max(gray.width / 320, 1);
    const std::size_t thinned = 1 + jumps_.size() / kMostJumps;
    Fits seen;
    float sum = 0.0f;
    for (int d = 0; d < kDelays; ++d)
      for (int s = 0; s < kShifts_x * kShifts_y; ++s) {
        const int right_px = step_px * (s % kShifts_x - kShifts_x / 2);
        const int down_px = step_px * (s / kShifts_x - kShifts_y / 2);
        int steps = 0;
        for (std::size_t i = 0; i < jumps_.size(); i += thinned) {
          const Jump& jump = jumps_[i];
          const Vector2f at = jump.pixel + static_cast<float>(delay(d)) * jump.flow;
          if (gray.border_distance_px(at.x(), at.y()) >= 0.0f)
            steps += gray_step(gray, rounded(at.x()) + right_px, rounded(at.y()) + down_px, step_px);
        }
        seen[d][s] = static_cast<float>(steps);
        sum += seen[d][s];
      }
    if (!(sum > 0.0f)) return;
    const auto count = static_cast<float>(jumps_.size());
    jumps_seen_ = kFading * jumps_seen_ + count;
    for (int d = 0; d < kDelays; ++d)
      for (int s = 0; s < kShifts_x * kShifts_y; ++s)
        step_[d][s] = kFading * step_[d][s] + seen[d][s] * (count * kDelays * kShifts_x * kShifts_y) / sum;
  }

  void decide() noexcept {
    const auto fit = [&](int d) { return *std::max_element(std::begin(step_[d]), std::end(step_[d])); };
    int best = kNoDelay;
    for (int d = 0; d < kDelays; ++d)
      if (fit(d) > fit(best)) best = d;
    const float gain = fit(best) / fit(kNoDelay) - 1.0f;
    const bool is_clear =
        frames_ != 0.0 ? gain > kStill : gain > kClearly && gain * std::sqrt(jumps_seen_) > kDeviations;
    // Best on the border alone: the images are shifted by more than is searched, and a delay makes up for a part of it.
    const bool is_inside = fit_inside(best) >= fit(best);
    const double least = frames_ != 0.0 ? kLeastHeld : kLeastDelay;
    frames_ = is_clear && is_inside && std::abs(delay(best)) >= least ? delay(best) : 0.0;
  }

  /// The greatest of all shifts but the farthest.
  float fit_inside(int d) const noexcept {
    float greatest = 0.0f;
    for (int y = 1; y + 1 < kShifts_y; ++y)
      for (int x = 1; x + 1 < kShifts_x; ++x) greatest = std::max(greatest, step_[d][y * kShifts_x + x]);
    return greatest;
  }

  static double delay(int d) noexcept { return kDelayStep * (d - kNoDelay); }

  Fits step_{};  // gray steps by delay and shift, over their mean, by jumps
  std::vector<DynamicFeature> dynamic_;
  std::vector<Jump> jumps_;
  std::size_t frame_ = 0;
  float jumps_seen_ = 0.0f;  // faded as `step_`
  double frames_ = 0.0;
  MovedDepth moved_;
};

}  // namespace stillpoint
