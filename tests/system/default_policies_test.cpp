// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The default policies from outside: without boxes, with each of their corrections switched off, at several rates.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <memory>
#include <string>

#include "run/corrections.hpp"
#include "run_program.hpp"
#include "small_sequence.hpp"

namespace system_test {
namespace {

using Json = nlohmann::json;

/// One run of the demo with the defaults, for all tests to compare with.
class DefaultPolicies : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    run("default", "");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// The folder of a run that succeeds.
  static fs::path run(const std::string& name, const std::string& arguments, const std::string& source = "--demo") {
    const fs::path out = *folder_ / name;
    const Outcome outcome =
        run_program(source + " --quiet --backend none --frames 12 --out " + quoted(out) + ' ' + arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << '\n' << outcome.error;
    return out;
  }
  static std::string features(const fs::path& out) { return read_text(out / "features.csv"); }
  static Json report(const fs::path& out) { return Json::parse(read_text(out / "report.json")); }
  static fs::path defaults() { return *folder_ / "default"; }
  /// People before a camera that stands, as a recording.
  static fs::path stationary() {
    const fs::path folder = *folder_ / "stationary";
    stillpoint::synthetic::SceneOptions options;
    options.frames = 12;
    options.width = 320;
    options.height = 240;
    write_scene(folder, stillpoint::synthetic::stationary_camera(options));
    return folder;
  }

 private:
  static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> DefaultPolicies::folder_;

TEST_F(DefaultPolicies, AreTheDefaultAndNeedNoPrior) {
  EXPECT_EQ(report(defaults())["policies"], "default");
  EXPECT_EQ(report(defaults())["prior"], "none");
  EXPECT_GT(report(defaults())["labels"]["recall"], 0.5) << "unknown movers are found";
  EXPECT_LT(report(defaults())["labels"]["false_alarms"], 0.02);
}

TEST_F(DefaultPolicies, AreTheSameBytesTwice) {
  EXPECT_EQ(features(defaults()), features(run("again", "--threads 2")));
}

TEST_F(DefaultPolicies, CorrectionsAreSwitchedOffTogetherInAnyOrder) {
  const std::string both = features(run("both", "--without memory,depth-guard"));
  EXPECT_EQ(both, features(run("in_turn", "--without depth-guard --without memory")));
  EXPECT_NE(both, features(run("one", "--without depth-guard")));
}

TEST_F(DefaultPolicies, EachCorrectionCanBeSwitchedOffAndMatters) {
  for (const auto& correction : stillpoint_run::kCorrections) {
    const std::string name = correction.name;
    std::string more, source = "--demo";
    if (name == "keep-floor") more = " --features 40 --start 60";  // many of them on what moves: some must be left
    if (name == "past-hypothesis") more = " --start 130";          // what moves fills much of the view
    if (name == "stationary-camera") source = "--tum " + quoted(stationary());
    const bool is_as_usual = more.empty() && source == "--demo";
    const fs::path with = is_as_usual ? defaults() : run("with_" + name, more, source);
    const fs::path out = run(name, "--without " + name + more, source);
    EXPECT_TRUE(features(with) != features(out)) << name << " changes nothing";
  }
}

TEST_F(DefaultPolicies, OtherEgoMotionsRun) {
  for (const char* motion : {"rigid", "epipolar"}) {
    const fs::path out = run(motion, std::string("--ego-motion ") + motion);
    EXPECT_NE(read_text(defaults() / "frames.csv"), read_text(out / "frames.csv")) << motion;
  }
}

TEST_F(DefaultPolicies, DropMoreAtAHigherFalsePositiveRate) {
  double last = -1.0;
  for (const char* rate : {"0.0001", "0.01", "0.3"}) {
    const Json labels =
        report(run(std::string("rate_") + rate, std::string("--false-positive-rate ") + rate))["labels"];
    const double dropped = labels["false_alarms"];
    EXPECT_GE(dropped, last) << rate;
    last = dropped;
  }
  EXPECT_GT(last, 0.0);
}

TEST(DefaultPoliciesArguments, WrongValues) {
  expect_error("--demo --false-positive-rate 0",
               {"--false-positive-rate", "found '0'", "expected a number from 0.000001"});
  expect_error("--demo --false-positive-rate 0.6", {"--false-positive-rate", "found '0.6'", "to 0.5"});
  expect_error("--demo --false-positive-rate nan", {"--false-positive-rate", "found 'nan'"});
  expect_error("--demo --false-positive-rate 0.01x", {"--false-positive-rate", "found '0.01x'"});
  expect_error("--demo --without weights", {"--without", "found 'weights'", "whitened, calibrated"});
}

TEST(DefaultPoliciesArguments, ThatContradictEachOther) {
  expect_error("--demo --policies paper --without memory", {"--without", "expected it with --policies default"});
  expect_error("--demo --policies paper --false-positive-rate 0.1", {"--false-positive-rate", "--policies default"});
  expect_error("--demo --paper-as-printed eq3", {"--paper-as-printed", "expected it with --policies paper"});
  expect_error("--demo --without calibrated --false-positive-rate 0.1", {"--false-positive-rate", "calibrated"});
  expect_error("--demo --ego-motion rigid --without past-hypothesis", {"past-hypothesis", "--ego-motion rigid"});
  expect_error("--demo --prior labels --without memory", {"--without", "--prior labels"});
}

}  // namespace
}  // namespace system_test
