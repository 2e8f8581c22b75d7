// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Two desks of the same make before walls of the same paper, at both ends of a room: what stands on them tells one
// from the other.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "slam_run.hpp"
#include "stillpoint/null_filter.hpp"
#include "stillpoint/synthetic/room.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace desks_test {
namespace {

namespace synthetic = stillpoint::synthetic;
using stillpoint::Pose, stillpoint::Vector3d;

constexpr double kHalfTurn_rad = 3.14159265358979;
constexpr double kBetween_m = 0.8;  // z of the upright axis about which the one desk is turned into the other

/// Something on a desk that a detector names: where it stands on the first desk, and its class among COCO's.
struct Thing {
  std::int16_t class_index;
  Vector3d p_first;
};
const std::vector<Thing> kOnFirst = {{62, {-0.5, -0.95, 3.0}}, {75, {0.1, -0.90, 2.8}}};
const std::vector<Thing> kOnSecond = {{73, {0.45, -0.95, 3.0}}, {39, {-0.05, -0.90, 2.8}}};

/// Turns what stands at the first desk to the second.
Vector3d turned(const Vector3d& p) { return {-p.x(), p.y(), 2 * kBetween_m - p.z()}; }

/// A desk, what is on every desk of this make, the wall behind it and the mat before it.
std::vector<synthetic::Solid> desk(std::uint64_t seed) {
  const auto paint = [&seed](synthetic::Ground ground, std::vector<synthetic::Bgr> colours, double coverage) {
    synthetic::TextureStyle style;
    style.ground = ground;
    style.colours = std::move(colours);
    style.cell_m = 0.3;
    style.largest_mark_m = 0.4;
    style.coverage = coverage;
    return synthetic::paint(512, 256, style, ++seed);
  };
  const auto paper = paint(synthetic::Ground::stripes, {{206, 198, 184}, {130, 104, 76}, {110, 126, 176}}, 0.12);
  const auto wood = paint(synthetic::Ground::planks, {{70, 110, 160}, {40, 68, 110}, {140, 186, 226}}, 0.14);
  const auto mat = paint(synthetic::Ground::tiles, {{96, 132, 168}, {150, 190, 222}, {30, 44, 64}}, 0.14);
  std::vector<synthetic::Solid> solids;
  solids.emplace_back(synthetic::Shape::cuboid, Vector3d(2.2, 1.34, 0.05), Vector3d(0, -1.34, 3.5), paper);
  solids.emplace_back(synthetic::Shape::cuboid, Vector3d(2.2, 0.01, 1.1), Vector3d(0, -0.01, 2.4), mat);
  synthetic::add_table({0, 0, 2.95}, {0.8, 0.025, 0.42}, 0.74, wood, wood, solids);
  solids.emplace_back(synthetic::Shape::cuboid, Vector3d(0.2, 0.14, 0.1), Vector3d(0.3, -0.88, 3.1), mat, 0.4);
  return solids;
}

synthetic::Solid thing(const Thing& of, std::uint64_t seed) {
  synthetic::TextureStyle style;
  style.colours = {{40, 40, 190}, {60, 150, 60}, {230, 230, 230}};
  return {synthetic::Shape::cuboid, {0.08, 0.1, 0.08}, of.p_first, synthetic::paint(256, 512, style, seed)};
}

constexpr int kFrames = 130, kTurnsFrom = 30, kAtSecond = 50, kTurnsBackFrom = 80, kAtFirst = 100;

/// The camera looks at the first desk, turns to the second, and back.
synthetic::Scene two_desks() {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frame_rate_hz = slam_run::kSlamRate_hz;
  options.frames = kFrames;
  synthetic::Scene scene = synthetic::static_room(options);
  scene.furniture.resize(1);  // the room itself
  std::vector<synthetic::Solid> first = desk(options.seed), second = first;
  for (std::size_t i = 0; i < kOnFirst.size(); ++i) {
    first.push_back(thing(kOnFirst[i], options.seed + 50 + i));
    second.push_back(thing(kOnSecond[i], options.seed + 60 + i));
  }
  for (synthetic::Solid& solid : second) {
    solid.object_from_solid.translation() = turned(solid.object_from_solid.translation());
    solid.object_from_solid.linear() =
        (Eigen::AngleAxisd(kHalfTurn_rad, Vector3d::UnitY()) * solid.object_from_solid.linear()).eval();
  }
  scene.furniture.insert(scene.furniture.end(), first.begin(), first.end());
  scene.furniture.insert(scene.furniture.end(), second.begin(), second.end());
  std::vector<synthetic::Waypoint> keys;
  const auto look = [&](double frame, double aside_m, double half_turns) {
    const Vector3d here(aside_m, -1.35, 1.1);
    const bool at_second = half_turns == 1.0;
    keys.push_back(
        {frame / options.frame_rate_hz, at_second ? turned(here) : here, half_turns * kHalfTurn_rad, -0.2, 0});
  };
  look(0, -0.15, 0);
  look(kTurnsFrom / 2, 0.15, 0);
  look(kTurnsFrom, 0.0, 0);
  look(kAtSecond, 0.0, 1);
  look((kAtSecond + kTurnsBackFrom) / 2, 0.15, 1);
  look(kTurnsBackFrom, 0.0, 1);
  look(kAtFirst, 0.0, 2);
  look((kAtFirst + kFrames) / 2, -0.15, 2);
  look(kFrames, 0.1, 2);
  scene.camera_path = {synthetic::Path(keys, synthetic::Blend::spline), {}};
  return scene;
}

/// What a detector says of a frame.
std::vector<stillpoint::Detection> detections(const stillpoint::Camera& camera, const Pose& world_from_camera) {
  std::vector<stillpoint::Detection> seen;
  const auto look_for = [&](const Thing& of, const Vector3d& p_world) {
    const Vector3d p = world_from_camera.inverse() * p_world;
    if (!(p.z() > 0.3)) return;
    const stillpoint::Vector2d pixel = camera.project(p);
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= camera.width() || pixel.y() >= camera.height()) return;
    const auto side_px = static_cast<float>(0.18 * camera.fx() / p.z());
    stillpoint::Detection detection{
        {static_cast<float>(pixel.x()) - side_px / 2, static_cast<float>(pixel.y()) - side_px / 2, side_px, side_px},
        stillpoint::Mobility::movable};
    detection.class_index = of.class_index;
    seen.push_back(detection);
  };
  for (const Thing& of : kOnFirst) look_for(of, of.p_first);
  for (const Thing& of : kOnSecond) look_for(of, turned(of.p_first));
  return seen;
}

