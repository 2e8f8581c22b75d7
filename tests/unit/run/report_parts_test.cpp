// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What the report is made of: pictures that fit, moments that are worth a look, trajectories laid on the reference.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "run/feature_bytes.hpp"
#include "run/moments.hpp"
#include "run/mover_history.hpp"
#include "run/options.hpp"
#include "run/picture_roll.hpp"
#include "run/report_plots.hpp"
#include "run/run_paths.hpp"
#include "run/settings.hpp"

namespace stillpoint_run::report_parts_test {
namespace {

using stillpoint::Camera;
using stillpoint::Pose;
using stillpoint::Status;
using stillpoint::Vector3d;

const Camera kCamera(50.0, 50.0, 31.5, 23.5, 64, 48);

SourceFrame source_frame_at(double timestamp_s) {
  SourceFrame frame;
  frame.timestamp_s = timestamp_s;
  frame.colour = cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90));
  frame.gray = cv::Mat(48, 64, CV_8UC1, cv::Scalar::all(90));
  return frame;
}

FrameRecord record_with(Status status) {
  FrameRecord record;
  record.summary.status = status;
  return record;
}

TEST(Settings, WhatAFileOfOptionsSaysIsNotTheCommandLines) {
  Options options;
  const auto value = [&options](const std::string& name) {
    for (const auto& [setting, text] : settings(options))
      if (setting == name) return text;
    return std::string("is not there");
  };
  options.seed = 7;
  EXPECT_EQ(value("--depth-noise"), "kinect");
  EXPECT_EQ(value("--false-positive-rate"), "0.01");
  EXPECT_EQ(value("--seed"), "7");
  options.stages = "mine.yaml";
  for (const char* name : {"--depth-noise", "--false-positive-rate", "--seed"}) EXPECT_EQ(value(name), "by --options");
  options.given = {"--options", "--seed"};
  EXPECT_EQ(value("--seed"), "7");
  EXPECT_EQ(value("--depth-noise"), "by --options");
  options.policies = "paper";
  EXPECT_EQ(value("--false-positive-rate"), "n/a");
  EXPECT_EQ(value("--paper-as-printed"), "by --options");
}

TEST(PictureRoll, KeepsAllFramesThatFit) {
  PictureRoll roll;
  for (int i = 0; i < 10; ++i) roll.add(source_frame_at(i), record_with(Status::ok), kCamera);
  EXPECT_EQ(roll.pictures().size(), 10u);
  EXPECT_EQ(roll.stride(), 1u);
}

TEST(PictureRoll, GivesUpEverySecondButNoneThatIsNew) {
  PictureRoll one;
  one.add(source_frame_at(0), record_with(Status::ok), kCamera);
  const std::size_t picture = one.pictures().front().bytes(), most = 10 * picture;
  PictureRoll roll(most);
  for (int i = 0; i < 100; ++i)
    roll.add(source_frame_at(i), record_with(i == 33 ? Status::no_consensus : Status::ok), kCamera);
  std::size_t bytes = 0;
  std::vector<std::size_t> frames;
  for (const Picture& kept : roll.pictures()) {
    bytes += kept.bytes();
    frames.push_back(kept.frame);
  }
  EXPECT_LE(bytes, most);
  EXPECT_EQ(roll.stride(), 16u);
  EXPECT_EQ(frames, (std::vector<std::size_t>{0, 16, 32, 33, 34, 48, 64, 80, 96}))
      << "33 is new, and so is 34 after it";
}

TEST(FeatureBytes, AreAsThePageReadsThem) {
  FrameRecord record;
  FeatureRow row{{100.5f, 20.25f}, {}, "inconsistent", -1.5f, 2.34, stillpoint::Mobility::dynamic};
  row.label.verdict = stillpoint::Verdict::dynamic;
  row.label.keep = false;
  row.label.reason = stillpoint::Reason::inconsistent;
  record.rows = {row};
  const auto bytes = feature_bytes(record, {{-3.0f, 1.5f}});
  const std::vector<std::uint8_t> expected = {804 & 255, 804 >> 8, 162, 0, 1, 5, 106, 255, 256 - 6, 3, 234, 0};
  EXPECT_EQ(bytes, expected);
  record.rows[0].reason = "label";
  record.rows[0].score = std::nanf("");
  const auto other = feature_bytes(record, {{std::nanf(""), 0.0f}});
  EXPECT_EQ(other[5], stillpoint::kReasonCount) << "the oracle's";
  EXPECT_EQ(other[6] | other[7] << 8, 0x8000);
  EXPECT_EQ(other[8], 128);
}

