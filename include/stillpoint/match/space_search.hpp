// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Who came where space was seen free?   Features and surfaces of now in the pooled depth images of the past seconds.
//
// Source of the idea: Schmid et al., "Dynablox: Real-time Detection of Diverse Dynamic Objects in Complex
// Environments", RA-L 2023: what occupies space that was known to be free is dynamic.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/matches.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"
#include "stillpoint/match/surface_neighbours.hpp"
#include "stillpoint/pipeline/space_history.hpp"

namespace stillpoint {

/// On the three kitchen recordings one view or more saw through 0.02 to 0.09 % of the features that stand still and 64
/// to 79 % of those that move.
class SpaceSearch {
 public:
  /// Counts in `past_observations.views_through` the views that saw something farther where each feature is now.
  /// @param filter_from_current  where the camera is now
  template <class Camera, class Noise>
  void count_views_through(const SpaceHistory& history, double timestamp_s, const Pose& filter_from_current,
                           const Camera& camera, const Noise& noise, Matches& matches) const {
    if (matches.past_observations.frames().empty()) return;  // nothing was looked for
    for_each_view(history, timestamp_s, filter_from_current, camera, noise, [&](double, const auto& look) {
      for (std::size_t i = 0; i < matches.size(); ++i)
        if (!matches.past_observations.is_guess(i) && look(matches.past_observations.point[i]) == Space::free)
          ++matches.past_observations.views_through[i];
    });
  }

  /// Before the motion is known well: support corners and surfaces that came within the past seconds get a low static
  /// prior. What no view saw before belongs to the surface beside it.
  /// @param step_px  spacing of the surfaces' cells
  template <class Camera, class Noise>
  void set_static_prior(const SpaceHistory& history, double timestamp_s, const Pose& filter_from_expected,
                        const Camera& camera, const Noise& noise, int step_px, Matches& matches,
                        Workspace& workspace) const {
    const span<SurfaceCell> cells = matches.past_observations.surfaces;
    const Workspace::Scope scope(workspace);
    const StoodFor stood_for{workspace.take<double>(cells.size(), 0.0), workspace.take<double>(matches.size(), 0.0)};
    const span<double> free_ago_s = workspace.take<double>(cells.size(), 0.0);
    for_each_view(history, timestamp_s, filter_from_expected, camera, noise, [&](double elapsed_s, const auto& look) {
      const bool is_old = elapsed_s > kSettled_s;
      const auto judge = [&](Space seen, float& static_prior, std::uint8_t& occupied_views, double& stood_for_s) {
        if (seen == Space::free) static_prior = std::min(static_prior, kFreeSpaceStaticPrior);
        if (seen != Space::occupied) return;
        if (is_old) ++occupied_views;
        stood_for_s = elapsed_s;  // views come from the newest to the oldest
      };
      for (std::size_t s = 0; s < cells.size(); ++s) {
        const Space seen = look(cells[s].point);
        judge(seen, cells[s].space_static_prior, cells[s].occupied_views, stood_for.cells_s[s]);
        if (seen == Space::free && free_ago_s[s] == 0.0) free_ago_s[s] = elapsed_s;
      }
      for (std::size_t i = matches.host_count; i < matches.size(); ++i)
        if (matches.current.has_depth(i))
          judge(look(matches.current.point[i]), matches.space_static_prior[i], matches.occupied_views[i],
                stood_for.corners_s[i]);
    });
    const double settled_s = std::max(settled_after_s(history, timestamp_s), came_ago_s(free_ago_s, workspace));
    spread_to_unseen(static_cast<float>(step_px), camera.fx(), stood_for, settled_s, matches, workspace);
  }

 private:
  // Chosen on the kitchen recordings under all conditions of bench/conditions.sh and on Bonn's crowd.
  static constexpr double kNewest_s = 0.3;       // views newer than this show who came still there
  static constexpr double kMargin_m = 0.08;      // free is what was farther by this …
  static constexpr double kDrift_m_s = 0.05;     // … and this much more for each second that poses are chained …
  static constexpr double kSigmas = 4.0;         // … and so many standard deviations of both depths
  static constexpr double kSettled_s = 2.2;      // what was there so long ago is no newcomer …
  static constexpr double kEarlyShare = 0.5;     // … nor, while less is remembered, this share of it ago …
  static constexpr double kComeSince = 0.75;     // … if this share of what came has come since
  static constexpr std::size_t kFewestCame = 5;  // cells that tell when
  static constexpr float kFreeSpaceStaticPrior = 0.05f;  // as after some frames of motion
  static constexpr int kSpreadCells = 12;                // half of an image's width
  static constexpr double kNearest_m = 0.1;

  /// What a view of the past shows in the place of a point.
  enum class Space {
    unknown,   ///< out of view, without depth, or hidden
    occupied,  ///< a surface was there
    free,      ///< the view saw through to something farther
  };

  /// Seconds since the oldest view that saw it in its place; 0: none did.
  struct StoodFor {
    span<double> cells_s, corners_s;
  };

  /// How long something must have stood to be of the room: at the beginning nothing has for `kSettled_s`, and what
  /// nobody contradicts would all go to those who came.
  static double settled_after_s(const SpaceHistory& history, double timestamp_s) noexcept {
    if (history.size() == 0) return kSettled_s;
    return std::min(kSettled_s, kEarlyShare * (timestamp_s - history.back(history.size()).timestamp_s));
  }

