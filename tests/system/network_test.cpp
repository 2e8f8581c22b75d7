// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// --prior MODEL from outside: waited for and in a thread, one that sees nothing, one that can't be read.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

#include "made_network.hpp"
#include "run_program.hpp"
#include "small_sequence.hpp"

namespace system_test::network_test {
namespace {

using Json = nlohmann::json;

constexpr int kFrames = 6;
constexpr float kSure = 8.0f, kNothing = -8.0f;  // objectness 0.9997, 0.0003

/// A small folder and two made networks: one that sees people everywhere, one that sees nobody.
class NetworkPrior : public testing::Test {
 protected:
  void SetUp() override {
#ifndef STILLPOINT_RUN_TAKES_NETWORKS
    GTEST_SKIP() << "stillpoint_run was built without OpenCV's dnn module";
#endif
    write_small_sequence(folder / "sequence", kFrames);
    people = write_network(folder / "networks", "people", kSure);
    nobody = write_network(folder / "networks", "nobody", kNothing);
  }

  std::string arguments(const std::string& name, const std::string& more) const {
    return "--quiet --backend none --tum " + quoted(folder / "sequence") + " --out " + quoted(folder / name) + ' ' +
           more;
  }
  std::string prior(const fs::path& network) const { return "--prior " + quoted(network) + " --classes person "; }

  /// The folder of a run that succeeds.
  fs::path run(const std::string& name, const std::string& more) const {
    const Outcome outcome = run_program(arguments(name, more));
    EXPECT_EQ(outcome.status, 0) << more << '\n' << outcome.error;
    EXPECT_EQ(outcome.error, "") << more;
    return folder / name;
  }
  static Json detector(const fs::path& out) { return Json::parse(read_text(out / "report.json"))["detector"]; }