struct Outcome {
  std::vector<double> error_m;  ///< of each frame
  std::vector<examples::slam::Loop> loops;
  std::vector<std::size_t> loop_at;  ///< frames in which they were closed
};

Outcome run(const synthetic::Scene& scene, const std::vector<slam_run::RenderedFrame>& frames, bool uses_objects) {
  examples::slam::SlamOptions options = slam_run::in_step();
  options.uses_objects = uses_objects;
  slam_run::SlamRun run(scene.camera, stillpoint::NullFilter(), options);
  Outcome outcome;
  for (const slam_run::RenderedFrame& frame : frames) {
    run.tracker.backend.expect_detections(detections(scene.camera, frame.world_from_camera));
    outcome.error_m.push_back(run.track(frame));
    outcome.loop_at.resize(run.loops().size(), outcome.error_m.size() - 1);
  }
  outcome.loops = run.loops();
  return outcome;
}

// The camera stands 0.3 m from the axis between the desks, on either side: a keyframe of the second desk that is taken
// for one of the first is off by 0.6 m.
constexpr double kWrong_m = 0.4;

TEST(Desks, WhatStandsOnThemTellsThemApart) {
  const synthetic::Scene scene = two_desks();
  const std::vector<slam_run::RenderedFrame> frames = slam_run::rendered(scene);
  const Outcome found = run(scene, frames, true);
  ASSERT_EQ(found.loops.size(), 1u) << "where the camera comes back to the first desk, and nowhere else";
  EXPECT_GE(found.loop_at[0], static_cast<std::size_t>(kTurnsBackFrom));
  EXPECT_LT(found.loops[0].drift_m, 0.02);
  for (std::size_t i = 0; i < found.error_m.size(); ++i) EXPECT_LT(found.error_m[i], 0.02) << "frame " << i;
}

// Without them the first half of the way is enough: every loop is wrong there.
TEST(Desks, AreTakenForEachOtherWithoutWhatStandsOnThem) {
  const synthetic::Scene scene = two_desks();
  std::vector<slam_run::RenderedFrame> frames = slam_run::rendered(scene);
  frames.resize(kTurnsBackFrom);
  std::size_t wrong = 0;
  for (const examples::slam::Loop& loop : run(scene, frames, false).loops) wrong += loop.drift_m > kWrong_m;
  EXPECT_GE(wrong, 1u);
}

}  // namespace
}  // namespace desks_test
