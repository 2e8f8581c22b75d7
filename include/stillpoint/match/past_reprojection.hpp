// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What do older frames show where a static feature should be?   Features, the motion → past_observations

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/pixel_grid.hpp"
#include "stillpoint/core/pixel_scale.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/depth/depth_shadow.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/match/borrowed_depth.hpp"
#include "stillpoint/match/hidden_before.hpp"
#include "stillpoint/match/observation_order.hpp"
#include "stillpoint/match/older_frame_choice.hpp"
#include "stillpoint/match/older_frames.hpp"
#include "stillpoint/match/patch.hpp"
#include "stillpoint/match/patch_observation.hpp"
#include "stillpoint/match/patch_search.hpp"
#include "stillpoint/match/same_place.hpp"
#include "stillpoint/match/space_search.hpp"
#include "stillpoint/match/static_place.hpp"
#include "stillpoint/match/surface_search.hpp"
#include "stillpoint/match/surrounding_depth.hpp"
#include "stillpoint/pipeline/frame_history.hpp"

namespace stillpoint {

/// Looks for every feature at the places where a static point would have been in older frames. `choose_keyframes`
/// comes before the motion is estimated, `reproject_into_past` after.
class PastReprojection {
 public:
  struct Options {
    double slowest_m_s = 0.03;      ///< a mover of this speed should be seen against the oldest frame
    double pixel_sigma = 0.7;       ///< of a found patch, pixels
    double longest_s = 0.5;         ///< but no frame is older than this, unless frames are few
    double occlusion_sigmas = 4.0;  ///< a surface nearer by so many standard deviations of both depths hides the point
  };
  Options options;
  GuardedDepth guard;      ///< which depth of an older frame belongs to a pixel?
  SurfaceSearch surfaces;  ///< cells of smooth surface
  SpaceSearch space;       ///< who came where space was free?

  /// Chooses the older frames, and finds the surfaces in the last one.
  /// @param filter_from_expected  where the camera is expected now
  template <class Camera, class Noise>
  void choose_keyframes(const FrameHistory& history, const FrameView& current, const Pose& filter_from_expected,
                        const Camera& camera, const Noise& noise, Matches& matches, Workspace& workspace) const {
    const OlderFrameChoice choice{options.slowest_m_s, options.pixel_sigma, options.longest_s};
    choose_older_frames(choice, surfaces, space, history, current, filter_from_expected, camera, noise, matches,
                        workspace);
    order_by_place(matches, workspace);
  }

  /// Looks for the surfaces once more, and for the features.
  template <class Camera, class Noise>
  void reproject_into_past(const FrameHistory& history, const FrameView& current, const Pose& filter_from_current,
                           const Camera& camera, const Noise& noise, Observations& observations) const {
    Matches& matches = observations.matches;
    observe_surfaces(surfaces, history, filter_from_current, camera, noise, matches.past_observations.surfaces,
                     matches.past_observations.frames());
    const DepthShadow shadow(current, camera);
    SamePlace same_place(kNeighbourhood_px);
    for (const std::size_t i : matches.past_observations.order) {
      const bool may_share = i < matches.host_count && is_finite(matches.current.undistorted[i]);
      const std::size_t alike = may_share ? same_place.find(matches.current, i) : i;
      if (alike != i) {
        adopt(i, alike, camera, matches);
      } else if (matches.current.has_depth(i)) {
        const double depth_m = matches.current.depth_m[i];
        reproject_at_depth(i, depth_m, matches.current.depth_sigma_m[i] / (depth_m * depth_m),
                           std::numeric_limits<float>::infinity(), history, current, camera, noise, matches);
      } else if (i < matches.host_count && is_finite(matches.current.undistorted[i])) {
        reproject_without_depth(i, shadow, history, current, camera, noise, matches);
      }
    }
    space.count_views_through(history.space(), current.timestamp_s, filter_from_current, camera, noise, matches);
  }

 private:
  static constexpr float kNeighbourhood_px = 32.0f;  // features in one cell of this size are looked for in a row
  static constexpr DepthTolerance kSameSurface{};
  static constexpr DepthTolerance kNearer{0.02, 4.0};  // of what may have hidden a static point
  static constexpr int kOccluderReach_px = 8;          // what is nearer within this reach covers a part of the patch
  static constexpr int kSurrounding_px = 24;      // how far a feature without a depth looks for the surfaces beside it
  static constexpr double kBorrowedSigmas = 2.0;  // of a depth that an older frame measured, times the sensor's

  static void order_by_place(Matches& matches, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const PixelGrid grid(matches.current.pixel, kNeighbourhood_px, workspace, [](std::size_t) { return true; });
    std::vector<std::uint32_t>& order = matches.past_observations.order;
    order.resize(grid.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) order[rank] = static_cast<std::uint32_t>(grid.index(rank));
  }

