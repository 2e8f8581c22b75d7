// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// By how much must the edges of the depth image move along their flow, and aside, to lie on those of the image?

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/depth/depth_jumps.hpp"

namespace stillpoint {

/// A jump of depth, and how the surface before it moves.
struct FlowingJump {
  Vector2f pixel = Vector2f::Zero();  ///< of the gray image
  Vector2f flow = Vector2f::Zero();   ///< within an interval, pixels
};

/// Moves jumps of depth by nine delays along their flow, and by 63 shifts, and sums up the gray steps that they come to
/// lie on. At a constant flow a delay looks like a shift, and no delay is found. What was seen long ago fades; fewer
/// than 20 jumps tell nothing.
class RegistrationFit {
 public:
  struct Best {
    double intervals = 0.0;         ///< the delay
    float gain = 0.0f;              ///< by what share its gray steps are more than those of no delay
    float deviations = 0.0f;        ///< that, times the square root of the number of jumps seen
    int right_px = 0, down_px = 0;  ///< the shortest of the best shifts at that delay, of depth, gray pixels
    float shift_gain = 0.0f;        ///< by what share its gray steps are more than those of no shift at that delay
    float shift_deviations = 0.0f;  ///< as above
    /// False where the farthest shift is best: the images are shifted by more than is searched, and a delay makes up
    /// for a part of it.
    bool is_inside = true;
  };

  /// Adds the mean gray step at the moved jumps of one frame, over that of all delays and shifts.
  void add(const ImageView& gray, span<const FlowingJump> jumps) {
    const int step_px = std::max(gray.longer_side_px() / 320, 1);
    step_px_ = step_px;
    const std::size_t stride = 1 + jumps.size() / kMostJumps;
    Steps seen;
    float sum = 0.0f;
    for (int d = 0; d < kDelays; ++d)
      for (int s = 0; s < kShifts_x * kShifts_y; ++s) {
        const int right_px = step_px * steps_right(s), down_px = step_px * steps_down(s);
        int steps = 0;
        for (std::size_t i = 0; i < jumps.size(); i += stride) {
          const Vector2f at = jumps[i].pixel + static_cast<float>(delay(d)) * jumps[i].flow;
          if (gray.border_distance_px(at.x(), at.y()) >= 0.0f)
            steps += gray_step(gray, rounded(at.x()) + right_px, rounded(at.y()) + down_px, step_px);
        }
        seen[d][s] = static_cast<float>(steps);
        sum += seen[d][s];
      }
    if (!(sum > 0.0f)) return;
    const auto count = static_cast<float>(jumps.size());
    jumps_ = kFading * jumps_ + count;
    for (int d = 0; d < kDelays; ++d)
      for (int s = 0; s < kShifts_x * kShifts_y; ++s)
        steps_[d][s] = kFading * steps_[d][s] + seen[d][s] * (count * kDelays * kShifts_x * kShifts_y) / sum;
  }

  Best best() const noexcept {
    Best best;
    if (!(jumps_ >= kFewestJumps)) return best;
    int delayed = kNoDelay;
    for (int d = 0; d < kDelays; ++d)
      if (fit(d) > fit(delayed)) delayed = d;
    best.intervals = delay(delayed);
    best.gain = fit(delayed) / fit(kNoDelay) - 1.0f;
    best.deviations = best.gain * std::sqrt(jumps_);
    const int shift = least_shift(delayed);
    best.right_px = step_px_ * steps_right(shift);
    best.down_px = step_px_ * steps_down(shift);
    best.shift_gain = steps_[delayed][shift] / steps_[delayed][kNoShift] - 1.0f;
    best.shift_deviations = best.shift_gain * std::sqrt(jumps_);
    best.is_inside = fit_inside(delayed) >= fit(delayed);
    return best;
  }

  void reset() noexcept { *this = RegistrationFit(); }

 private:
  static constexpr std::size_t kMostJumps = 400;      // of a frame; more are thinned out
  static constexpr float kFewestJumps = 20.0f;        // of all frames
  static constexpr int kDelays = 9;                   // from one interval too new to one too old …
  static constexpr double kDelayStep = 0.25;          // … of intervals
  static constexpr int kNoDelay = kDelays / 2;        // the one in the middle
  static constexpr int kShifts_x = 9, kShifts_y = 7;  // 8 px and 6 px to each side, where the image has 640 columns
  static constexpr int kNoShift = kShifts_x * kShifts_y / 2;
  static constexpr float kNearlyBest = 0.95f;
  static constexpr float kFading = 0.98f;  // of what was seen, with each frame

  using Steps = float[kDelays][kShifts_x * kShifts_y];

  static int steps_right(int s) noexcept { return s % kShifts_x - kShifts_x / 2; }
  static int steps_down(int s) noexcept { return s / kShifts_x - kShifts_y / 2; }
  static double delay(int d) noexcept { return kDelayStep * (d - kNoDelay); }

  float fit(int d) const noexcept { return *std::max_element(std::begin(steps_[d]), std::end(steps_[d])); }

  /// The shortest of all shifts that are nearly as good as the best: upright edges say little of one upwards.
  int least_shift(int d) const noexcept {
    const auto squared = [](int s) { return steps_right(s) * steps_right(s) + steps_down(s) * steps_down(s); };
    const float nearly_best = kNearlyBest * fit(d);
    int least = kNoShift;
    for (int s = 0, length = std::numeric_limits<int>::max(); s < kShifts_x * kShifts_y; ++s)
      if (steps_[d][s] >= nearly_best && squared(s) < length) length = squared(least = s);
    return least;
  }

  /// The greatest of all shifts but the farthest.
  float fit_inside(int d) const noexcept {
    float greatest = 0.0f;
    for (int y = 1; y + 1 < kShifts_y; ++y)
      for (int x = 1; x + 1 < kShifts_x; ++x) greatest = std::max(greatest, steps_[d][y * kShifts_x + x]);
    return greatest;
  }

  Steps steps_{};       // gray steps by delay and shift, over their mean, by jumps
  float jumps_ = 0.0f;  // faded as `steps_`
  int step_px_ = 1;
};

}  // namespace stillpoint
