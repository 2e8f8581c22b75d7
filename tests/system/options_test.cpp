// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Options of the stages from files and into them, and the measuring of a camera's noise.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <string>

#include "run_program.hpp"
#include "small_sequence.hpp"

namespace system_test {
namespace {

using Json = nlohmann::json;

Json report(const fs::path& out) { return Json::parse(read_text(out / "report.json")); }

Outcome demo(const fs::path& out, const std::string& arguments) {
  return run_program("--demo --quiet --backend none --frames 6 --out " + quoted(out) + ' ' + arguments);
}

TEST(StageOptionsOfARun, AreLeftBehindAndRepeatIt) {
  const TemporaryFolder folder;
  const fs::path first = folder / "first", again = folder / "again";
  ASSERT_EQ(demo(first, "--false-positive-rate 0.03 --depth-noise tof --seed 5").status, 0);
  const Outcome outcome = demo(again, "--options " + quoted(first / "options.yaml"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(read_text(again / "options.yaml"), read_text(first / "options.yaml"));
  EXPECT_EQ(read_text(again / "features.csv"), read_text(first / "features.csv"));
  EXPECT_EQ(report(again)["options"], report(first)["options"]);
  EXPECT_EQ(report(again)["options"]["gate"]["false_positive_rate"], 0.03);
  EXPECT_EQ(report(again)["options"]["depth_noise"]["model"], "tof");
  EXPECT_EQ(report(again)["options"]["ego_motion"]["seed"], 5);
  EXPECT_EQ(report(first)["arguments"]["--false-positive-rate"], "0.03");
}

TEST(StageOptionsOfARun, CommandLineGoesBeforeTheFile) {
  const TemporaryFolder folder;
  write_text(folder / "mine.yaml",
             "%YAML:1.0\n---\ngate:\n   false_positive_rate: 0.2\nscorer:\n   depth_sigmas: 0.5\n");
  const std::string file = "--options " + quoted(folder / "mine.yaml");
  ASSERT_EQ(demo(folder / "out", file + " --false-positive-rate 0.04").status, 0);
  EXPECT_EQ(report(folder / "out")["options"]["gate"]["false_positive_rate"], 0.04);
  EXPECT_EQ(report(folder / "out")["options"]["scorer"]["depth_sigmas"], 0.5);
}

TEST(StageOptionsOfARun, OfStagesThatAreSwitchedOffAreTakenToo) {
  const TemporaryFolder folder;
  ASSERT_EQ(demo(folder / "first", "").status, 0);
  const Outcome outcome =
      demo(folder / "out", "--without whitened,area-support --options " + quoted(folder / "first" / "options.yaml"));
  EXPECT_EQ(outcome.status, 0) << outcome.error;
}

TEST(StageOptionsOfARun, OfThePaperAreItsOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(demo(folder / "paper", "--policies paper --paper-as-printed eq8").status, 0);
  EXPECT_EQ(report(folder / "paper")["options"]["scorer"]["printed_eq8"], true);
  const std::string file = "--options " + quoted(folder / "paper" / "options.yaml");
  ASSERT_EQ(demo(folder / "again", "--policies paper " + file).status, 0);
  EXPECT_EQ(report(folder / "again")["options"]["scorer"]["printed_eq8"], true);
  const Outcome outcome = demo(folder / "default", file);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("is unknown, expected one of"), std::string::npos) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "default" / "report.json"));
}

TEST(StageOptionsOfARun, OracleHasNone) {
  const TemporaryFolder folder;
  ASSERT_EQ(demo(folder / "out", "--prior labels").status, 0);
  EXPECT_TRUE(report(folder / "out")["options"].is_null());
  EXPECT_FALSE(fs::exists(folder / "out" / "options.yaml"));
  EXPECT_EQ(demo(folder / "out", "--prior labels --options any.yaml").status, 2);
}

TEST(StageOptionsOfARun, FileThatIsWrongIsOneLine) {
  const TemporaryFolder folder;
  write_text(folder / "mine.yaml", "%YAML:1.0\n---\ngate:\n   rate: 0.2\n");
  const Outcome outcome = demo(folder / "out", "--options " + quoted(folder / "mine.yaml"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("mine.yaml:4: gate.rate is unknown, expected one of false_positive_rate"),
            std::string::npos)
      << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "out" / "report.json"));
}

TEST(StageOptionsOfARun, EachOptionThatIsGoneIsALine) {
  const TemporaryFolder folder;
  write_text(folder / "old.yaml", "%YAML:1.0\n---\ngate:\n   decay: 0.8\nmemory:\n   persistence: 0.7\n");
  const Outcome outcome = demo(folder / "out", "--options " + quoted(folder / "old.yaml"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("old.yaml: 2 options are gone; delete or rename\n  gate.decay: fixed at 0.8"),
            std::string::npos)
      << outcome.error;
  EXPECT_NE(outcome.error.find("\n  memory.persistence: memory.log_odds_decay_s\n"), std::string::npos)
      << outcome.error;
}

// The renderer's sensor is a Kinect by KinectNoise, in steps of its factor: 0.2 mm.
TEST(Calibration, MeasuresTheNoiseOfTheRenderedSensor) {
  const TemporaryFolder folder;
  stillpoint::synthetic::SceneOptions options;
  options.frames = 45;
  options.width = 320;
  options.height = 240;
  write_scene(folder / "room", stillpoint::synthetic::static_room(options));
  const Outcome measured =
      run_program("--tum " + quoted(folder / "room") + " --calibrate --quiet --out " + quoted(folder / "out"));
  ASSERT_EQ(measured.status, 0) << measured.error;
  EXPECT_NE(measured.out.find("Best model: "), std::string::npos) << measured.out;
  EXPECT_FALSE(fs::exists(folder / "out" / "report.json")) << "it is no run";
  const Outcome outcome = run_program("--tum " + quoted(folder / "room") + " --frames 4 --quiet --options " +
                                      quoted(folder / "out" / "options.yaml") + " --out " + quoted(folder / "run"));
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const Json noise = report(folder / "run")["options"]["depth_noise"];
  ASSERT_EQ(noise["model"], "kinect") << noise << measured.out;
  EXPECT_NEAR(noise["scale"].get<double>(), 1.0, 0.25) << measured.out;
}

TEST(Calibration, RefusesAScene) {
  const TemporaryFolder folder;
  const Outcome moving =
      run_program("--demo --calibrate --quiet --start 60 --frames 40 --out " + quoted(folder / "out"));
  EXPECT_EQ(moving.status, 2);
  EXPECT_NE(moving.error.find("of the features to move, expected a scene in which nothing does"), std::string::npos)
      << moving.error;
  const Outcome few = run_program("--demo --calibrate --quiet --frames 5 --out " + quoted(folder / "out"));
  EXPECT_EQ(few.status, 2);
  EXPECT_NE(few.error.find("--calibrate: found a motion in 4 frames, expected 30 or more"), std::string::npos)
      << few.error;
  EXPECT_FALSE(fs::exists(folder / "out" / "options.yaml"));
  const Outcome tracker = run_program("--demo --calibrate --backend odometry --out " + quoted(folder / "out"));
  EXPECT_EQ(tracker.status, 2);
  EXPECT_NE(tracker.error.find("--backend: found with --calibrate"), std::string::npos) << tracker.error;
}

}  // namespace
}  // namespace system_test