  /// What was found of a feature is found of another that lies on it, beside.
  template <class Camera>
  static void adopt(std::size_t i, std::size_t alike, const Camera& camera, Matches& matches) {
    const FrameFeatures& features = matches.current;
    const PastObservations& past = matches.past_observations;
    if (!is_finite(past.point[alike])) return;  // on no surface: not looked for
    const double depth_m = features.has_depth(i) ? features.depth_m[i] : past.point[alike].z();
    set_depth_in_past(i, depth_m, past.inverse_depth_sigma[alike], camera, matches);
    const Vector2f beside = to_float(features.undistorted[i] - features.undistorted[alike]);
    for (OlderFrame& older : matches.past_observations.frames()) {
      Observation& observation = older.of_feature[i] = older.of_feature[alike];
      observation.found += beside;
      if (observation.depth_m > 0) observation.depth_m += static_cast<float>(depth_m - features.depth_m[alike]);
    }
  }

  /// A feature without a depth: if it stands still, an older frame may have measured it, else it lies on one of the
  /// surfaces beside it. Taken is where it looks most as if it stood. Where it looks changed there, too, no frame has
  /// confirmed the depth: it stays a guess. Where no frame can be compared, nothing is supposed. In a shadow of the
  /// sensor it lies on the farther surface, and where it looks changed its patch holds what hides it: nothing is known
  /// of it.
  template <class Camera, class Noise>
  void reproject_without_depth(std::size_t i, const DepthShadow& shadow, const FrameHistory& history,
                               const FrameView& current, const Camera& camera, const Noise& noise,
                               Matches& matches) const {
    const SurroundingDepth beside =
        surrounding_depth(current, matches.current.pixel[i], scaled_px(kSurrounding_px, camera), guard, noise);
    if (!(beside.farthest_m > 0)) return;
    std::array<double, 2 + OlderFrameChoice::kMostFrames> candidates{beside.farthest_m, beside.nearest_m};
    std::size_t count = beside.is_bridged(noise) ? 1 : 2;
    const std::size_t supposed = count;
    for (const OlderFrame& older : std::as_const(matches.past_observations).frames()) {
      const double borrowed_m =
          borrowed_depth_m(matches.current.undistorted[i], beside.farthest_m, history.back(older.age).view(),
                           older.reference_from_current, camera, guard, noise, kSameSurface);
      const bool is_known =
          count > supposed && std::abs(borrowed_m - candidates[count - 1]) < kBorrowedSigmas * noise.sigma(borrowed_m);
      if (borrowed_m > 0 && !is_known && count < candidates.size()) candidates[count++] = borrowed_m;
    }
    const auto spread_of = [&](std::size_t c) {
      const double depth_m = candidates[c];
      const double supposed_spread =
          supposed > 1 ? SurroundingDepth::kSupposedSpread : SurroundingDepth::kBridgedSpread;
      return c < supposed ? supposed_spread / depth_m : kBorrowedSigmas * noise.sigma(depth_m) / (depth_m * depth_m);
    };
    const span<OlderFrame> frames = matches.past_observations.frames();
    std::array<Observation, OlderFrameChoice::kMostFrames> least_unlike;
    std::size_t best = count;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t c = count; c-- > 0;) {
      const float dissimilarity =
          reproject_at_depth(i, candidates[c], spread_of(c), least, history, current, camera, noise, matches);
      if (!(dissimilarity < least)) continue;
      least = dissimilarity;
      best = c;
      if (clearly_stands(i, frames)) return;
      for (std::size_t f = 0; f < frames.size(); ++f) least_unlike[f] = frames[f].of_feature[i];
    }
    const bool any_compared =
        best < count && std::any_of(least_unlike.begin(), least_unlike.begin() + frames.size(), is_compared);
    const bool is_confirmed = any_compared && least < kNoEvidence * static_cast<float>(frames.size());
    if (!is_confirmed) {
      const double farther_m = shadow.farther_m(matches.current.pixel[i]);
      if (farther_m > 0) return lie_in_shadow(i, farther_m, camera, matches);
      if (!any_compared) return forget(i, matches);
    }
    set_depth_in_past(i, candidates[best],
                      is_confirmed ? spread_of(best) : SurroundingDepth::kSupposedSpread / candidates[best], camera,
                      matches);
    for (std::size_t f = 0; f < frames.size(); ++f) frames[f].of_feature[i] = least_unlike[f];
  }

  static bool is_compared(const Observation& observation) noexcept { return std::isfinite(observation.dissimilarity); }
  static float dissimilarity_of(const Observation& observation) noexcept {
    return is_compared(observation) ? observation.dissimilarity : kNoEvidence;
  }