  TemporaryFolder folder;
  fs::path people, nobody;
};

/// How many frames have a feature in a region of people.
int frames_with_people(const fs::path& out) {
  const auto rows = read_csv(out / "features.csv");
  std::map<std::string, bool> frames;
  for (std::size_t i = 1; i < rows.size(); ++i) frames[rows[i][0]] |= rows[i][9] == "dynamic";
  int count = 0;
  for (const auto& frame : frames) count += frame.second ? 1 : 0;
  return count;
}

/// Where every offered frame has gone.
void expect_complete(const Json& frames, int offered) {
  EXPECT_EQ(frames["offered"], offered);
  EXPECT_EQ(frames["skipped"].get<int>() + frames["replaced"].get<int>() + frames["detected"].get<int>() +
                frames["failed"].get<int>(),
            offered);
}

TEST_F(NetworkPrior, IsTheSameBytesTwiceWhereItIsWaitedFor) {
  const fs::path once = run("once", prior(people) + "--detect-every 2 --sync");
  const fs::path again = run("again", prior(people) + "--detect-every 2 --sync --threads 2");
  for (const char* name : {"features.csv", "frames.csv"})
    EXPECT_EQ(read_text(once / name), read_text(again / name)) << name;
  EXPECT_EQ(frames_with_people(once), kFrames) << "carried between two answers";
}

TEST_F(NetworkPrior, ReportSaysWhichAndWhatItDid) {
  const fs::path out = run("out", prior(people) + "--detect-every 2 --sync");
  EXPECT_EQ(Json::parse(read_text(out / "report.json"))["prior"], "people.cfg");
  const Json report = detector(out);
  EXPECT_EQ(report["layout"], "darknet");
  EXPECT_EQ(report["input_width"], 96);
  EXPECT_EQ(report["input_height"], 64);
  expect_complete(report["frames"], kFrames);
  EXPECT_EQ(report["frames"]["detected"], kFrames / 2);
  EXPECT_EQ(report["frames"]["failed"], 0);
  EXPECT_GT(report["timing_ms"]["median"], 0.0);
  EXPECT_GE(report["timing_ms"]["p95"], report["timing_ms"]["median"]);
  EXPECT_TRUE(report["last_error"].is_null());
  const std::string page = read_text(out / "report.html");
  EXPECT_NE(page.find("people.cfg (darknet, 96 x 64) answered on 3 of 6 frames"), std::string::npos);
  EXPECT_NE(page.find("frames offered"), std::string::npos);
}

TEST_F(NetworkPrior, InAThreadOfItsOwnEndsAndCountsItsAnswers) {
  for (const char* policies : {"default", "paper"}) {
    const std::string more = prior(people) + "--policies " + policies;
    const Outcome outcome = run_program(arguments(policies, more));
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("people.cfg (darknet, 96 x 64) answered on "), std::string::npos) << outcome.out;
    const Json frames = detector(folder / policies)["frames"];
    expect_complete(frames, kFrames);
    EXPECT_GE(frames["detected"], 1) << "the last frame is not replaced, and waited for";
    EXPECT_EQ(frames["failed"], 0);
  }
}

TEST_F(NetworkPrior, HoldsItsLastAnswerForThePapersPolicies) {
  EXPECT_EQ(frames_with_people(run("out", prior(people) + "--policies paper --detect-every 4 --sync")), kFrames);
}

TEST_F(NetworkPrior, ThatSeesNothingChangesNothing) {
  const fs::path out = run("out", prior(nobody) + "--sync");
  EXPECT_EQ(read_text(out / "features.csv"), read_text(run("none", "--prior none") / "features.csv"));
  EXPECT_EQ(detector(out)["frames"]["detected"], kFrames) << "nothing is an answer";
  EXPECT_EQ(detector(folder / "none"), Json(nullptr));
}

TEST_F(NetworkPrior, LayoutMayBeSaid) {
  EXPECT_EQ(detector(run("out", prior(people) + "--detector-layout darknet --sync"))["layout"], "darknet");
  expect_error(arguments("out", prior(people) + "--detector-layout ssd"),
               {"people.cfg", "layout ssd", "expected 1x1xKx7"});
  expect_error(arguments("out", prior(people) + "--detector-layout yolov99"),
               {"--detector-layout", "found 'yolov99'", "expected automatic or one of", "yolox", "label-map"});
}

TEST_F(NetworkPrior, ThatCannotBeRead) {
  write_text(folder / "broken.onnx", "this is no network");
  expect_error(arguments("out", "--prior " + quoted(folder / "broken.onnx")), {"broken.onnx", "cannot read"});
  expect_error(arguments("out", "--prior " + quoted(folder / "networks")), {"networks", "found a folder"});
  expect_error(arguments("out", "--prior " + quoted(folder / "sequence" / "camera.yaml")),
               {"camera.yaml", "found the ending '.yaml'", "expected .onnx"});
  fs::remove(folder / "networks" / "people.weights");
  expect_error(arguments("out", prior(people)), {"people.weights", "no such file"});
  EXPECT_EQ(files_in(folder / "out"), std::vector<std::string>()) << "half-written files";
}

TEST_F(NetworkPrior, ClassesThatCannotBeRead) {
  const std::string network = "--prior " + quoted(people);
  expect_error(arguments("out", network + " --classes nowhere.names"), {"nowhere.names", "no such file"});
  expect_error(arguments("out", network + " --classes coco"), {"people.cfg"});
}

TEST(NetworkArguments, GoWithANetwork) {
  expect_error("--demo --prior model.onnx", {"--prior", "found 'model.onnx'", "no such file", "the file of a network"});
  for (const char* prior : {"", "--prior none ", "--prior boxes ", "--prior labels "})
    for (const char* option : {"--detector-layout yolox", "--classes coco", "--sync"})
      expect_error("--demo " + std::string(prior) + option,
                   {split(option, ' ')[0], "found without a network", "expected --prior MODEL"});
  expect_error("--demo --prior labels --detect-every 2", {"--detect-every", "found without a detector"});
}

TEST_F(NetworkPrior, DropsNoBoxes) {
  expect_error(arguments("out", prior(people) + "--drop-boxes 0.5"), {"--drop-boxes", "expected --prior boxes"});
}

/// A published network on a recorded sequence.
TEST_F(NetworkPrior, PublishedNetworkFindsPeople) {
#if !defined(STILLPOINT_SHARED_DATA) || !defined(STILLPOINT_SHARED_MODELS)
  GTEST_SKIP() << "no published network: STILLPOINT_SHARED_MODELS is not set";
#else
  const fs::path network = fs::path(STILLPOINT_SHARED_MODELS) / "yolox_nano.onnx";
  const fs::path sequence = fs::path(STILLPOINT_SHARED_DATA) / "kitchen_walk";
  if (!fs::exists(network) || !fs::exists(sequence)) GTEST_SKIP() << "no " << network << " or no " << sequence;
  const std::string more =
      "--tum " + quoted(sequence) + " --start 100 --frames 4 --detect-every 2 --prior " + quoted(network);
  const auto run = [&](const std::string& name, const std::string& mode) {
    const Outcome outcome =
        run_program("--quiet --backend none --out " + quoted(folder / name) + ' ' + more + ' ' + mode);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("yolox_nano.onnx (yolox, 416 x 416) answered on"), std::string::npos) << outcome.out;
    return folder / name;
  };
  const fs::path once = run("once", "--sync"), again = run("again", "--sync"), async = run("async", "");
  EXPECT_EQ(read_text(once / "features.csv"), read_text(again / "features.csv"));
  EXPECT_EQ(detector(once)["frames"]["detected"], 2);
  EXPECT_EQ(frames_with_people(once), 4);
  expect_complete(detector(async)["frames"], 4);
  EXPECT_GE(detector(async)["frames"]["detected"], 1);
#endif
}

}  // namespace
}  // namespace system_test::network_test
