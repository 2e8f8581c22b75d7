// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Wrong arguments: one line that names what was wrong and what was expected, exit status 2.

#include <gtest/gtest.h>

#include <string>

#include "run_program.hpp"
#include "stillpoint/version.hpp"

namespace system_test {
namespace {

TEST(StillpointRunArguments, HelpListsThemAndSucceeds) {
  const Outcome outcome = run_program("--help");
  EXPECT_EQ(outcome.status, 0);
  for (const char* name : {"--demo",
                           "--tum",
                           "--euroc",
                           "--images",
                           "--right",
                           "--video",
                           "--fps",
                           "--out",
                           "--save-video",
                           "--camera",
                           "--options",
                           "--calibrate",
                           "--depth-noise",
                           "--policies",
                           "--ego-motion",
                           "--paper-as-printed",
                           "--false-positive-rate",
                           "--without",
                           "--prior",
                           "--detector-layout",
                           "--classes",
                           "--detect-every",
                           "--sync",
                           "--drop-boxes",
                           "--backend",
                           "--slam-without",
                           "--mapping-in-step",
                           "--features",
                           "--start",
                           "--frames",
                           "--seed",
                           "--threads",
                           "--quiet"})
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
  for (const char* choice : {"klt", "orb", "monocular"})
    EXPECT_NE(outcome.out.find(choice), std::string::npos) << choice;
}

TEST(StillpointRunArguments, VersionIsTheLibrarys) {
  const Outcome outcome = run_program("--version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, STILLPOINT_VERSION "\n");
}

TEST(StillpointRunArguments, OneSequenceIsAskedFor) {
  expect_error("", {"found no sequence", "expected --demo or --tum FOLDER"});
  expect_error("--demo --tum somewhere", {"found --demo and --tum", "expected one of them"});
  expect_error("--tum", {"--tum", "FOLDER"});
  expect_error("--tum ''", {"--tum", "found nothing", "expected a path"});
}

TEST(StillpointRunArguments, WordsThatAreNotOffered) {
  expect_error("--demo --policies best", {"--policies", "found 'best'", "expected one of default, paper"});
  expect_error("--demo --ego-motion imu", {"--ego-motion", "found 'imu'", "expected one of default, rigid, epipolar"});
  expect_error("--demo --depth-noise none", {"--depth-noise", "found 'none'", "expected one of kinect, stereo, tof"});
  expect_error("--demo --prior lables", {"--prior", "found 'lables'", "expected one of none, boxes, labels"});
  expect_error("--demo --backend map", {"--backend", "found 'map'", "expected one of odometry, klt, orb, slam, none"});
  expect_error("--demo --backend slam --slam-without maps",
               {"--slam-without", "found 'maps'", "expected one of multi-view, bundle, loops, semantics"});
  expect_error("--demo --slam-without loops", {"--slam-without", "found with --backend odometry"});
  expect_error("--demo --backend orb --mapping-in-step", {"--mapping-in-step", "expected --backend slam"});
  expect_error("--demo --paper-as-printed eq3,eq4",
               {"--paper-as-printed", "found 'eq4'", "expected one of eq3, eq8, unit-t"});
}

TEST(StillpointRunArguments, NumbersThatAreNone) {
  expect_error("--demo --frames 0", {"--frames", "found '0'", "expected a whole number from 1"});
  expect_error("--demo --frames -3", {"--frames"});
  expect_error("--demo --frames=-3", {"--frames", "found '-3'", "expected a whole number from 1"});
  expect_error("--demo --frames 2.5", {"--frames", "found '2.5'", "expected a whole number"});
  expect_error("--demo --frames 99999999999", {"--frames", "found '99999999999'", "expected a whole number"});
  expect_error("--demo --features many", {"--features", "found 'many'", "expected a whole number from 1 to 100000"});
  expect_error("--demo --start=-1", {"--start", "found '-1'", "expected a whole number from 0"});
  expect_error("--demo --seed=-1", {"--seed", "found '-1'", "expected a whole number from 0"});
  expect_error("--demo --threads 0", {"--threads", "found '0'", "expected a whole number from 1"});
}

TEST(StillpointRunArguments, OfADetectorGoWithOne) {
  expect_error("--demo --detect-every 10", {"--detect-every", "expected --prior boxes or --prior MODEL"});
  expect_error("--demo --prior none --drop-boxes 0.5", {"--drop-boxes", "expected --prior boxes"});
  expect_error("--demo --prior boxes --detect-every 0", {"--detect-every", "found '0'", "a whole number from 1"});
  expect_error("--demo --prior boxes --drop-boxes 1.5", {"--drop-boxes", "found '1.5'", "a number from 0 to 1"});
}

TEST(StillpointRunArguments, UnknownOnesAreNamed) {
  expect_error("--demo --fast", {"--fast", "--help"});
  expect_error("--demo folder", {"folder", "--help"});
}

TEST(StillpointRunArguments, ThatContradictEachOther) {
  expect_error("--demo --camera camera.yaml", {"--camera", "--demo", "expected it with --tum"});
  expect_error("--demo --policies paper --ego-motion rigid --paper-as-printed eq3",
               {"--paper-as-printed", "eq3", "expected --ego-motion epipolar"});
  expect_error("--demo --prior labels --policies paper", {"--policies", "--prior labels"});
}

TEST(StillpointRunArguments, StartBeyondTheLastFrame) {
  expect_error("--demo --start 100000", {"--start", "found 100000", "expected less than 150"});
}

TEST(StillpointRunArguments, OutThatIsAFile) {
  const TemporaryFolder folder;
  write_text(folder / "file", "not a folder");
  expect_error("--demo --frames 1 --out " + quoted(folder / "file"), {"--out", "expected a folder"});
  expect_error("--demo --frames 1 --out " + quoted(folder / "file" / "below"), {"--out", "expected a folder"});
}

}  // namespace
}  // namespace system_test
