// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The frames that the filter remembers: a view may die after `filter_frame`, so what is needed later is copied here.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/pipeline/space_history.hpp"

namespace stillpoint {

/// A remembered frame.
struct PastFrame {
  ImageBuffer gray, depth;
  double depth_factor = 1.0;
  double timestamp_s = 0.0;
  Pose filter_from_camera = Pose::Identity();  ///< the filter's own chained pose of that frame, metres

  FrameView view() const {
    FrameView frame;
    frame.gray = gray.view();
    frame.depth = DepthView(depth.view(), depth_factor);
    frame.timestamp_s = timestamp_s;
    return frame;
  }
};

/// A ring of past frames, newest first: the last one, and before it frames at least 1/40 s apart, so that at high rates
/// it reaches as far back as at 30 Hz. Slots are reused: no allocation once it is full.
class FrameHistory {
 public:
  explicit FrameHistory(std::size_t capacity = 1) : ring_(std::max<std::size_t>(capacity, 1)) {}

  std::size_t size() const noexcept { return size_; }
  std::size_t capacity() const noexcept { return ring_.size(); }
  bool empty() const noexcept { return size_ == 0; }
  void clear() noexcept {
    size_ = 0;
    space_.clear();
  }

  /// Where the past seconds saw space.
  const SpaceHistory& space() const noexcept { return space_; }

  /// 1 is the last frame, size() the oldest.
  const PastFrame& back(std::size_t age) const noexcept {
    return ring_[age <= head_ ? head_ - age : head_ + ring_.size() - age];
  }

  /// The filter's own chained pose of the frame to which `motion` leads from the last one.
  Pose filter_from_current(const Motion& motion) const {
    return empty() ? Pose::Identity()
                   : orthonormalized(composed(back(1).filter_from_camera, inverted(motion.current_from_reference)));
  }

  /// Whether the frame before the last is none of these: the last one took its place.
  bool skips_second_last() const noexcept { return skips_second_last_; }

  /// Copies a frame in; the oldest is overwritten when the ring is full, or the last one, if it is too close to the one
  /// before it. Where its motion is not known, the older ones are forgotten: their poses are of another world now.
  void push(const FrameView& frame, const Motion& motion) {
    if (!motion.usable()) clear();
    push(frame, filter_from_current(motion));
  }

  /// The same, with a pose.
  void push(const FrameView& frame, const Pose& filter_from_camera) {
    skips_second_last_ = size_ > 1 && back(1).timestamp_s - back(2).timestamp_s < kClosest_s;
    if (skips_second_last_) {
      head_ = (head_ + ring_.size() - 1) % ring_.size();
      --size_;
    }
    PastFrame& slot = ring_[head_];
    slot.gray.assign(frame.gray);
    slot.depth.assign(frame.depth.image);
    slot.depth_factor = frame.depth.factor;
    slot.timestamp_s = frame.timestamp_s;
    slot.filter_from_camera = filter_from_camera;
    head_ = (head_ + 1) % ring_.size();
    size_ = std::min(size_ + 1, ring_.size());
    if (ring_.size() > 1) space_.push(frame, filter_from_camera);
  }

 private:
  static constexpr double kClosest_s = 1.0 / 40.0;  // between the frames of a camera of 30 Hz, whose stamps jitter

  std::vector<PastFrame> ring_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  bool skips_second_last_ = false;
  SpaceHistory space_;
};

}  // namespace stillpoint