TEST(FeatureBytes, HoldLargeImagesFarSurfacesAndVeryNearOnes) {
  FrameRecord record;
  FeatureRow row{{6000.0f, 5000.5f}, {}, "inconsistent", 0.0f, 70.5, stillpoint::Mobility::unknown};
  record.rows = {row, row, row};
  record.rows[1].depth_m = 0.001;
  record.rows[2].depth_m = 0.0;
  const auto bytes = feature_bytes(record, {{0, 0}, {0, 0}, {0, 0}});
  const auto u16 = [&bytes](std::size_t at) { return bytes[at] | bytes[at + 1] << 8; };
  EXPECT_EQ(u16(0), 6000 * 8);
  EXPECT_EQ(u16(2), 5000 * 8 + 4);
  EXPECT_EQ(u16(10), 7050);
  EXPECT_EQ(u16(22), 1) << "0 is no depth";
  EXPECT_EQ(u16(34), 0);
}

/// Ten frames in which the camera goes straight ahead by 1 m/s; unfiltered it bends off to the right from frame 5 on.
RunRecord bent_run(bool has_reference) {
  RunRecord run;
  run.has_backend = true;
  stillpoint::Trajectory truth;
  for (int i = 0; i < 10; ++i) {
    FrameSummary frame;
    frame.timestamp_s = 100.0 + i;
    frame.time_s = i;
    frame.status = i == 0 ? Status::first_frame : Status::ok;
    frame.features = 100;
    frame.kept = i == 7 ? 40 : 90;
    run.frames.push_back(frame);
    Pose pose = Pose::Identity();
    pose.translation() = Vector3d(0.1 * std::sin(i), 0.05 * i * i, i);
    run.filtered.push_back({frame.timestamp_s, pose});
    truth.push_back({frame.timestamp_s, pose});
    pose.translation().x() += i > 5 ? i - 5.0 : 0.0;
    run.unfiltered.push_back({frame.timestamp_s, pose});
  }
  if (has_reference) run.ground_truth = truth;
  return run;
}

TEST(Figures, BothTrajectoriesAreLaidOnTheReferenceAsTheBetterOneFits) {
  const Figures figures = evaluate(bent_run(true));
  EXPECT_NEAR(figures.filtered.drift.translation_m.back(), 0.0, 1e-9);
  EXPECT_NEAR(figures.unfiltered.drift.translation_m.front(), 0.0, 1e-9) << "they start at the same pose";
  EXPECT_NEAR(figures.unfiltered.drift.translation_m.back(), 4.0, 1e-9);
  EXPECT_NEAR(figures.unfiltered.drift.rotation_deg.back(), 0.0, 1e-4);
  EXPECT_LT(*figures.unfiltered.ate_rmse_m, 2.0) << "aligned by itself";
}

TEST(Figures, WithoutReferenceTheyPart) {
  const Figures figures = evaluate(bent_run(false));
  ASSERT_TRUE(figures.divergence_max_m);
  EXPECT_NEAR(*figures.divergence_max_m, 4.0, 1e-9);
  EXPECT_NEAR(*figures.divergence_max_deg, 0.0, 1e-4);
  EXPECT_TRUE(figures.unfiltered.drift.timestamps_s.empty());
}

// A tracker that begins two frames later begins at its own origin.
TEST(Figures, TrajectoriesThatBeginAtOtherFramesPartByTheirDrift) {
  RunRecord run = bent_run(false);
  run.filtered.erase(run.filtered.begin(), run.filtered.begin() + 2);
  const Pose start = run.filtered.front().world_from_camera.inverse();
  for (auto& pose : run.filtered) pose.world_from_camera = start * pose.world_from_camera;
  const Figures figures = evaluate(run);
  ASSERT_TRUE(figures.divergence_max_m);
  EXPECT_NEAR(*figures.divergence_max_m, 4.0, 1e-9);
  EXPECT_NEAR(figures.divergence.translation_m.front(), 0.0, 1e-9);
}

// Frames from 2 s on of a recording whose reference begins at 0 s. Two poses cannot be aligned.
TEST(DrawnPaths, WhatIsNotAlignedBeginsWhereTheRunDoes) {
  RunRecord run = bent_run(true);
  run.frames.erase(run.frames.begin(), run.frames.begin() + 2);
  const Pose second = (*run.ground_truth)[2].world_from_camera;
  run.filtered = {{run.frames[0].timestamp_s, Pose::Identity()}};
  run.unfiltered.clear();
  const stillpoint::Trajectory laid = detail::in_reference(run, run.filtered, {});
  EXPECT_LT((laid.front().world_from_camera.translation() - second.translation()).norm(), 1e-12);
}

std::vector<std::string> reasons_at(const std::vector<Moment>& moments, std::size_t frame) {
  for (const Moment& moment : moments)
    if (moment.frame == frame) return moment.reasons;
  return {};
}

