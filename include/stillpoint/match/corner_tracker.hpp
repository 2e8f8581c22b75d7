// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Corners of our own, followed from the current frame to the last one, coarse to fine.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_scale.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/match/coarse_alignment.hpp"
#include "stillpoint/match/grid_corners.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/match/patch_search.hpp"
#include "stillpoint/match/pyramid.hpp"

namespace stillpoint {

/// Appends support corners, one a grid cell, to the features and finds them in the reference frame. The host's own
/// keypoints are not followed: they are looked for later, where the camera's motion puts them.
class CornerTracker {
 public:
  using Needs = Capabilities<capability::metric_depth>;
  using Provides = Capabilities<capability::matches>;

  struct Options {
    int cell_px = 24;              ///< one corner for each cell of this size: 530 cells in 640 × 480
    float most_dissimilar = 0.3f;  ///< 1 − correlation above which a corner is lost
  };
  Options options;

  /// Aligns the frames roughly: says where `match` begins to look for each corner. To be called before it.
  /// @param reference_from_expected  what is expected of the motion
  /// @return reference_from_current, roughly
  template <class Camera, class Noise>
  Pose align(const FrameView& reference, const FrameView& current, const Pose& reference_from_expected,
             const Camera& camera, const Noise& noise) {
    prepare(reference, current, pixel_scale(camera));
    const Pose guess = coarse_.align(current.depth, current.gray, reference_from_expected, camera);
    is_aligned_ = true;
    const DepthScale to_depth(current.gray, current.depth.image);
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const double measured_m = RoundedDepth{}.at(current.depth, to_depth(corners_[c]));
      const double depth_m = measured_m > 0 ? measured_m : coarse_.typical_depth_m();
      const Vector3d point = point_at_depth(camera, corners_[c], depth_m);
      const auto displacement = [&](const Pose& reference_from_current) {
        const Vector3d there = reference_from_current * point;
        if (!(there.z() > 0)) return Vector2f(Vector2f::Zero());
        return Vector2f(image_pixel(camera, there) - corners_[c]);
      };
      start_[c] = {displacement(guess), displacement(reference_from_expected), kSameSurface.at(noise.sigma(depth_m))};
    }
    return guess;
  }

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    prepare(reference, current, matches.pixel_scale);
    for (std::size_t i = 0; i < matches.host_count; ++i)
      if (!(border_distance_px(current.gray, matches.current.pixel[i]) >= 0.0f)) matches.state[i] = MatchState::outside;
    const std::size_t first = matches.size();
    matches.resize(first + corners_.size());
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      matches.current.pixel[first + c] = corners_[c];
      const Found found = find(c, current.depth);
      if (!found.anywhere()) continue;
      matches.reference.pixel[first + c] = found.pixel;
      const float distance = border_distance_px(reference_[0], found.pixel);
      matches.state[first + c] = found_at(distance, kBorder_px);
    }
    std::swap(reference_, current_);
    reference_time_s_ = current.timestamp_s;
  }

  /// Do the frames as a whole look like another motion than this one? To be asked between `match` and `learn`.
  template <class Camera>
  bool contradicts(const Pose& reference_from_current, const Camera& camera) const {
    return is_aligned_ && coarse_.cost(reference_from_current, camera) > CoarseAlignment::kContradiction;
  }

  /// What stood still says where the coming alignment looks.
  void learn(const Observations& observations, span<const Label> labels) {
    coarse_.reference_weights.assign(observations, labels, reference_[0].width, reference_[0].height);
  }

  void reset() noexcept {
    reference_time_s_ = current_time_s_ = std::numeric_limits<double>::quiet_NaN();
    coarse_.reset();
  }

 private:
  // Least eigenvalue of a corner, squared gray levels over 5 × 5 pixels of the half-sized image.
  static constexpr float kWeakestCorner = 600.0f;
  static constexpr float kTooVague = 0.5f;  // on a coarse level a fit this bad does not move the start of the next
  static constexpr float kCoarsePrecision_px = 0.2f;  // of a level that only says where the next one begins
  static constexpr float kBorder_px = 8.0f;           // nearer to the border than this a match is `near_edge`
  static constexpr DepthTolerance kSameSurface{};
  static constexpr std::size_t kFinerLevels = 2;  // of the pyramid: enough where the alignment is right
  static constexpr float kOtherStart_px = 8.0f;   // a nearer second start finds what the first one finds

  /// Displacements from which the search of a corner begins, pixels. The alignment may have followed people who fill
  /// the view, and the camera may have turned where nobody expected it: the better fit counts.
  struct Start {
    Vector2f aligned = Vector2f::Zero(), expected = Vector2f::Zero();
    double tolerance_m = kSameSurface.at(0.0);  ///< by which depths on the corner's surface may differ
  };

  /// A place in the reference frame.
  struct Found {
    Vector2f pixel = Vector2f::Zero();
    float dissimilarity = std::numeric_limits<float>::infinity();
    bool anywhere() const noexcept { return dissimilarity < std::numeric_limits<float>::infinity(); }
  };

  static float border_distance_px(const ImageView& image, const Vector2f& pixel) noexcept {
    return image.border_distance_px(pixel.x(), pixel.y());
  }

  /// Pyramids of both frames, and the corners of the current one. Once for each frame.
  void prepare(const FrameView& reference, const FrameView& current, float scale) {
    if (current_time_s_ == current.timestamp_s) return;
    is_aligned_ = false;
    if (!(reference_time_s_ == reference.timestamp_s)) {
      reference_.build(reference.gray, CoarseAlignment::pyramid_levels(reference.gray));
      coarse_.add_frame(reference_);
    }
    current_.build(current.gray, CoarseAlignment::pyramid_levels(current.gray));
    coarse_.add_frame(current_);
    find_corners(scale);
    current_time_s_ = current.timestamp_s;
  }

  void find_corners(float scale) {
    constexpr int kSmallestCell_px = 4;  // of that level
    constexpr std::size_t kLevel = 1;    // sharp enough, and a quarter of the pixels
    corners_.clear();
    if (current_.size() > kLevel) {
      workspace_.rewind();
      const int cell_px = std::max(kSmallestCell_px, rounded(0.5f * scale * static_cast<float>(options.cell_px)));
      grid_corners(current_[kLevel], cell_px, kWeakestCorner, corners_, workspace_);
      for (Vector2f& corner : corners_) corner = rounded(Pyramid::from_level(corner, kLevel));
    }
    refill(start_, corners_.size(), Start{});
  }

  /// Where was a corner of the current frame?
  Found find(std::size_t corner, const DepthView& depth) const {
    const Start& start = start_[corner];
    Found found;
    if (is_aligned_) found = follow(corners_[corner], start.aligned, kFinerLevels, start.tolerance_m, depth);
    if (!found.anywhere()) found = follow(corners_[corner], start.aligned, current_.size(), start.tolerance_m, depth);
    if (!((start.expected - start.aligned).norm() > kOtherStart_px)) return found;
    const Found other = follow(corners_[corner], start.expected, current_.size(), start.tolerance_m, depth);
    return other.dissimilarity < found.dissimilarity ? other : found;
  }

  /// @param start        displacement from which the search begins, pixels
  /// @param levels       of the pyramid, from its finest on
  /// @param tolerance_m  by which depths on the corner's surface may differ
  Found follow(const Vector2f& pixel, const Vector2f& start, std::size_t levels, double tolerance_m,
               const DepthView& depth) const {
    Vector2f displacement = start;
    Patch patch;
    PatchFit fit;
    for (std::size_t level = std::min(levels, current_.size()); level-- > 0;) {
      const Vector2f cut = rounded(Pyramid::to_level(pixel, level));
      const PatchMask mask = level == 0 ? PatchMask(depth, pixel, tolerance_m) : PatchMask();
      fit = PatchFit();
      if (!cut_patch(current_[level], cut, mask, patch)) continue;
      const float scale = static_cast<float>(std::size_t{1} << level);
      PatchSearch search;
      if (level > 0) search.precision_px = kCoarsePrecision_px;
      fit = find_patch(patch, reference_[level], cut + displacement / scale, search);
      if (fit.inside && (level == 0 || fit.dissimilarity < kTooVague)) displacement += fit.offset * scale;
    }
    if (!fit.inside || !(fit.dissimilarity <= options.most_dissimilar) || !patch.is_comparable()) return {};
    const Vector2f found = pixel + displacement;
    return border_distance_px(reference_[0], found) >= 0.0f ? Found{found, fit.dissimilarity} : Found{};
  }

  Pyramid reference_, current_;
  double reference_time_s_ = std::numeric_limits<double>::quiet_NaN();
  double current_time_s_ = std::numeric_limits<double>::quiet_NaN();
  CoarseAlignment coarse_;
  std::vector<Vector2f> corners_;
  bool is_aligned_ = false;
  std::vector<Start> start_;  // of each corner's search
  Workspace workspace_;
};

template <class Visit>
void each_option(CornerTracker& stage, Visit& visit) {
  visit("cell_px", stage.options.cell_px, OptionRange{8, 512});
  visit("most_dissimilar", stage.options.most_dissimilar, OptionRange{0, 2});
}

}  // namespace stillpoint
