// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "multi_view.hpp"

#include <map>

namespace examples::slam {

BundleProblem MultiView::gather(KeyframeId newest, const Map& map) const {
  const std::vector<KeyframeId> window =
      map.with_neighbours(newest, options.fewest_shared, options.window_keyframes - 1);
  BundleProblem problem;
  for (const KeyframeId id : window) problem.views.push_back({id, map.keyframe(id).camera_from_world, id == 0});
  add_measurements(problem, map, map.points_of(window));
  bool is_held = false;
  for (const BundleProblem::View& view : problem.views) is_held = is_held || view.is_fixed;
  if (!is_held) problem.views.back().is_fixed = true;
  return problem;
}

BundleProblem MultiView::gather_all(const Map& map) const {
  BundleProblem problem;
  std::vector<KeyframeId> all;
  for (const auto& [id, keyframe] : map.keyframes()) {
    problem.views.push_back({id, keyframe.camera_from_world, all.empty()});
    all.push_back(id);
  }
  add_measurements(problem, map, map.points_of(all));
  return problem;
}

/// All that is measured of some points. Views that see them and are not there yet are added, fixed.
void MultiView::add_measurements(BundleProblem& problem, const Map& map, span<const PointId> points) const {
  std::map<KeyframeId, int> view_of;
  for (std::size_t i = 0; i < problem.views.size(); ++i) view_of[problem.views[i].keyframe] = static_cast<int>(i);
  for (const PointId id : points) {
    const int index = static_cast<int>(problem.points.size());
    problem.points.push_back({id, map.point(id).p_world});
    for (const Observation& seen : map.point(id).observations) {
      const auto [view, is_new] = view_of.try_emplace(seen.keyframe, static_cast<int>(problem.views.size()));
      const Keyframe& keyframe = map.keyframe(seen.keyframe);
      if (is_new) problem.views.push_back({seen.keyframe, keyframe.camera_from_world, true});
      const auto i = static_cast<std::size_t>(seen.feature);
      BundleProblem::Measurement measurement{view->second, index, keyframe.pixel[i],
                                             noise_.pixel(keyframe, seen.feature), keyframe.depth_m[i]};
      measurement.depth_sigma_m = noise_.depth_m(keyframe.depth_m[i]);
      measurement.weight = keyframe.features.weights[i];
      measurement.fits = squared_error(problem, measurement, camera_) < 1e6;  // in front of the camera
      problem.measurements.push_back(measurement);
    }
  }
}

void MultiView::converge(BundleProblem& problem) const {
  BundleOptions adjustment;
  adjustment.iterations = options.iterations;
  for (int round = 0; round < options.rounds; ++round) {
    if (options.adjusts) adjust(problem, camera_, adjustment);
    const std::size_t changes = leave_out_what_deviates(problem);
    if (static_cast<double>(changes) <= options.few_changes * static_cast<double>(problem.measurements.size())) return;
  }
}

/// Those that deviated earlier may come back.
/// @return how many are left out or came back
std::size_t MultiView::leave_out_what_deviates(BundleProblem& problem) const {
  std::size_t changes = 0;
  for (BundleProblem::Measurement& measurement : problem.measurements) {
    const bool fits = squared_error(problem, measurement, camera_) < chi_squared_limit(measurement.depth_m > 0);
    changes += fits != measurement.fits;
    measurement.fits = fits;
  }
  return changes;
}

void MultiView::apply(const BundleProblem& problem, Map& map) const {
  for (const BundleProblem::View& view : problem.views)
    if (!view.is_fixed && map.has(view.keyframe))
      map.keyframe(view.keyframe).camera_from_world = view.camera_from_world;
  for (const BundleProblem::Point& point : problem.points)
    if (map.has_point(point.point)) map.point(point.point).p_world = point.p_world;
  for (const BundleProblem::Measurement& measurement : problem.measurements) {
    if (measurement.fits) continue;
    const PointId id = problem.points[static_cast<std::size_t>(measurement.point)].point;
    if (map.has_point(id))
      map.remove_observation(id, problem.views[static_cast<std::size_t>(measurement.view)].keyframe);
  }
}

}  // namespace examples::slam