TEST(Moments, AreWhereSomethingHappened) {
  RunRecord run = bent_run(true);
  run.frames[3].status = run.frames[4].status = Status::no_consensus;
  run.frames[8].kept_score = -0.5;
  run.frames[2].kept_score = -1.0;
  run.frames[6].warnings.add(stillpoint::Warning::keep_floor);
  const std::vector<Moment> found = moments(run, evaluate(run));
  EXPECT_EQ(reasons_at(found, 3), std::vector<std::string>{"first of 2 frames with status no_consensus"});
  EXPECT_EQ(reasons_at(found, 6), std::vector<std::string>{"first of 1 frame with warning keep_floor"});
  EXPECT_EQ(reasons_at(found, 7), std::vector<std::string>{"most features dropped: 60 %"});
  ASSERT_EQ(reasons_at(found, 8).size(), 1u);
  EXPECT_NE(reasons_at(found, 8)[0].find("median score -0.50"), std::string::npos);
  EXPECT_EQ(reasons_at(found, 9), std::vector<std::string>{"greatest error without the filter: 4.00 m"});
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LT(found[i - 1].frame, found[i].frame);
}

MoverInFrame mover_in(std::size_t frame, std::uint32_t id, double speed_m_s,
                      stillpoint::MoverState state = stillpoint::MoverState::moving) {
  MoverInFrame seen;
  seen.frame = frame;
  seen.id = id;
  seen.state = state;
  seen.centroid = Vector3d(0, 0, 2);
  seen.speed_m_s = speed_m_s;
  seen.class_name = "unknown";
  return seen;
}

/// Five frames in which the camera goes 1 m to the right each; two movers stay 2 m ahead of it.
RunRecord run_with_movers() {
  RunRecord run;
  for (int i = 0; i < 5; ++i) {
    FrameSummary frame;
    frame.timestamp_s = frame.time_s = i;
    run.frames.push_back(frame);
    Pose world_from_camera = Pose::Identity();
    world_from_camera.translation().x() = i;
    run.filtered.push_back({static_cast<double>(i), world_from_camera});
  }
  run.movers = {mover_in(1, 2, 0.5), mover_in(1, 7, 1.0), mover_in(2, 2, 0.9),
                mover_in(3, 2, 9.0, stillpoint::MoverState::lost), mover_in(4, 2, 0.4)};
  run.movers[2].class_name = "person";
  return run;
}

TEST(MoverHistory, GathersWhatIsKnownOfEach) {
  const RunRecord run = run_with_movers();
  const std::vector<MoverHistory> movers = mover_histories(run);
  ASSERT_EQ(movers.size(), 2u);
  EXPECT_EQ(movers[0].name(), "id 2 (person)");
  EXPECT_EQ(movers[0].first_frame, 1u);
  EXPECT_EQ(movers[0].last_frame, 4u);
  EXPECT_EQ(movers[0].seen_frames, 3u);
  EXPECT_EQ(movers[0].greatest_speed_m_s, 0.9) << "what is predicted counts for nothing";
  EXPECT_EQ(movers[1].name(), "id 7");
  EXPECT_EQ(movers[1].in(2), nullptr);
  const std::vector<MoverHistory> longest = mover_histories(run, 1);
  ASSERT_EQ(longest.size(), 1u);
  EXPECT_EQ(longest[0].id, 2u);
}

TEST(DrawnPaths, MoversAreWhereTheCameraSawThem) {
  RunRecord run = run_with_movers();
  run.map = MapFiles{"", "", {0.0, 3.0}, {{0.0, 3.0}}};
  run.live = run.filtered;
  const DrawnPaths paths = drawn_paths(run, Figures(), mover_histories(run));
  ASSERT_EQ(paths.movers.size(), 2u);
  const DrawnPath& path = paths.movers[0];
  ASSERT_EQ(path.of_frame.size(), 5u);
  EXPECT_FALSE(path.of_frame[0]);
  ASSERT_TRUE(path.of_frame[2]);
  EXPECT_LT((*path.of_frame[2] - Vector3d(2, 2, 0)).norm(), 1e-12) << "to the right, ahead, up";
  EXPECT_FALSE(path.of_frame[3]) << "lost";
  EXPECT_EQ(path.points.size(), 4u);
  EXPECT_FALSE(path.points[2].allFinite()) << "a gap";

  ASSERT_EQ(paths.map.size(), 3u) << "keyframes, loops, the path before them";
  EXPECT_LT((paths.map[0].points[2] - Vector3d(3, 0, 0)).norm(), 1e-12) << "the second keyframe";
  EXPECT_LT((paths.map[1].points[1] - Vector3d(3, 0, 0)).norm(), 1e-12) << "where the loop ends";
  const std::string from_above = figure_of(map_plot(paths, {0, 1})), aside = figure_of(map_plot(paths, {1, 2}));
  EXPECT_NE(from_above.find("loops closed: 1"), std::string::npos);
  EXPECT_EQ(from_above.find("data-path=\"\""), std::string::npos) << "what is not followed has no mark";
  EXPECT_EQ(aside.find("loops closed"), std::string::npos);
  EXPECT_NE(figure_of(movers_map(paths)).find("data-path=\"mover 7\""), std::string::npos);
}

}  // namespace
}  // namespace stillpoint_run::report_parts_test
