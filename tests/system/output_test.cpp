// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What a run leaves behind: all files, their columns and keys, the same bytes twice.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "run_program.hpp"

namespace system_test::output_test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kFiles = {"features.csv", "frames.csv",  "movers.csv",     "options.yaml",
                                         "report.html",  "report.json", "trajectory.txt", "trajectory_unfiltered.txt"};
constexpr int kFrames = 8;

void expect_features_file(const fs::path& file, std::size_t frame_count) {
  const auto rows = read_csv(file);
  ASSERT_GT(rows.size(), 1u);
  EXPECT_EQ(rows[0], split("timestamp,x,y,keep,verdict,reason,score,cluster,depth,prior", ','));
  const std::set<std::string> verdicts = {"kept", "dynamic", "unknown"};
  const std::set<std::string> priors = {"unknown", "static", "movable", "dynamic"};
  std::set<std::string> times;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    ASSERT_EQ(row.size(), 10u) << "row " << i;
    times.insert(row[0]);
    const double x = std::stod(row[1]), y = std::stod(row[2]), depth_m = std::stod(row[8]);
    EXPECT_TRUE(x >= 0 && x < 640 && y >= 0 && y < 480) << "row " << i;
    EXPECT_TRUE(row[3] == "0" || row[3] == "1") << "row " << i;
    EXPECT_TRUE(verdicts.count(row[4]) == 1) << row[4];
    EXPECT_FALSE(row[5].empty());
    EXPECT_TRUE(row[6] == "nan" || std::isfinite(std::stod(row[6]))) << row[6];
    EXPECT_GE(std::stoi(row[7]), -1);
    EXPECT_TRUE(depth_m >= 0 && depth_m < 20) << "row " << i;
    EXPECT_TRUE(priors.count(row[9]) == 1) << row[9];
  }
  EXPECT_EQ(times.size(), frame_count) << "every frame has rows";
}

/// The counts of frames.csv are those of features.csv.
void expect_counts_agree(const fs::path& folder) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> counted;
  const auto features = read_csv(folder / "features.csv");
  for (std::size_t i = 1; i < features.size(); ++i) {
    ++counted[features[i][0]].first;
    counted[features[i][0]].second += features[i][3] == "1" ? 1 : 0;
  }
  const auto frames = read_csv(folder / "frames.csv");
  ASSERT_GT(frames.size(), 1u);
  EXPECT_EQ(
      frames[0],
      split("timestamp,status,reference_timestamp,tx,ty,tz,qx,qy,qz,qw,features,kept,keep_floor_kept,warnings", ','));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    ASSERT_EQ(frames[i].size(), 14u) << "row " << i;
    EXPECT_EQ(std::stoul(frames[i][10]), counted[frames[i][0]].first) << "row " << i;
    EXPECT_EQ(std::stoul(frames[i][11]), counted[frames[i][0]].second) << "row " << i;
  }
}

void expect_trajectory_file(const fs::path& file, std::size_t frame_count) {
  const auto lines = split(read_text(file), '\n');
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], "# timestamp tx ty tz qx qy qz qw");
  ASSERT_LE(lines.size(), frame_count + 1);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto columns = split(lines[i], ' ');
    ASSERT_EQ(columns.size(), 8u) << lines[i];
    double squared = 0;
    for (std::size_t k = 4; k < 8; ++k) squared += std::stod(columns[k]) * std::stod(columns[k]);
    EXPECT_NEAR(squared, 1.0, 1e-6) << "nine decimals of a unit quaternion: " << lines[i];
    if (i > 1) continue;
    for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(std::stod(columns[k]), 0.0) << "the first camera is the world";
  }
}

void expect_null_or_number(const Json& parent, const char* key) {
  ASSERT_TRUE(parent.contains(key)) << key;
  EXPECT_TRUE(parent[key].is_null() || parent[key].is_number()) << key;
}

