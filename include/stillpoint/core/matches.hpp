// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Where each feature is now and where it was before: the table that the matcher fills.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/extend.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/past_observations.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// What became of looking for a feature in the reference frame.
enum class MatchState : std::uint8_t {
  matched,
  lost,       ///< in view, but not found
  near_edge,  ///< found, but too near to the image border to be used for ego-motion
  outside,    ///< its keypoint is outside the image or not finite
};

/// The state of what was found so far from the image's border, pixels.
inline MatchState found_at(float border_distance_px, float border_px) noexcept {
  return border_distance_px < border_px ? MatchState::near_edge : MatchState::matched;
}

/// The features as one frame sees them. Parallel arrays, one entry per feature.
struct FrameFeatures {
  std::vector<Vector2f> pixel;        ///< in the image as it is (distorted), pixels
  std::vector<Vector2d> undistorted;  ///< pixels of the ideal pinhole
  std::vector<double> depth_m;        ///< metres, 0 where there is none
  std::vector<double> depth_sigma_m;  ///< its standard deviation, metres; infinite without a depth
  std::vector<Vector3d> point;        ///< in this frame's camera, metres; NaN without a depth

  std::size_t size() const noexcept { return pixel.size(); }
  bool has_depth(std::size_t i) const noexcept { return depth_m[i] > 0.0; }
  bool any_depth() const noexcept {
    return std::any_of(depth_m.begin(), depth_m.end(), [](double depth) { return depth > 0.0; });
  }

  void resize(std::size_t count) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    extend(pixel, count, Vector2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    extend(undistorted, count, Vector2d::Constant(kNaN));
    extend(depth_m, count, 0.0);
    extend(depth_sigma_m, count, std::numeric_limits<double>::infinity());
    extend(point, count, Vector3d::Constant(kNaN));
  }

  /// Writes what is known of feature `i` at a depth (0: none) with the noise of that depth.
  template <class Camera>
  void set_depth(std::size_t i, double depth, double sigma_m, const Camera& camera) {
    depth_m[i] = depth;
    if (depth > 0.0) {
      depth_sigma_m[i] = sigma_m;
      point[i] = camera.back_project(undistorted[i], depth);
    } else {
      depth_m[i] = 0.0;
      depth_sigma_m[i] = std::numeric_limits<double>::infinity();
      point[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
};

/// All features of a frame. The first `host_count` are the host's keypoints in their order; a matcher may append
/// corners of its own behind them, which take part in every stage and in no result.
struct Matches {
  std::size_t host_count = 0;
  bool host_supports =
      false;  ///< a matcher without corners of its own: one host's feature per cell supports the motion
  /// Focal length over 525 px, a Kinect's: lengths in pixels among the options are for that and scale with it.
  float pixel_scale = 1.0f;
  double elapsed_s = 0;   ///< from the reference frame to the current one
  double unjudged_s = 0;  ///< from the frame that was judged last to the reference: what is remembered is so much older
  FrameFeatures current;
  FrameFeatures reference;  ///< valid where `state` is matched or near_edge
  std::vector<MatchState> state;
  std::vector<Vector2f> predicted;  ///< where it was in the reference image if it stands still, roughly; pixels
  std::vector<std::uint8_t> occupied_views;  ///< how many views of seconds ago saw a surface in its place
  std::vector<float> space_static_prior;     ///< 0 to 1: low where older views saw free space
  PastObservations past_observations;        ///< in older frames, for a matcher that reprojects into past frames

  std::size_t size() const noexcept { return state.size(); }

  /// The first feature that speaks for the camera's motion in older frames: of the matcher's own corners, spread over
  /// the image; of the host's features where `host_supports`.
  std::size_t first_support() const noexcept { return host_supports ? 0 : host_count; }

  /// The first feature whose flow tells how its surroundings move: of the matcher's own corners, spread over the image;
  /// of the host's features where it has none.
  std::size_t first_flow() const noexcept { return size() > host_count ? host_count : 0; }

  bool matched(std::size_t i) const noexcept {
    return state[i] == MatchState::matched || state[i] == MatchState::near_edge;
  }
  /// Matched, with depth at both ends: it has a 3D point in both frames.
  bool metric(std::size_t i) const noexcept { return matched(i) && current.has_depth(i) && reference.has_depth(i); }

  /// Makes room for the host's keypoints and forgets everything else.
  void begin(span<const Vector2f> pixels) {
    host_count = pixels.size();
    host_supports = false;
    current.resize(0);
    reference.resize(0);
    state.clear();
    predicted.clear();
    occupied_views.clear();
    space_static_prior.clear();
    past_observations.clear();
    resize(host_count);
    for (std::size_t i = 0; i < host_count; ++i) current.pixel[i] = predicted[i] = pixels[i];
  }

  void resize(std::size_t count) {
    current.resize(count);
    reference.resize(count);
    extend(state, count, MatchState::lost);
    extend(predicted, count, Vector2f::Zero());
    extend(occupied_views, count, 0);
    extend(space_static_prior, count, 1.0f);
  }
};

}  // namespace stillpoint
