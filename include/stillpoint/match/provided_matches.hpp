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
#include "stillpoint/core/pixel_scale.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_tolerance.hpp"
#include "stillpoint/match/observation_order.hpp"
#include "stillpoint/match/older_frame_choice.hpp"
#include "stillpoint/match/older_frames.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/match/patch_observation.hpp"
#include "stillpoint/match/patch_search.hpp"
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
    const bool has_tracks = reference_pixels.size() == matches.host_count;
    for (std::size_t i = 0; i < matches.host_count; ++i) {
      const Vector2f pixel = matches.current.pixel[i];
      const float here = current.gray.border_distance_px(pixel.x(), pixel.y());
      if (!(here >= 0.0f)) {
        matches.state[i] = MatchState::outside;
        continue;
      }
      if (!has_tracks) continue;
      const Vector2f before = reference_pixels[i];
      const float there = reference.gray.border_distance_px(before.x(), before.y());
      if (there >= 0.0f) {
        matches.reference.pixel[i] = before;
        matches.state[i] = found_at(std::min(here, there), options.border_px);
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
    observe_surfaces(surfaces, history, filter_from_current, camera, noise, matches.past_observations.surfaces,
                     matches.past_observations.frames());
    for (std::size_t i = 0; i < matches.host_count && !matches.past_observations.frames().empty(); ++i) {
      if (matches.current.has_depth(i)) {
        const double depth_m = matches.current.depth_m[i];
        reproject_at_depth(i, depth_m, matches.current.depth_sigma_m[i] / (depth_m * depth_m), history, current, camera,
                           noise, observations);
      } else if (tracks_.length(i) > 0) {
        reproject_without_depth(i, history, current, camera, noise, observations);
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

  /// The pixels around a feature, cut out when they are asked for first.
  struct FeaturePatch {
    Vector2f pixel = Vector2f::Zero();
    double depth_m = 0, tolerance_m = 0;
    Patch patch = {};
    bool is_cut = false, has_texture = false;

    bool cut(const FrameView& current) {
      if (!is_cut)
        has_texture = cut_patch(current.gray, rounded(pixel), PatchMask(current.depth, depth_m, tolerance_m), patch) &&
                      patch.is_comparable();
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
      const double nearer_than_m = depth_m - places.margin_m(noise.sigma(depth_m));
      is_beside_[i] = beside_occluder(current, matches.current.pixel[i], nearer_than_m, reach_px);
    }
  }

  /// A feature without a depth lies on one of the surfaces beside it: the one on which its track is nearer to that of a
  /// static point.
  template <class Camera, class Noise>
  void reproject_without_depth(std::size_t i, const FrameHistory& history, const FrameView& current,
                               const Camera& camera, const Noise& noise, Observations& observations) const {
    const Matches& matches = observations.matches;
    const SurroundingDepth beside = surrounding_depth(current, matches.current.pixel[i],
                                                      scaled_px(options.surrounding_px, camera), surfaces.guard, noise);
    if (!(beside.farthest_m > 0)) return;
    const bool is_bridged = beside.is_bridged(noise);
    const double spread = is_bridged ? SurroundingDepth::kBridgedSpread : SurroundingDepth::kSupposedSpread;
    const auto offset_at = [&](double depth_m) {
      return reproject_at_depth(i, depth_m, spread / depth_m, history, current, camera, noise, observations);
    };
    const float far_px = offset_at(beside.farthest_m);
    if (!is_bridged && !(offset_at(beside.nearest_m) < far_px)) offset_at(beside.farthest_m);
  }

  /// Fills the feature's observations in the older frames, as if it were static at that depth.
  /// @return how far it was from the places of a static point, summed over the frames, pixels
  template <class Camera, class Noise>
  float reproject_at_depth(std::size_t i, double depth_m, double inverse_depth_sigma, const FrameHistory& history,
                           const FrameView& current, const Camera& camera, const Noise& noise,
                           Observations& observations) const {
    Matches& matches = observations.matches;
    PastObservations& past_observations = matches.past_observations;
    set_depth_in_past(i, depth_m, inverse_depth_sigma, camera, matches);
    FeaturePatch patch{matches.current.pixel[i], depth_m, DepthTolerance().at(noise.sigma(depth_m))};
    float sum_px = 0;
    const auto observe = [&](OlderFrame& frame) {
      const FrameView past = history.back(frame.age).view();
      const StaticPlace place = places.reproject(past, frame.reference_from_current, past_observations.point[i],
                                                 inverse_depth_sigma * depth_m * depth_m, camera, noise);
      Observation& observation = frame.of_feature[i];
      observation = place.observation;
      if (!matches.current.has_depth(i)) observation.depth_m = 0;  // a supposed depth agrees with nothing
      if (!place.in_view || observation.state == ObservationState::occluded) return true;
      if (is_beside_[i] != 0 || frame.age > tracks_.length(i)) return true;
      observation.state = ObservationState::seen;
      observation.dissimilarity = kDissimilarity;
      observation.found = tracks_.pixel(i, frame.age);
      const Vector2f found_px = to_float(camera.distort(to_double(observation.found)));
      observation.offset_px = (found_px - place.pixel).norm();
      sum_px += observation.offset_px;
      if (observation.offset_px > options.objection_px &&
          !(observations.remembered.log_odds[i] > options.known_log_odds))
        compare_patch(patch, current, past, place, camera, observation);
      return true;
    };
    visit_older_frames(i, past_observations.frames(), false, observe);
    return sum_px;
  }

  /// A track objects: what does its patch say? It has the last word where it can be compared.
  template <class Camera>
  static void compare_patch(FeaturePatch& feature, const FrameView& current, const FrameView& past,
                            const StaticPlace& place, const Camera& camera, Observation& observation) {
    if (!feature.cut(current)) return;
    const Vector2f beside = rounded(feature.pixel) - feature.pixel;
    const PatchFit fit = find_patch(feature.patch, past.gray, place.pixel + beside, static_point_search());
    if (!fit.inside || !(fit.contrast > kLeastContrast)) return;
    set_found(fit, place, camera, observation);
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