void expect_report(const Json& report, int frame_count) {
  const std::set<std::string> keys = {"version",
                                      "sequence",
                                      "policies",
                                      "prior",
                                      "detector",
                                      "frames",
                                      "missing_files",
                                      "images_without_depth",
                                      "interrupted",
                                      "assumptions",
                                      "features_per_frame",
                                      "kept_share",
                                      "statuses",
                                      "warnings",
                                      "timing_ms",
                                      "ate_rmse_m",
                                      "rpe",
                                      "ate_rmse_unfiltered_m",
                                      "labels",
                                      "frames_without_pose",
                                      "improvement_percent",
                                      "divergence",
                                      "arguments",
                                      "options"};
  std::set<std::string> found;
  for (const auto& [key, value] : report.items()) found.insert(key);
  ASSERT_EQ(found, keys);
  for (const char* key : {"version", "sequence", "policies", "prior"}) EXPECT_TRUE(report[key].is_string()) << key;
  EXPECT_EQ(report["frames"], frame_count);
  for (const char* key : {"features_per_frame", "kept_share", "ate_rmse_m", "ate_rmse_unfiltered_m",
                          "frames_without_pose", "improvement_percent"})
    expect_null_or_number(report, key);
  EXPECT_GE(report["kept_share"], 0.0);
  EXPECT_LE(report["kept_share"], 1.0);
  int statuses = 0;
  for (const auto& [status, count] : report["statuses"].items()) statuses += count.get<int>();
  EXPECT_EQ(statuses, frame_count);
  for (const char* stage : {"prior", "match", "motion", "score", "gate", "classify", "memory", "verdict", "movers"}) {
    ASSERT_TRUE(report["timing_ms"].contains(stage)) << stage;
    for (const char* key : {"median", "p95", "max"}) expect_null_or_number(report["timing_ms"][stage], key);
  }
  for (const char* key : {"recall", "false_alarms", "moving", "background", "parked_dropped"})
    expect_null_or_number(report["labels"], key);
  for (const char* key : {"translation_max_m", "rotation_max_deg"}) expect_null_or_number(report["divergence"], key);
  for (const char* delta : {"frame", "second"}) {
    ASSERT_TRUE(report["rpe"].contains(delta));
    for (const auto& [key, value] : report["rpe"][delta].items())
      expect_null_or_number(report["rpe"][delta], key.c_str());
  }
}

/// The page without its pictures, whose base64 may spell any word.
std::string without_pictures(std::string page) {
  for (std::size_t begin = 0; (begin = page.find("base64,", begin)) != std::string::npos;) {
    begin += 7;
    page.erase(begin, page.find('"', begin) - begin);
  }
  return page;
}

