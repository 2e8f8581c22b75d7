// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "loop_closing.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "../backends/robust_pose.hpp"
#include "pose_graph.hpp"
#include "semantic_cue.hpp"

namespace examples::slam {

namespace {

constexpr int kFewestShared = 15;  // points that make two keyframes covisible

}  // namespace

/// The most similar first.
std::vector<LoopClosing::Candidate> LoopClosing::by_similarity(const Frame& frame, const Map& map) const {
  std::vector<Candidate> result;
  for (const auto& [id, share] : index.similarity(frame)) {
    if (!map.has(id)) continue;
    const double of_objects =
        options.compares_objects ? semantic_similarity(frame.objects, map.keyframe(id).objects) : 1.0;
    result.push_back({id, share * of_objects});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Candidate& a, const Candidate& b) { return a.similarity > b.similarity; });
  return result;
}

std::optional<Recognised> LoopClosing::recognise(KeyframeId newest, const Map& map) {
  if (!options.closes) return std::nullopt;
  const Keyframe& keyframe = map.keyframe(newest);
  std::map<KeyframeId, int> covisible;
  for (const auto& entry : map.covisible(newest, 1)) covisible.insert(entry);
  double of_neighbours = 0.0;
  std::vector<Candidate> candidates;
  for (const Candidate& candidate : by_similarity(keyframe, map)) {
    const auto shared = covisible.find(candidate.id);
    if (shared != covisible.end() && shared->second >= kFewestShared)
      of_neighbours = std::max(of_neighbours, candidate.similarity);
    else if (newest - candidate.id >= options.fewest_between)
      candidates.push_back(candidate);
  }
  const double least = std::max(options.least_similarity, options.share_of_neighbours * of_neighbours);
  std::optional<Recognised> best;
  double best_similarity = 0.0;
  std::size_t looked_at = 0;
  for (const Candidate& candidate : candidates) {
    if (candidate.similarity < least || looked_at++ == options.candidates) break;
    if (best && candidate.similarity < options.ambiguous * best_similarity) break;
    std::optional<Recognised> recognised = verify(keyframe, candidate.id, map);
    if (!recognised) continue;
    if (!best) {
      best = std::move(recognised);
      best_similarity = candidate.similarity;
      continue;
    }
    // The same place seen from elsewhere gives the same pose. Two places that both fit: nobody knows which.
    constexpr double kSamePlace = 0.2;  // metres plus radians
    if (distance(best->camera_from_world.inverse(), recognised->camera_from_world.inverse()) > kSamePlace)
      return std::nullopt;
    if (recognised->loop.points > best->loop.points) best = std::move(recognised);
  }
  return best;
}

/// A keyframe by a place: the pose by descriptors alone, then by all points of the place; and the keyframe
/// that shares most points with it must agree, which nobody has compared with the place yet.
std::optional<Recognised> LoopClosing::verify(const Keyframe& keyframe, KeyframeId place, const Map& map) {
  constexpr std::size_t kNeighbours = 6;
  const std::optional<Pose> by_appearance = place_pose(keyframe, place, map);
  if (!by_appearance) return std::nullopt;
  const std::vector<PointId> points = map.points_of(map.with_neighbours(place, kFewestShared, kNeighbours));
  Recognised result;
  if (!agrees(keyframe, *by_appearance, points, map, 1.0, result.matches, result.camera_from_world))
    return std::nullopt;
  const auto covisible = map.covisible(keyframe.id, kFewestShared);
  if (covisible.empty()) return std::nullopt;
  const Keyframe& neighbour = map.keyframe(covisible.front().first);
  const Pose neighbour_from_world =
      neighbour.camera_from_world * keyframe.camera_from_world.inverse() * result.camera_from_world;
  std::vector<PointMatch> ignored;
  Pose refined;
  if (!agrees(neighbour, neighbour_from_world, points, map, 0.5, ignored, refined)) return std::nullopt;
  const Vector3d was = keyframe.camera_from_world.inverse().translation();
  result.loop = {keyframe.id,
                 place,
                 (result.camera_from_world.inverse().translation() - was).norm(),
                 result.matches.size(),
                 keyframe.timestamp_s,
                 map.keyframe(place).timestamp_s};
  return result;
}