  /// The feature lies on no known surface.
  static void forget(std::size_t i, Matches& matches) {
    matches.past_observations.point[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    matches.past_observations.inverse_depth_sigma[i] = std::numeric_limits<double>::infinity();
    for (OlderFrame& older : matches.past_observations.frames()) older.of_feature[i] = Observation{};
  }

  /// The feature lies on the farther surface, and no frame says more of it.
  template <class Camera>
  static void lie_in_shadow(std::size_t i, double farther_m, const Camera& camera, Matches& matches) {
    forget(i, matches);
    set_depth_in_past(i, farther_m, SurroundingDepth::kBridgedSpread / farther_m, camera, matches);
  }

  /// Looks for a feature in every older frame.
  /// @param most  of the sum that is returned: where it can't be less any more, looking ends
  /// @return how dissimilar it is, summed over the frames; one where it can't be compared counts as no evidence
  template <class Camera, class Noise>
  float reproject_at_depth(std::size_t i, double depth_m, double inverse_depth_sigma, float most,
                           const FrameHistory& history, const FrameView& current, const Camera& camera,
                           const Noise& noise, Matches& matches) const {
    PastObservations& past_observations = matches.past_observations;
    set_depth_in_past(i, depth_m, inverse_depth_sigma, camera, matches);
    Patch patch;
    const Vector2f centre = rounded(matches.current.pixel[i]);
    const bool textured = cut_patch(current.gray, centre,
                                    PatchMask(current.depth, depth_m, kSameSurface.at(noise.sigma(depth_m))), patch) &&
                          patch.is_comparable();
    const Vector3d point = point_at_depth(camera, centre, depth_m);
    float dissimilarity = 0;
    const auto observe = [&](OlderFrame& older) {
      Observation& observation = older.of_feature[i];
      observation = observe_in(history.back(older.age).view(), older.reference_from_current, point,
                               inverse_depth_sigma * depth_m * depth_m, textured ? &patch : nullptr, camera, noise);
      if (!matches.current.has_depth(i)) observation.depth_m = 0;  // a supposed depth agrees with nothing
      dissimilarity += dissimilarity_of(observation);
      return dissimilarity < most;
    };
    const span<OlderFrame> frames = past_observations.frames();
    const bool is_corner = i >= matches.host_count;  // which the motion leaves out where they are unlike
    visit_older_frames(i, frames, is_corner, observe);
    if (!is_corner) forget_where_hidden(i, frames);
    dissimilarity = 0;  // with what was not looked at
    for (const OlderFrame& older : frames) {
      const Observation& observation = older.of_feature[i];
      dissimilarity += dissimilarity_of(observation);
    }
    return dissimilarity;
  }

  template <class Camera, class Noise>
  Observation observe_in(const FrameView& older, const Pose& reference_from_current, const Vector3d& point,
                         double depth_sigma_m, const Patch* patch, const Camera& camera, const Noise& noise) const {
    const StaticPlace place = PlaceTest{options.occlusion_sigmas, guard}.reproject(older, reference_from_current, point,
                                                                                   depth_sigma_m, camera, noise);
    Observation observation = place.observation;
    const auto there_m = static_cast<double>(observation.depth_m);
    const auto there_sigma_m = static_cast<double>(observation.depth_sigma_m);
    const double sigma_m = std::sqrt(depth_sigma_m * depth_sigma_m + there_sigma_m * there_sigma_m);
    observation.shows_nearer = there_m > 0 && there_m < place.point.z() - kNearer.at(sigma_m);
    if (!place.in_view || patch == nullptr || observation.state == ObservationState::occluded) return observation;
    if (beside_occluder(older, place.pixel, place.nearer_than_m, scaled_px(kOccluderReach_px, camera)))
      return observation;
    PatchSearch search = static_point_search();
    search.warp = view_warp(camera, point, place.point, reference_from_current);
    const PatchFit fit = find_patch(*patch, older.gray, place.pixel, search);
    if (!fit.inside) return observation;
    // Without depth and without texture there is nothing to compare with: a hand before the lens, a blown-out lamp.
    if (!(observation.depth_m > 0) && !(fit.contrast > kLeastContrast)) return observation;
    set_found(fit, place, camera, observation);
    return observation;
  }

  /// How a small step in the current image moves in the older one, for a surface that faces the camera.
  template <class Camera>
  static Eigen::Matrix2f view_warp(const Camera& camera, const Vector3d& here, const Vector3d& there,
                                   const Pose& reference_from_current) {
    const Eigen::Matrix4d& turn = reference_from_current.matrix();
    const double x = there.x() / there.z(), y = there.y() / there.z(), aspect = camera.fx() / camera.fy();
    const double scale = here.z() / there.z();
    const auto scaled = [scale](double step) { return static_cast<float>(scale * step); };
    Eigen::Matrix2f warp;
    warp << scaled(turn(0, 0) - x * turn(2, 0)), scaled(aspect * (turn(0, 1) - x * turn(2, 1))),  //
        scaled((turn(1, 0) - y * turn(2, 0)) / aspect), scaled(turn(1, 1) - y * turn(2, 1));
    return warp;
  }
};

using LookBack [[deprecated("PastReprojection")]] = PastReprojection;  ///< its name in 0.1; gone in 0.4

template <class Visit>
void each_option(PastReprojection& stage, Visit& visit) {
  visit("slowest_m_s", stage.options.slowest_m_s, OptionRange{1e-3, 100});
  visit("pixel_sigma", stage.options.pixel_sigma, OptionRange{0.01, 100});
  visit("longest_s", stage.options.longest_s, OptionRange{0, 3600});
  visit("occlusion_sigmas", stage.options.occlusion_sigmas, OptionRange{0, 100});
  if constexpr (sees_code_only<Visit>::value) visit("guard", stage.guard);
  visit("surfaces", stage.surfaces);
}

}  // namespace stillpoint