void expect_page(const std::string& page) {
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_NE(page.find("data:image/jpeg;base64,"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
  const std::string text = without_pictures(page);
  for (const char* from_elsewhere : {"http://", "https://", " src=\"", "<link", "@import", "url(", "fetch("})
    EXPECT_EQ(text.find(from_elsewhere), std::string::npos) << from_elsewhere;
  EXPECT_EQ(text.find("nan"), std::string::npos) << "a figure that can't be had is n/a, a line has a gap";
}

void expect_everything(const fs::path& folder, int frame_count) {
  const auto count = static_cast<std::size_t>(frame_count);
  const Json report = Json::parse(read_text(folder / "report.json"));
  std::vector<std::string> files = kFiles;
  if (report["options"].is_null()) files.erase(std::find(files.begin(), files.end(), "options.yaml"));  // an oracle's
  EXPECT_EQ(files_in(folder), files);
  expect_features_file(folder / "features.csv", count);
  expect_counts_agree(folder);
  expect_trajectory_file(folder / "trajectory.txt", count);
  expect_trajectory_file(folder / "trajectory_unfiltered.txt", count);
  expect_report(report, frame_count);
  expect_page(read_text(folder / "report.html"));
}

/// One run of the demo for all tests that look at it.
class Demo : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    outcome_ = run_program("--demo --frames " + std::to_string(kFrames) + " --out " + quoted(out()));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static fs::path out() { return *folder_ / "out"; }
  static Json report() { return Json::parse(read_text(out() / "report.json")); }

  static std::unique_ptr<TemporaryFolder> folder_;
  static Outcome outcome_;
};
std::unique_ptr<TemporaryFolder> Demo::folder_;
Outcome Demo::outcome_;

TEST_F(Demo, WritesEverything) {
  ASSERT_EQ(outcome_.status, 0) << outcome_.error;
  expect_everything(out(), kFrames);
}

TEST_F(Demo, SaysWhatHappenedAndWhereTheReportIs) {
  EXPECT_NE(outcome_.out.find("Filtered 8 frames of demo"), std::string::npos) << outcome_.out;
  EXPECT_NE(outcome_.out.find((out() / "report.html").string()), std::string::npos) << outcome_.out;
  EXPECT_NE(outcome_.error.find("frames/s"), std::string::npos) << "progress: " << outcome_.error;
  EXPECT_EQ(outcome_.error.find('\r'), std::string::npos) << "standard error is no terminal here";
}

TEST_F(Demo, HasLabelsOfItsOwn) {
  const Json labels = report()["labels"];
  EXPECT_GT(labels["moving"], 0);
  EXPECT_GT(labels["background"], 0);
  EXPECT_TRUE(labels["recall"].is_number());
}

TEST_F(Demo, IsTheSameBytesTwice) {
  const TemporaryFolder other;
  const Outcome outcome =
      run_program("--demo --quiet --threads 2 --frames " + std::to_string(kFrames) + " --out " + quoted(other / "out"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(outcome.error, "") << "quiet";
  for (const char* name : {"features.csv", "frames.csv", "movers.csv", "trajectory.txt", "trajectory_unfiltered.txt"})
    EXPECT_EQ(read_text(out() / name), read_text(other / "out" / name)) << name;
}

TEST_F(Demo, WritesWhereMoversAreUnlessToldNotTo) {
  const auto rows = read_csv(out() / "movers.csv");
  ASSERT_GT(rows.size(), 1u) << "who walks is found within 8 frames";
  EXPECT_EQ(rows[0], split("timestamp,id,state,x,y,z,vx,vy,vz,features,class", ','));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 11u) << "row " << i;
    EXPECT_GE(std::stoi(rows[i][1]), 1);
    EXPECT_TRUE(rows[i][2] == "moving" || rows[i][2] == "parked" || rows[i][2] == "lost") << rows[i][2];
    EXPECT_TRUE(std::stod(rows[i][5]) > 0.5 && std::stod(rows[i][5]) < 4) << rows[i][5];
    EXPECT_EQ(rows[i][10], "unknown") << "no detector";
  }
  const TemporaryFolder other;
  ASSERT_EQ(
      run_program("--demo --quiet --no-movers --frames " + std::to_string(kFrames) + " --out " + quoted(other / "out"))
          .status,
      0);
  EXPECT_FALSE(fs::exists(other / "out" / "movers.csv"));
  EXPECT_EQ(read_text(other / "out" / "features.csv"), read_text(out() / "features.csv")) << "verdicts are the same";
}

TEST(DemoChoices, FilesOfTheRunBeforeAreReplacedOrRemovedTogether) {
  const TemporaryFolder other;
  const std::string demo = "--demo --quiet --backend none --out " + quoted(other / "out");
  ASSERT_EQ(run_program(demo + " --frames 3").status, 0);
  // Where the last file can't be made, none is replaced.
  const std::string frames = read_text(other / "out" / "frames.csv");
  fs::remove(other / "out" / "report.html");
  fs::create_directory(other / "out" / "report.html");
  EXPECT_EQ(run_program(demo + " --frames 5").status, 2);
  EXPECT_EQ(read_text(other / "out" / "frames.csv"), frames);
  EXPECT_TRUE(fs::exists(other / "out" / "movers.csv"));
  fs::remove(other / "out" / "report.html");
  // What this run does not write is not left of another one; what is no result stays.
  write_text(other / "out" / "notes.txt", "mine");
  ASSERT_EQ(run_program(demo + " --frames 5 --no-movers").status, 0);
  EXPECT_EQ(read_csv(other / "out" / "frames.csv").size(), 6u);
  EXPECT_FALSE(fs::exists(other / "out" / "movers.csv"));
  EXPECT_TRUE(fs::exists(other / "out" / "options.yaml"));
  ASSERT_EQ(run_program(demo + " --frames 2 --prior labels").status, 0);
  EXPECT_FALSE(fs::exists(other / "out" / "options.yaml")) << "an oracle has none";
  EXPECT_EQ(read_text(other / "out" / "notes.txt"), "mine");
}

TEST(DemoChoices, OracleDropsAllThatMoves) {
  const TemporaryFolder other;
  ASSERT_EQ(run_program("--demo --quiet --prior labels --frames 4 --out " + quoted(other / "out")).status, 0);
  expect_everything(other / "out", 4);
  const Json labels = Json::parse(read_text(other / "out" / "report.json"))["labels"];
  EXPECT_EQ(labels["recall"], 1.0);
  EXPECT_EQ(labels["false_alarms"], 0.0);
}

TEST(DemoChoices, WithoutABackendThereIsNoTrajectory) {
  const TemporaryFolder other;
  const Outcome outcome = run_program("--demo --quiet --backend none --frames 4 --out " + quoted(other / "out"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("No tracker ran"), std::string::npos) << outcome.out;
  expect_everything(other / "out", 4);
  const Json none = Json::parse(read_text(other / "out" / "report.json"));
  EXPECT_TRUE(none["ate_rmse_m"].is_null());
  EXPECT_TRUE(none["frames_without_pose"].is_null());
  EXPECT_EQ(split(read_text(other / "out" / "trajectory.txt"), '\n').size(), 1u) << "the header";
}

TEST_F(Demo, StartsWhereItIsTold) {
  const TemporaryFolder other;
  ASSERT_EQ(run_program("--demo --quiet --start 2 --frames 2 --out " + quoted(other / "out")).status, 0);
  const auto part = read_csv(other / "out" / "frames.csv"), all = read_csv(out() / "frames.csv");
  ASSERT_EQ(part.size(), 3u);
  EXPECT_EQ(part[1][0], all[3][0]);
  EXPECT_EQ(part[1][1], "first_frame");
}

// Each choice is used, not only taken: no two runs write the same figures of features and options.
TEST(DemoChoices, EveryChoiceCounts) {
  const TemporaryFolder other;
  std::map<std::string, std::string> choice_of;
  for (const char* choice :
       {"", "--ego-motion rigid", "--ego-motion epipolar", "--policies paper", "--policies paper --ego-motion rigid",
        "--policies paper --paper-as-printed eq3,eq8,unit-t", "--prior boxes", "--depth-noise stereo",
        "--depth-noise tof", "--features 50"}) {
    const Outcome outcome =
        run_program(std::string("--demo --quiet --frames 2 --out ") + quoted(other / "out") + ' ' + choice);
    ASSERT_EQ(outcome.status, 0) << choice << '\n' << outcome.error;
    const Json report = Json::parse(read_text(other / "out" / "report.json"));
    const auto [first, is_new] =
        choice_of.emplace(read_text(other / "out" / "features.csv") + report["options"].dump(), choice);
    EXPECT_TRUE(is_new) << "'" << choice << "' does what '" << first->second << "' does";
  }
}

/// In which of the first five frames the filter had a box; the person of the demo fills a good part of it.
std::vector<bool> frames_with_boxes(const std::string& choice) {
  const TemporaryFolder other;
  const Outcome outcome = run_program("--demo --quiet --backend none --frames 5 --prior boxes --out " +
                                      quoted(other / "out") + ' ' + choice);
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  const auto rows = read_csv(other / "out" / "features.csv");
  std::map<std::string, bool> has_box;
  for (std::size_t i = 1; i < rows.size(); ++i) has_box[rows[i][0]] = has_box[rows[i][0]] || rows[i][9] == "dynamic";
  std::vector<bool> found;
  for (const auto& frame : has_box) found.push_back(frame.second);
  return found;
}

// Their figures are in docs/trackers.md; here they run: a header and a pose for each of the three frames.
TEST(DemoChoices, EveryTrackerRuns) {
  const TemporaryFolder folder;
  for (const std::string backend : {"klt", "orb"}) {
    const fs::path out = folder / backend;
    const Outcome outcome =
        run_program("--demo --quiet --prior labels --frames 3 --out " + quoted(out) + " --backend " + backend);
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_EQ(split(read_text(out / "trajectory.txt"), '\n').size(), 4u) << backend;
    EXPECT_EQ(split(read_text(out / "trajectory_unfiltered.txt"), '\n').size(), 4u) << backend;
  }
}

TEST(DemoChoices, TheSlamLeavesItsMap) {
#ifndef STILLPOINT_RUN_HAS_SLAM
  GTEST_SKIP() << "stillpoint_run was built without Ceres (Debian: libceres-dev), so it has no --backend slam";
#endif
  const TemporaryFolder folder;
  const auto run = [&](const fs::path& out, const std::string& more) {
    return run_program("--demo --quiet --backend slam --mapping-in-step --frames 30 --out " + quoted(out) + more);
  };
  const fs::path out = folder / "out", again = folder / "again", plain = folder / "plain", few = folder / "few";
  const Outcome outcome = run(out, "");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  for (const char* name : {"trajectory.txt", "trajectory_live.txt"})
    EXPECT_EQ(split(read_text(out / name), '\n').size(), 31u) << name << ": a header and a pose for each frame";
  EXPECT_EQ(read_text(out / "map.ply").rfind("ply\nformat ascii 1.0\n", 0), 0u);
  EXPECT_FALSE(fs::exists(out / "map_before_loop.ply")) << "no loop in a second";
  ASSERT_EQ(run(again, "").status, 0);
  for (const char* name : {"map.ply", "trajectory.txt"})
    EXPECT_EQ(read_text(out / name), read_text(again / name)) << "in step: the same bytes";
  ASSERT_EQ(run(plain, " --slam-without multi-view,bundle,loops,semantics").status, 0);
  EXPECT_NE(read_text(out / "map.ply"), read_text(plain / "map.ply")) << "what is left out was used";
  ASSERT_EQ(run(few, " --features 90").status, 0);
  EXPECT_EQ(split(read_text(few / "trajectory.txt"), '\n').size(), 31u) << "90 features begin a map, too";
}

TEST(DemoChoices, ADetectorMayBeSlowOrMiss) {
  EXPECT_EQ(frames_with_boxes(""), std::vector<bool>(5, true));
  EXPECT_EQ(frames_with_boxes("--detect-every 3"), std::vector<bool>(5, true)) << "carried";
  EXPECT_EQ(frames_with_boxes("--policies paper --detect-every 3"), std::vector<bool>(5, true)) << "held";
  EXPECT_EQ(frames_with_boxes("--drop-boxes 1"), std::vector<bool>(5, false));
}

TEST(DemoChoices, OneFrameIsEnough) {
  const TemporaryFolder other;
  ASSERT_EQ(run_program("--demo --quiet --frames 1 --out " + quoted(other / "out")).status, 0);
  expect_everything(other / "out", 1);
  EXPECT_TRUE(Json::parse(read_text(other / "out" / "report.json"))["ate_rmse_m"].is_null());
}

// Its decoding is OpenCV's matter; that there are as many frames as in the run is ours.
TEST(DemoChoices, AVideoIsWholeOrNotThere) {
  const TemporaryFolder folder;
  for (const char* name : {"video.avi", "video.mp4"}) {
    const fs::path file = folder / name;
    const Outcome outcome =
        run_program("--demo --quiet --frames 3 --out " + quoted(folder / "out") + " --save-video " + quoted(file));
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("Video: " + file.string()), std::string::npos) << outcome.out;
    cv::VideoCapture video(file.string());
    cv::Mat frame;
    int frames = 0;
    while (video.read(frame)) ++frames;
    EXPECT_EQ(frames, 3) << name;
  }
  expect_error("--demo --frames 2 --quiet --out " + quoted(folder / "out") + " --save-video " +
                   quoted(folder / "none" / "video.mp4"),
               {"--save-video", "expected a folder that is there"});
  fs::create_directory(folder / "folder.avi");
  expect_error(
      "--demo --frames 2 --quiet --out " + quoted(folder / "out") + " --save-video " + quoted(folder / "folder.avi"),
      {"--save-video", "which is a folder", "expected a file to write"});
  fs::remove(folder / "folder.avi");
  expect_error("--demo --save-video video.gif", {"--save-video", "found 'video.gif'", "ends in .mp4 or .avi"});
  EXPECT_EQ(files_in(folder / ""), (std::vector<std::string>{"out", "video.avi", "video.mp4"})) << "nothing partial";
}

// A limit on the size of files fails writes as a full disk does.
TEST(DemoChoices, AVideoThatBreaksOffIsNoVideo) {
  const std::string limit = "ulimit -f 400; trap '' XFSZ; ";  // blocks of 512 bytes: 200 kB
  for (const char* name : {"video.avi", "video.mp4"}) {
    const TemporaryFolder folder;
    expect_error("--demo --quiet --frames 10 --features 50 --out " + quoted(folder / "out") + " --save-video " +
                     quoted(folder / name),
                 {(folder / name).string() + ": cannot write the video: found ", "expected the 10 that were written"},
                 limit);
    EXPECT_EQ(files_in(folder / ""), (std::vector<std::string>{"out"})) << "nothing partial";
    EXPECT_EQ(files_in(folder / "out"), std::vector<std::string>{});
  }
}

TEST(DemoChoices, AMissingEncoderIsSaid) {
  const TemporaryFolder folder;
  ASSERT_EQ(setenv("OPENCV_VIDEOIO_PRIORITY_FFMPEG", "0", 1), 0);
  ASSERT_EQ(setenv("OPENCV_VIDEOIO_PRIORITY_GSTREAMER", "0", 1), 0);
  expect_error(
      "--demo --frames 2 --quiet --out " + quoted(folder / "out") + " --save-video " + quoted(folder / "video.mp4"),
      {"--save-video", "no encoder for MPEG-4", "ends in .avi"});
  unsetenv("OPENCV_VIDEOIO_PRIORITY_FFMPEG");
  unsetenv("OPENCV_VIDEOIO_PRIORITY_GSTREAMER");
}

TEST(RecordedSequences, RunWithTheirBoxes) {
#ifndef STILLPOINT_SHARED_DATA
  GTEST_SKIP() << "no recorded sequences: STILLPOINT_SHARED_DATA is not set";
#else
  const fs::path data = STILLPOINT_SHARED_DATA;
  if (!fs::is_directory(data / "kitchen_walk")) GTEST_SKIP() << "no recorded sequences in " << data;
  for (const char* name : {"kitchen_static", "kitchen_walk", "kitchen_box"}) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program("--quiet --prior boxes --start 60 --frames 5 --tum " + quoted(data / name) +
                                        " --out " + quoted(folder / "out"));
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    expect_everything(folder / "out", 5);
    const Json report = Json::parse(read_text(folder / "out" / "report.json"));
    EXPECT_EQ(report["sequence"], name);
    EXPECT_GT(report["labels"]["background"], 0);
    EXPECT_EQ(report["labels"]["recall"].is_null(), report["labels"]["moving"] == 0) << name;
  }
#endif
}

}  // namespace
}  // namespace system_test::output_test
