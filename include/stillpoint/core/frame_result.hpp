// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The filter's answer for one frame.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/mask.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/mover.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/timings.hpp"

namespace stillpoint {

/// One entry for each of the host's keypoints, in their order. Belongs to the filter and holds until its next frame.
class FrameResult {
 public:
  /// One byte per keypoint: 1 keep, 0 drop. What `compact` takes.
  span<const std::uint8_t> keep() const noexcept { return keep_; }
  std::size_t size() const noexcept { return labels_.size(); }
  std::size_t kept_count() const noexcept { return kept_count_; }

  /// Verdict, reason, cluster and probability of keypoint `i`.
  const Label& label(std::size_t i) const noexcept { return labels_[i]; }
  [[deprecated("label(i); gone in 0.4")]] const Label& verdict(std::size_t i) const noexcept { return labels_[i]; }
  const FeatureScore& score(std::size_t i) const noexcept { return scores_[i]; }
  /// That the filter used, metres, 0 where there is none: moved where depth is late (DepthRegistration), carried over
  /// from the last frames where the depth image has a hole (HoleFilling).
  double depth_m(std::size_t i) const noexcept { return depth_m_[i]; }

  Status status() const noexcept { return status_; }
  /// Of a frame that was judged: what is worth knowing beside its status.
  Warnings warnings() const noexcept { return warnings_; }
  /// What is probably wrong with the way the filter is used, one English sentence; empty where nothing is. Lives as
  /// long as the program.
  const char* hint() const noexcept { return hint_; }
  /// The motion that the verdicts assumed: current_from_reference.
  const Motion& motion() const noexcept { return motion_; }
  const Timings& timings() const noexcept { return timings_; }
  /// How many dynamic features the keep-floor kept.
  std::size_t keep_floor_kept() const noexcept { return keep_floor_kept_; }

  /// The objects that move, or moved and are parked, in the order of their identifiers; empty without a stage for them
  /// (policies/with_movers.hpp) and where the frame was not judged, unless all it lacked were keypoints.
  span<const Mover> movers() const noexcept { return movers_.list; }
  /// The mover that keypoint `i` belongs to; null where it belongs to none.
  const Mover* mover(std::size_t i) const noexcept {
    const std::int32_t index = movers_.of_feature[i];
    return index == Movers::kNone ? nullptr : &movers_.list[static_cast<std::size_t>(index)];
  }
  /// Indices of the keypoints of a mover of this result.
  span<const std::uint32_t> features(const Mover& mover) const noexcept {
    return {movers_.feature.data() + mover.first_feature, mover.feature_count};
  }
  /// Paints a mask of the image's size: 255 keeps, 0 within `radius_px` of the features of a mover of this result and
  /// of the filter's own corners on it.
  void mask(const Mover& mover, ImageBuffer& mask, int radius_px = 12) const {
    keep_everywhere(width_, height_, mask);
    for (std::size_t k = mover.first_pixel; k < mover.first_pixel + mover.pixel_count; ++k)
      drop_disc(movers_.pixel[k], radius_px, mask);
  }

  /// Paints a mask of the image's size: 255 keeps, 0 within `radius_px` of a dropped feature.
  /// The buffer is reused when it has that size already.
  void mask(ImageBuffer& mask, int radius_px = 12) const {
    keep_everywhere(width_, height_, mask);
    for (std::size_t i = 0; i < labels_.size(); ++i)
      if (keep_[i] == 0) drop_disc(pixel_[i], radius_px, mask);
  }

 private:
  template <class Policies>
  friend class FrameFilter;

  /// Everything kept, nothing judged: what stays when a frame can't be judged.
  void begin(span<const Vector2f> pixels, int width, int height) {
    width_ = width;
    height_ = height;
    pixel_.assign(pixels.begin(), pixels.end());
    refill(labels_, pixels.size(), Label{});
    refill(scores_, pixels.size(), FeatureScore{});
    refill(depth_m_, pixels.size(), 0.0);
    refill(keep_, pixels.size(), 1);
    kept_count_ = pixels.size();
    keep_floor_kept_ = 0;
    status_ = Status::ok;
    warnings_ = Warnings();
    hint_ = "";
    motion_ = Motion{};
    movers_.begin(pixels.size());
    timings_ = Timings{};
  }

  /// Takes over the labels, of which the first size() are the host's.
  void finish(span<const Label> labels, span<const FeatureScore> scores, span<const double> depth_m) {
    std::copy_n(labels.begin(), labels_.size(), labels_.begin());
    std::copy_n(scores.begin(), scores_.size(), scores_.begin());
    std::copy_n(depth_m.begin(), depth_m_.size(), depth_m_.begin());
    kept_count_ = keep_floor_kept_ = 0;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      keep_[i] = labels_[i].keep ? 1 : 0;
      kept_count_ += keep_[i];
      keep_floor_kept_ += labels_[i].reason == Reason::keep_floor;
    }
  }

  std::vector<Vector2f> pixel_;
  std::vector<Label> labels_;
  std::vector<FeatureScore> scores_;
  std::vector<double> depth_m_;
  std::vector<std::uint8_t> keep_;
  std::size_t kept_count_ = 0;
  std::size_t keep_floor_kept_ = 0;
  int width_ = 0, height_ = 0;
  Status status_ = Status::first_frame;
  Warnings warnings_;
  const char* hint_ = "";
  Motion motion_;
  Movers movers_;
  Timings timings_;
};

}  // namespace stillpoint