  /// How long ago the others came: what was first seen later may have come along, however long it has stood since. A
  /// face that came into view two seconds ago belongs to a body whose place was free before. 0 where hardly any came.
  /// @param free_ago_s  of each cell, since the newest view that saw through it; 0: none did
  static double came_ago_s(span<const double> free_ago_s, Workspace& workspace) {
    const Workspace::Scope scope(workspace);
    const span<double> came = workspace.take<double>(free_ago_s.size());
    const auto end = std::copy_if(free_ago_s.begin(), free_ago_s.end(), came.begin(), [](double s) { return s > 0; });
    const auto count = static_cast<std::size_t>(end - came.begin());
    if (count < kFewestCame) return 0.0;
    const auto most = came.begin() + static_cast<std::ptrdiff_t>(kComeSince * static_cast<double>(count - 1));
    std::nth_element(came.begin(), most, end);
    return *most;
  }

  /// A cell that no view knows takes the majority's side of those that adjoin it, round by round.
  /// @param settled_s  what stood for so long is of the room
  static void spread_to_unseen(float step_px, double focal_px, const StoodFor& stood_for, double settled_s,
                               Matches& matches, Workspace& workspace) {
    const auto is_settled = [settled_s](double seconds) { return seconds > 0 && seconds >= settled_s; };
    const span<SurfaceCell> cells = matches.past_observations.surfaces;
    if (cells.empty()) return;
    const Workspace::Scope scope(workspace);
    const SurfaceNeighbours neighbours(cells, step_px, focal_px, workspace);
    enum class Side : std::uint8_t { nobody_knows, came, stood };
    const span<Side> side = workspace.take<Side>(cells.size());
    const span<Side> next = workspace.take<Side>(cells.size());
    for (std::size_t s = 0; s < cells.size(); ++s)
      side[s] = cells[s].space_static_prior < 1.0f ? Side::came
                : is_settled(stood_for.cells_s[s]) ? Side::stood
                                                   : Side::nobody_knows;
    if (std::find(side.begin(), side.end(), Side::came) == side.end()) return;  // nothing to hand on
    const auto majority = [&](const Vector2f& pixel, double depth_m) {
      int came = 0, stood = 0;
      neighbours.around(pixel, depth_m, [&](std::size_t s) {
        came += side[s] == Side::came;
        stood += side[s] == Side::stood;
      });
      return came > stood ? Side::came : stood > came ? Side::stood : Side::nobody_knows;
    };
    for (int round = 0; round < kSpreadCells; ++round) {
      for (std::size_t s = 0; s < cells.size(); ++s)
        next[s] = side[s] == Side::nobody_knows ? majority(cells[s].pixel, cells[s].point.z()) : side[s];
      if (std::equal(next.begin(), next.end(), side.begin())) break;  // all who can know do
      std::copy(next.begin(), next.end(), side.begin());
    }
    for (std::size_t i = matches.host_count; i < matches.size(); ++i)
      if (matches.current.has_depth(i) && matches.space_static_prior[i] >= 1.0f &&
          !is_settled(stood_for.corners_s[i]) &&
          majority(matches.current.pixel[i], matches.current.depth_m[i]) == Side::came)
        matches.space_static_prior[i] = kFreeSpaceStaticPrior;
    for (std::size_t s = 0; s < cells.size(); ++s)
      if (side[s] == Side::came)
        cells[s].space_static_prior = std::min(cells[s].space_static_prior, kFreeSpaceStaticPrior);
  }

  /// Calls `visit(elapsed_s, look)` for each view that is old enough; `look(point)` tells what it saw in a place.
  template <class Camera, class Noise, class Visit>
  static void for_each_view(const SpaceHistory& history, double timestamp_s, const Pose& filter_from_current,
                            const Camera& camera, const Noise& noise, const Visit& visit) {
    for (std::size_t age = 1; age <= history.size(); ++age) {
      const PooledDepth& view = history.back(age);
      const double elapsed_s = timestamp_s - view.timestamp_s;
      if (!(elapsed_s >= kNewest_s)) continue;
      const Pose view_from_current = orthonormalized(composed(inverted(view.filter_from_camera), filter_from_current));
      visit(elapsed_s, [&](const Vector3d& point) {
        const Vector3d there = view_from_current * point;
        if (!(there.z() > kNearest_m)) return Space::unknown;
        const Vector2f pixel = image_pixel(camera, there);
        const auto nearest_m = static_cast<double>(view.nearest_around(pixel));
        if (!(nearest_m > 0)) return Space::unknown;
        const double behind_m = nearest_m - there.z(), certain_m = kMargin_m + kDrift_m_s * elapsed_s;
        if (std::abs(behind_m) < certain_m) return Space::occupied;
        const double margin_m = certain_m + kSigmas * (noise.sigma(there.z()) + noise.sigma(nearest_m));
        if (behind_m > margin_m) return Space::free;
        return behind_m > -margin_m ? Space::occupied : Space::unknown;
      });
    }
  }
};

}  // namespace stillpoint
