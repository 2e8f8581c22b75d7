// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Does the depth image lie on its image?   Its edges are a little beside those of the image if it is of another time,
// or shifted.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/warnings.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/carried_depth.hpp"
#include "stillpoint/depth/depth_jumps.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/moved_depth.hpp"
#include "stillpoint/depth/registration_fit.hpp"
#include "stillpoint/depth/shifted_depth.hpp"

namespace stillpoint {

/// Measures how late depth is, and by how many pixels it is shifted, and undoes both: the edges of the depth image are
/// moved along with what they belong to; with the right delay and shift they lie on edges of the gray image
/// (`RegistrationFit`). Static ones move with the camera, those beside dynamic features as these do; for the delay the
/// clearer of the two answers counts, for the shift that of the moving edges, where it does harm.
/// People who walk tell both within a few frames, a camera that moves evenly never. docs/design/sweeps.md, "Depth of
/// another time", "Depth that lies beside its image".
class DepthRegistration {
 public:
  bool is_enabled = true;  ///< false: depth is used as it comes; no option in files

  /// The depth image at the image's time and place, as if all were static: the frame's own, unless it is known to be of
  /// another.
  /// @param current_from_reference  roughly
  /// @return  valid until the next call
  template <class Camera>
  DepthView undo(const FrameView& reference, const FrameView& current, const Pose& current_from_reference,
                 const Camera& camera) {
    if (!is_enabled || current.depth.empty()) return current.depth;
    in_place_ = current;
    if (is_shifted()) {
      const DepthScale to_depth(current.gray, current.depth.image);
      in_place_.depth = shifted_(current.depth, rounded(static_cast<float>(right_px_) * to_depth.x),
                                 rounded(static_cast<float>(down_px_) * to_depth.y));
    }
    undone_ = in_place_.depth;
    const double elapsed_s = current.timestamp_s - reference.timestamp_s;
    if (delay_s_ != 0.0) undone_ = moved_(in_place_, scaled(current_from_reference, delay_s_ / elapsed_s), camera);
    return undone_;
  }

  /// After the matches: corners take depth of another time along, static or not.
  /// @param as_it_came  the frame that `undo` was given …
  /// @param current     … and with what it returned, some of its holes filled
  /// @param matches     where corners were in the last frame
  /// @return  the depth image at the image's time; valid until the next call
  DepthView undo_along_flow(const FrameView& as_it_came, const FrameView& current, const Matches& matches,
                            Workspace& workspace) {
    if (!is_enabled || delay_s_ == 0.0 || as_it_came.depth.empty()) return current.depth;
    return carried_(in_place_, undone_, current.depth, delay_s_ / matches.elapsed_s, matches, workspace);
  }

  /// Measures at every second frame.
  /// @param frame    as it came
  /// @param matches  its features …
  /// @param labels   … and which of them are kept
  /// @param motion   from the last frame to this one
  template <class Camera>
  void observe(const FrameView& frame, const Matches& matches, span<const Label> labels, const Motion& motion,
               const Camera& camera) {
    if (!is_enabled) return reset();  // what was found is of a sensor that nobody watches any more
    if (!motion.metric || frame.depth.empty() || !(matches.elapsed_s > 0.0) || frame_++ % kLookEvery != 0) return;
    if (interval_s_ == 0.0) interval_s_ = matches.elapsed_s;
    const double interval = interval_s_ / matches.elapsed_s;
    find_dynamic(matches, labels, static_cast<float>(interval));
    find_static_jumps(frame, scaled(motion.current_from_reference, interval), camera);
    if (jumps_.size() >= kFewestJumps && camera_moves(frame.gray.longer_side_px())) of_static_.add(frame.gray, jumps_);
    find_moving_jumps(frame);
    of_moving_.add(frame.gray, jumps_);
    const RegistrationFit::Best of_moving = of_moving_.best();
    decide_delay(of_static_.best(), of_moving);
    decide_shift(of_moving);
  }

  /// By how much depth is older than its image, seconds; below 0, newer. 0: less than half the time between frames, or
  /// not known, or not enabled.
  double delay_s() const noexcept { return is_enabled ? delay_s_ : 0.0; }

