// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A host that tracks its features itself hands its matches over and pays for no matching.   Tracks → matches with the
// last frame; chained, past_observations in older ones

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/match/older_frames.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/match/space_search.hpp"
#include "stillpoint/match/static_place.hpp"
#include "stillpoint/match/surface_search.hpp"
#include "stillpoint/match/surrounding_depth.hpp"
#include "stillpoint/match/track_history.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// Takes the host's own tracks. Before each `filter_frame`, set `reference_pixels`: one entry for each keypoint, in
/// their order: where it was in the last frame that was filtered (distorted pixels), NaN where it was not seen.
/// They are used once and cleared. A list of another length means that the host gave no matches for this frame: every
/// feature is lost.
///
/// In a policy set that remembers frames the tracks are chained: they tell where each feature was in older frames, in
/// place of a patch search. Only where a track objects to being static is its patch compared: optical flow slides along
/// silhouettes. A set with a history of one frame gets the matches alone.
class ProvidedMatches {
 public:
  using Needs = Capabilities<>;
  using Provides = Capabilities<capability::matches, capability::feature_matches, capability::past_observations>;

  struct Options {
    float border_px = 10.0f;      ///< nearer to either image's border a feature stays out of ego-motion; 0: none
    float same_point_px = 1.0f;   ///< a track goes on at a feature of the last frame within this
    float objection_px = 1.0f;    ///< a track farther from the place of a static point objects …
    float known_log_odds = 1.0f;  ///< … and the patch has the last word, unless memory says so clearly that it moves
    int occluder_reach_px = 8;    ///< of a track beside something nearer nothing is believed
    int surrounding_px = 24;      ///< how far a feature without a depth looks for the surfaces beside it
  };
  Options options;
  OlderFrameChoice older;
  PlaceTest places;
  SurfaceSearch surfaces;  ///< cells of smooth surface
  SpaceSearch space;       ///< who came where space was free?