/// Whether enough of a place's points are seen from a pose, near it.
bool LoopClosing::agrees(const Keyframe& keyframe, const Pose& camera_from_world, span<const PointId> points,
                         const Map& map, double share_of_fewest, std::vector<PointMatch>& matches,
                         Pose& refined) const {
  matches.clear();
  std::vector<PointId> expected;
  options.search(map, points, camera_, camera_from_world, keyframe, matches, &expected);
  std::vector<PointObservation> observations;
  for (const PointMatch& match : matches) {
    const auto i = static_cast<std::size_t>(match.feature);
    const MapPoint& point = map.point(match.point);
    observations.push_back({point.p_world, keyframe.pixel[i], noise_.pixel(keyframe, match.feature),
                            keyframe.depth_m[i], noise_.depth_m(keyframe.depth_m[i]), point.sigma_m(),
                            keyframe.features.weights[i], i});
  }
  refined = camera_from_world;
  std::vector<std::uint8_t> inlier;
  PoseRefinement refine;
  const std::size_t found = refine(observations, camera_, refined, inlier);
  std::vector<PointMatch> right;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (inlier[i] != 0) right.push_back(matches[i]);
  matches = std::move(right);
  const double fewest = share_of_fewest * static_cast<double>(options.fewest_points);
  const double fewest_of_expected = share_of_fewest * options.fewest_share * static_cast<double>(expected.size());
  return static_cast<double>(found) >= fewest && static_cast<double>(found) >= fewest_of_expected;
}

std::optional<Recognised> LoopClosing::relocalise(const Frame& frame, const Map& map) {
  std::size_t looked_at = 0;
  for (const Candidate& candidate : by_similarity(frame, map)) {
    if (candidate.similarity < options.least_similarity || looked_at++ == options.candidates) break;
    if (const std::optional<Pose> pose = place_pose(frame, candidate.id, map))
      return Recognised{{kNone, candidate.id}, *pose, {}};
  }
  return std::nullopt;
}

void LoopClosing::close(const Recognised& recognised, Map& map) const {
  constexpr int kFewestForEdge = 30;
  constexpr double kPointsPerWeight = 100.0;
  PoseGraph graph;
  std::map<KeyframeId, int> node_of;
  for (const auto& [id, keyframe] : map.keyframes()) {
    node_of[id] = static_cast<int>(graph.nodes.size());
    graph.nodes.push_back({id, keyframe.camera_from_world, graph.nodes.empty()});
  }
  const auto add_edge = [&](KeyframeId a, KeyframeId b, const Pose& a_from_b, double points) {
    graph.edges.push_back({node_of.at(a), node_of.at(b), a_from_b, points / kPointsPerWeight});
  };
  const auto pose_of = [&](KeyframeId id) -> const Pose& { return map.keyframe(id).camera_from_world; };
  KeyframeId before = kNone;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (before != kNone) add_edge(id, before, pose_of(id) * pose_of(before).inverse(), kFewestForEdge);
    for (const auto& [other, shared] : map.covisible(id, kFewestForEdge))
      if (other < id) add_edge(id, other, pose_of(id) * pose_of(other).inverse(), shared);
    before = id;
  }
  const KeyframeId newest = recognised.loop.keyframe, place = recognised.loop.place;
  add_edge(newest, place, recognised.camera_from_world * pose_of(place).inverse(),
           static_cast<double>(recognised.loop.points));
  relax(graph);

  // A point goes where the first keyframe that sees it goes.
  std::map<KeyframeId, Pose> new_world_from_old;
  for (const PoseGraph::Node& node : graph.nodes)
    new_world_from_old[node.keyframe] = node.camera_from_world.inverse() * pose_of(node.keyframe);
  for (PointId id = 0; id < map.point_ids(); ++id)
    if (map.has_point(id)) {
      MapPoint& point = map.point(id);
      const Pose& moved = new_world_from_old.at(point.observations.front().keyframe);
      point.p_world = moved * point.p_world;
      point.ray_sigma_m = moved.linear() * point.ray_sigma_m;
      point.normal = moved.linear() * point.normal;
    }
  for (const PoseGraph::Node& node : graph.nodes)
    map.keyframe(node.keyframe).camera_from_world = node.camera_from_world;

  for (const PointMatch& match : recognised.matches) {
    if (!map.has_point(match.point)) continue;
    const PointId named = map.keyframe(newest).point[static_cast<std::size_t>(match.feature)];
    if (named == kNone)
      map.add_observation(match.point, newest, match.feature);
    else
      map.merge(named, match.point);
  }
}

}  // namespace examples::slam