  /// By how much the depth image is moved, to the right and down, in pixels of the gray image; 0: not known, or not
  /// enabled.
  int right_px() const noexcept { return is_enabled ? right_px_ : 0; }
  int down_px() const noexcept { return is_enabled ? down_px_ : 0; }

  Warnings warnings() const noexcept {
    Warnings warnings;
    if (delay_s() != 0.0) warnings.add(Warning::depth_unsynchronised);
    if (is_enabled && is_shifted()) warnings.add(Warning::depth_shifted);
    return warnings;
  }

  void reset() noexcept {
    interval_s_ = delay_s_ = 0.0;
    right_px_ = down_px_ = 0;
    frame_ = 0;
    of_static_.reset();
    of_moving_.reset();
  }

 private:
  static constexpr std::size_t kLookEvery = 2;       // frame
  static constexpr int kRows = 30;                   // of the depth image; twice as many for movers
  static constexpr std::size_t kFewestJumps = 20;    // static ones in a frame
  static constexpr float kClearly = 0.15f;           // a delay is better than none by this share …
  static constexpr float kDeviations = 3.5f;         // … and by this over the square root of the number of jumps …
  static constexpr float kMovingDeviations = 5.0f;   // … of movers' jumps: they are of few objects …
  static constexpr float kShiftDeviations = 15.0f;   // … and for a shift: a delay looks like one at first …
  static constexpr float kStill = 0.03f;             // … and what was found holds while it is better by this
  static constexpr double kLeastDelay = 0.5;         // of an interval: less is left as it is …
  static constexpr double kLeastHeld = 0.25;         // … unless more was found before
  static constexpr float kReachShare = 0.1f;         // of the longer side: so near to a dynamic feature …
  static constexpr double kSameObject_m = 0.3;       // … and about as deep, a jump is that object's …
  static constexpr float kMovingReachShare = 0.05f;  // … and moves with it so near …
  static constexpr float kLeastFlowShare = 1.0f / 213;  // … if that moves by 3 pixels of 640

  struct DynamicFeature {
    Vector2f pixel;
    Vector2f flow;  ///< within `interval_s_`; NaN where it is not matched
    double depth_m;
  };

  static Vector2f unknown() { return Vector2f::Constant(std::numeric_limits<float>::quiet_NaN()); }