  std::vector<Vector2f> reference_pixels;

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    if (!(last_time_s_ == reference.timestamp_s)) tracks_.reset();
    last_time_s_ = current.timestamp_s;
    for (std::size_t i = 0; i < matches.host_count && reference_pixels.size() == matches.host_count; ++i) {
      const Vector2f pixel = matches.current.pixel[i], before = reference_pixels[i];
      const float here = current.gray.border_distance_px(pixel.x(), pixel.y());
      const float there = reference.gray.border_distance_px(before.x(), before.y());
      if (!(here >= 0.0f)) {
        matches.state[i] = MatchState::outside;
      } else if (there >= 0.0f) {
        matches.reference.pixel[i] = before;
        matches.state[i] = std::min(here, there) < options.border_px ? MatchState::near_edge : MatchState::matched;
      }
    }
    reference_pixels.clear();
  }

  /// Chains the tracks, chooses the older frames, and finds the surfaces in the last one.
  /// @param filter_from_expected  where the camera is expected now
  template <class Camera, class Noise>
  void choose_keyframes(const FrameHistory& history, const FrameView& current, const Pose& filter_from_expected,
                        const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) {
    if (history.capacity() < 2) return;
    matches.host_supports = true;
    tracks_.push(matches, history, options.same_point_px, workspace);
    choose_older_frames(older, surfaces, space, history, current, filter_from_expected, camera, noise, matches,
                        workspace);
    find_tracks_beside_occluders(current, camera, noise, matches);
  }

  /// Looks for the surfaces once more, and says where the features were.
  template <class Camera, class Noise>
  void reproject_into_past(const FrameHistory& history, const FrameView& current, const Pose& filter_from_current,
                           const Camera& camera, const Noise& noise, Observations& observations) const {
    Matches& matches = observations.matches;
    look_for_surfaces(surfaces, history, filter_from_current, camera, noise, matches.past_observations.surfaces,
                      matches.past_observations.frames());
    for (std::size_t i = 0; i < matches.host_count && !matches.past_observations.frames().empty(); ++i) {
      if (matches.current.has_depth(i)) {
        const double depth_m = matches.current.depth_m[i];
        look(i, depth_m, matches.current.depth_sigma_m[i] / (depth_m * depth_m), history, current, camera, noise,
             observations);
      } else if (tracks_.length(i) > 0) {
        look_beside(i, history, current, camera, noise, observations);
      }
    }
    space.count_views_through(history.space(), current.timestamp_s, filter_from_current, camera, noise, matches);
  }

  void reset() noexcept {
    reference_pixels.clear();
    tracks_.reset();
  }

 private:
  static constexpr float kDissimilarity = 0.06f;  // of a feature that the host has found: it has compared by itself
  static constexpr double kSupposedSpread = 0.1;  // of the inverse depth between the surfaces beside a feature
  static constexpr double kBridgedSpread = 0.03;  // where these are one surface
  static constexpr float kLeastContrast = 3.0f;   // of a patch that can be compared, gray values
  static constexpr int kFewestPixels = 25;        // of a patch's 64 that must lie on the feature's surface

  /// The pixels around a feature, cut out when they are asked for first.
  struct FeaturePatch {
    Vector2f pixel = Vector2f::Zero();
    double depth_m = 0, tolerance_m = 0;
    Patch patch = {};
    bool is_cut = false, has_texture = false;

    bool cut(const FrameView& current) {
      if (!is_cut)
        has_texture = cut_patch(current.gray, rounded(pixel), PatchMask(current.depth, depth_m, tolerance_m), patch) &&
                      patch.count >= kFewestPixels;
      is_cut = true;
      return has_texture;
    }
  };

  /// The window of an optical flow that reaches over an edge follows both sides.
  template <class Camera, class Noise>
  void find_tracks_beside_occluders(const FrameView& current, const Camera& camera, const Noise& noise,
                                    const Matches& matches) {
    const int reach_px = scaled_px(options.occluder_reach_px, camera);
    is_beside_.assign(matches.host_count, 0);
    for (std::size_t i = 0; i < matches.host_count; ++i) {
      if (!matches.matched(i) || !matches.current.has_depth(i)) continue;
      const double depth_m = matches.current.depth_m[i];
      const double nearer_than_m = depth_m - PlaceTest::kOcclusion_m - places.occlusion_sigmas * noise.sigma(depth_m);
      is_beside_[i] = beside_occluder(current, matches.current.pixel[i], nearer_than_m, reach_px);
    }
  }

  /// A feature without a depth lies on one of the surfaces beside it: the one on which its track is nearer to that of a
  /// static point.
  template <class Camera, class Noise>
  void look_beside(std::size_t i, const FrameHistory& history, const FrameView& current, const Camera& camera,
                   const Noise& noise, Observations& observations) const {
    const Matches& matches = observations.matches;
    const SurroundingDepth beside = surrounding_depth(current, matches.current.pixel[i],
                                                      scaled_px(options.surrounding_px, camera), surfaces.guard, noise);
    if (!(beside.farthest_m > 0)) return;
    const bool is_bridged = beside.farthest_m - beside.nearest_m < DepthTolerance().at(noise.sigma(beside.nearest_m));
    const double spread = is_bridged ? kBridgedSpread : kSupposedSpread;
    const auto look_at = [&](double depth_m) {
      return look(i, depth_m, spread / depth_m, history, current, camera, noise, observations);
    };
    const float far_px = look_at(beside.farthest_m);
    if (!is_bridged && !(look_at(beside.nearest_m) < far_px)) look_at(beside.farthest_m);
  }

  /// Looks a feature up in the older frames.
  /// @return how far it was from the places of a static point, summed over the frames, pixels
  template <class Camera, class Noise>
  float look(std::size_t i, double depth_m, double inverse_depth_sigma, const FrameHistory& history,
             const FrameView& current, const Camera& camera, const Noise& noise, Observations& observations) const {
    Matches& matches = observations.matches;
    PastObservations& past_observations = matches.past_observations;
    past_observations.point[i] = camera.back_project(matches.current.undistorted[i], depth_m);
    past_observations.inverse_depth_sigma[i] = inverse_depth_sigma;
    FeaturePatch patch{matches.current.pixel[i], depth_m, DepthTolerance().at(noise.sigma(depth_m))};
    float sum_px = 0;
    const auto look_at = [&](OlderFrame& frame) {
      const FrameView past = history.back(frame.age).view();
      const StaticPlace place = places.look(past, frame.reference_from_current, past_observations.point[i],
                                            inverse_depth_sigma * depth_m * depth_m, camera, noise);
      Observation& observation = frame.of_feature[i];
      observation = place.observation;
      if (!matches.current.has_depth(i)) observation.depth_m = 0;  // a supposed depth agrees with nothing
      if (!place.in_view || observation.state == ObservationState::occluded) return true;
      if (is_beside_[i] != 0 || frame.age > tracks_.length(i)) return true;
      observation.state = ObservationState::seen;
      observation.dissimilarity = kDissimilarity;
      observation.found = tracks_.pixel(i, frame.age);
      observation.offset_px = (observation.found - camera.project(place.point).template cast<float>()).norm();
      sum_px += observation.offset_px;
      if (observation.offset_px > options.objection_px &&
          !(observations.remembered.log_odds[i] > options.known_log_odds))
        examine(patch, current, past, place, camera, observation);
      return true;
    };
    look_in_older_frames(i, past_observations.frames(), false, look_at);
    return sum_px;
  }

  /// A track objects: what does its patch say? It has the last word where it can be compared.
  template <class Camera>
  static void examine(FeaturePatch& feature, const FrameView& current, const FrameView& past, const StaticPlace& place,
                      const Camera& camera, Observation& observation) {
    if (!feature.cut(current)) return;
    const Vector2f beside = rounded(feature.pixel) - feature.pixel;
    const PatchFit fit = find_patch(feature.patch, past.gray, place.pixel + beside, PatchSearch{3, 0.2f});
    if (!fit.inside || !(fit.contrast > kLeastContrast)) return;
    observation.dissimilarity = fit.dissimilarity;
    observation.offset_px = fit.offset.norm();
    observation.found = camera.undistort((place.pixel + fit.offset).template cast<double>()).template cast<float>();
  }

  TrackHistory tracks_;
  std::vector<std::uint8_t> is_beside_;
  double last_time_s_ = std::numeric_limits<double>::quiet_NaN();
};

template <class Visit>
void each_option(ProvidedMatches& stage, Visit& visit) {
  visit("border_px", stage.options.border_px, OptionRange{0, 1000});
  visit("same_point_px", stage.options.same_point_px, OptionRange{0, 100});
  visit("objection_px", stage.options.objection_px, OptionRange{0, 100});
  visit("known_log_odds", stage.options.known_log_odds, OptionRange{0, 100});
  visit("occluder_reach_px", stage.options.occluder_reach_px, OptionRange{0, 200});
  visit("surrounding_px", stage.options.surrounding_px, OptionRange{0, 200});
  visit("older", stage.older);
  visit("places", stage.places);
  visit("surfaces", stage.surfaces);
}

}  // namespace stillpoint
