// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What older frames show where a static feature should be.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

enum class ObservationState : std::uint8_t {
  none,      ///< not looked for: no depth, or it would have been outside the image
  occluded,  ///< something nearer stood before it: says nothing
  seen,      ///< its place could be compared
};

/// One feature in one older frame, looked for where a static point would have been.
struct Observation {
  ObservationState state = ObservationState::none;
  bool shows_nearer = false;  ///< a surface in its place is nearer by more than noise: it may have hidden the point
  /// 1 − correlation of the most alike patch near by: 0 alike to 2 inverted; NaN: no patch could be compared.
  float dissimilarity = std::numeric_limits<float>::quiet_NaN();
  /// Undistorted pixel of that patch. Of PastReprojection: what was cut out at the rounded keypoint, up to 0.7 px
  /// beside.
  Vector2f found = Vector2f::Zero();
  float depth_m = 0;        ///< measured where the point should be, metres, 0 none
  float depth_sigma_m = 0;  ///< of that depth, metres; 0 where there is none
  float offset_px = 0;      ///< of that patch from where a static point should be, in the image as it is
};

/// A piece of smooth surface of the current frame, a cell of a coarse grid. It counts area where there are no corners.
struct SurfaceCell {
  Vector2f pixel = Vector2f::Zero();   ///< in the current image
  Vector3d point = Vector3d::Zero();   ///< in the current camera, metres
  Vector3d normal = Vector3d::Zero();  ///< unit length, in the current camera
  double depth_sigma_m = 0;
  float space_static_prior = 1.0f;        ///< 0 to 1, as `Matches::space_static_prior`
  std::uint8_t occupied_views = 0;        ///< as `Matches::occupied_views`
  Vector2f predicted = Vector2f::Zero();  ///< where it was in the reference image if it stands still, pixels
};

/// The surface that an older frame shows in the place of a cell.
struct SurfaceObservation {
  Vector3d target = Vector3d::Zero();  ///< in the older camera, metres
  double depth_sigma_m = 0;            ///< 0: nothing to be seen there
};

/// Everything that was looked for in one older frame.
struct OlderFrame {
  std::size_t age = 1;                             ///< frames back: 1 is the last
  Pose reference_from_current = Pose::Identity();  ///< that was assumed when looking, or a better one since
  double elapsed_s = 0;                            ///< from that frame to the current one
  std::vector<Observation> of_feature;
  std::vector<SurfaceObservation> of_surface;
};

/// One entry for each older frame that was looked at, the nearest in time first. Memory is kept from frame to frame.
class PastObservations {
 public:
  std::vector<SurfaceCell> surfaces;
  /// What was looked for: the feature's point in the current camera, metres; for a feature without a depth a supposed
  /// one on the surface beside it, NaN where there is none.
  std::vector<Vector3d> point;
  std::vector<double> inverse_depth_sigma;  ///< of 1 / point.z, per metre
  std::vector<std::uint8_t> views_through;  ///< how many views of the past seconds saw something farther in its place
  /// The features inside the image, neighbours near to each other: looked for in this order, what one reads of an image
  /// is still at hand for the next.
  std::vector<std::uint32_t> order;

  /// Whether a feature's depth is a guess between the surfaces beside it: not measured, not borrowed, not bridged.
  bool is_guess(std::size_t i) const noexcept {
    constexpr double kKnown = 0.05;  // spread of the inverse depth, of itself
    return !(inverse_depth_sigma[i] * point[i].z() < kKnown);
  }

  span<OlderFrame> frames() noexcept { return {frames_.data(), count_}; }
  span<const OlderFrame> frames() const noexcept { return {frames_.data(), count_}; }

  void clear() noexcept {
    surfaces.clear();
    point.clear();
    inverse_depth_sigma.clear();
    views_through.clear();
    order.clear();
    count_ = 0;
  }

  OlderFrame& add(std::size_t feature_count) {
    if (count_ == frames_.size()) frames_.emplace_back();
    OlderFrame& frame = frames_[count_++];
    refill(frame.of_feature, feature_count, Observation{});
    extend(point, feature_count, Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    extend(inverse_depth_sigma, feature_count, std::numeric_limits<double>::infinity());
    extend(views_through, feature_count, 0);
    frame.of_surface.clear();
    return frame;
  }

 private:
  std::vector<OlderFrame> frames_;
  std::size_t count_ = 0;
};

// Names of 0.1; gone in 0.4.
using SightingState [[deprecated("ObservationState")]] = ObservationState;
using Sighting [[deprecated("Observation")]] = Observation;
using SurfaceSighting [[deprecated("SurfaceObservation")]] = SurfaceObservation;
using Sightings [[deprecated("PastObservations")]] = PastObservations;

}  // namespace stillpoint