  /// @param interval  `interval_s_` over the time since the last frame
  void find_dynamic(const Matches& matches, span<const Label> labels, float interval) {
    const FrameFeatures& now = matches.current;
    dynamic_.clear();
    dynamic_.reserve(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i].keep || !is_finite(now.pixel[i])) continue;
      DynamicFeature feature{now.pixel[i], unknown(), now.depth_m[i]};
      if (matches.matched(i)) feature.flow = interval * (now.pixel[i] - matches.reference.pixel[i]);
      dynamic_.push_back(feature);
    }
  }

  static bool is_of(const DynamicFeature& feature, const Vector2f& pixel, double depth_m, float reach_px) {
    return (feature.pixel - pixel).squaredNorm() < reach_px * reach_px &&
           !(feature.depth_m > 0.0 && std::abs(feature.depth_m - depth_m) > kSameObject_m);
  }

  bool is_dynamic(const Vector2f& pixel, double depth_m, float reach_px) const {
    return std::any_of(dynamic_.begin(), dynamic_.end(),
                       [&](const DynamicFeature& feature) { return is_of(feature, pixel, depth_m, reach_px); });
  }

  /// Of the nearest dynamic feature whose jump it is; NaN where there is none.
  Vector2f dynamic_flow(const Vector2f& pixel, double depth_m, float reach_px) const {
    Vector2f flow = unknown();
    for (const DynamicFeature& feature : dynamic_) {
      if (!is_finite(feature.flow) || !is_of(feature, pixel, depth_m, reach_px)) continue;
      reach_px = (feature.pixel - pixel).norm();
      flow = feature.flow;
    }
    return flow;
  }

  /// @param motion  of the camera within `interval_s_`
  template <class Camera>
  void find_static_jumps(const FrameView& frame, const Pose& motion, const Camera& camera) {
    jumps_.clear();
    jumps_.reserve(static_cast<std::size_t>(2 * kRows * frame.depth.image.width / kDepthJumpReach_px));
    const DepthScale to_depth(frame.gray, frame.depth.image);
    const float reach_px = kReachShare * static_cast<float>(frame.gray.longer_side_px());
    for_each_depth_jump(frame.depth, kRows, [&](int u, int v, float nearer_m) {
      const Vector2f pixel = to_depth.inverse({depth_jump_at(frame.depth, u, v), static_cast<float>(v)});
      if (is_dynamic(pixel, static_cast<double>(nearer_m), reach_px)) return;
      const Vector3d before = point_at_depth(camera, pixel, static_cast<double>(nearer_m));
      const Vector3d after = motion * before;
      if (!(after.z() > 0.1 * before.z())) return;
      // Both by the lens: beyond its range `undistort` has no inverse.
      const Vector2d flow = camera.distort(camera.project(after)) - camera.distort(camera.project(before));
      jumps_.push_back({pixel, to_float(flow)});
    });
  }

  /// Far enough for a delay to be seen: by 2 pixels in a mean jump, where the image has 640 columns.
  bool camera_moves(int longer_side_px) const noexcept {
    float sum_px = 0.0f;
    for (const FlowingJump& jump : jumps_) sum_px += jump.flow.norm();
    return sum_px * 320.0f > static_cast<float>(jumps_.size()) * static_cast<float>(longer_side_px);
  }

  void find_moving_jumps(const FrameView& frame) {
    jumps_.clear();
    jumps_.reserve(static_cast<std::size_t>(4 * kRows * frame.depth.image.width / kDepthJumpReach_px));
    const DepthScale to_depth(frame.gray, frame.depth.image);
    const auto side_px = static_cast<float>(frame.gray.longer_side_px());
    for_each_depth_jump(frame.depth, 2 * kRows, [&](int u, int v, float nearer_m) {
      const Vector2f pixel = to_depth.inverse({depth_jump_at(frame.depth, u, v), static_cast<float>(v)});
      const Vector2f flow = dynamic_flow(pixel, static_cast<double>(nearer_m), kMovingReachShare * side_px);
      if (flow.norm() > kLeastFlowShare * side_px) jumps_.push_back({pixel, flow});
    });
  }

  bool is_shifted() const noexcept { return right_px_ != 0 || down_px_ != 0; }

  void decide_delay(const RegistrationFit::Best& of_static, const RegistrationFit::Best& of_moving) noexcept {
    const bool moving_is_clearer = of_moving.deviations > of_static.deviations;
    const RegistrationFit::Best& best = moving_is_clearer ? of_moving : of_static;
    const float deviations = moving_is_clearer ? kMovingDeviations : kDeviations;
    const bool is_clear = delay_s_ != 0.0 ? best.gain > kStill : best.gain > kClearly && best.deviations > deviations;
    const double least = delay_s_ != 0.0 ? kLeastHeld : kLeastDelay;
    delay_s_ = is_clear && best.is_inside && std::abs(best.intervals) >= least ? best.intervals * interval_s_ : 0.0;
  }

  void decide_shift(const RegistrationFit::Best& best) noexcept {
    const bool is_clear =
        best.shift_gain > kClearly && best.is_inside && (is_shifted() || best.shift_deviations > kShiftDeviations);
    right_px_ = is_clear ? best.right_px : 0;
    down_px_ = is_clear ? best.down_px : 0;
  }

  RegistrationFit of_static_, of_moving_;
  std::vector<DynamicFeature> dynamic_;
  std::vector<FlowingJump> jumps_;
  std::size_t frame_ = 0;
  double interval_s_ = 0.0;  // delays are searched in quarters of it: the time between the frames looked at first
  double delay_s_ = 0.0;
  MovedDepth moved_;
  int right_px_ = 0, down_px_ = 0;
  ShiftedDepth shifted_;
  FrameView in_place_;  // the current frame, its depth no more shifted
  DepthView undone_;    // the same, at the image's time
  CarriedDepth carried_;
};

}  // namespace stillpoint
