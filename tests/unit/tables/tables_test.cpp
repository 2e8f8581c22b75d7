// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The paper's tables: their figures are those of evo, and a sequence that is not there says so.

#include "tables.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "stillpoint/io/trajectory_file.hpp"

namespace {

const std::filesystem::path kTrajectories = std::filesystem::path(STILLPOINT_SHARED_DATA) / "trajectories";

struct EvoRow {
  double count, rmse, mean, median, std;
};

/// What evo gave for a published trajectory, by "metric quantity alignment delta pairs".
std::map<std::string, EvoRow> evo_rows(const std::string& estimate) {
  std::map<std::string, EvoRow> rows;
  std::ifstream table(kTrajectories / "expected.csv");
  for (std::string line; std::getline(table, line);) {
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (fields.size() < 12 || fields[1] != estimate) continue;
    const std::string name = fields[2] + ' ' + fields[3] + ' ' + fields[4] + ' ' + fields[5] + ' ' + fields[6];
    rows[name] = {std::stod(fields[7]), std::stod(fields[8]), std::stod(fields[9]), std::stod(fields[10]),
                  std::stod(fields[11])};
  }
  return rows;
}

void expect_equal(const stillpoint::ErrorStatistics& found, const EvoRow& evo, const char* what) {
  constexpr double kTolerance = 2e-6;  // evo's figures have nine digits, the files six
  EXPECT_EQ(static_cast<double>(found.count), evo.count) << what;
  EXPECT_NEAR(found.rmse, evo.rmse, kTolerance) << what;
  EXPECT_NEAR(found.mean, evo.mean, kTolerance) << what;
  EXPECT_NEAR(found.median, evo.median, kTolerance) << what;
  EXPECT_NEAR(found.std, evo.std, kTolerance) << what;
}

TEST(Tables, GiveTheFiguresOfEvo) {
  if (!std::filesystem::exists(kTrajectories)) GTEST_SKIP() << "no shared data";
  const std::string estimate = "freiburg1_xyz-rgbdslam.txt";
  const auto errors = tables::errors_of(stillpoint::read_trajectory(kTrajectories / "freiburg1_xyz-groundtruth.txt"),
                                        stillpoint::read_trajectory(kTrajectories / estimate));
  ASSERT_TRUE(errors);
  const auto evo = evo_rows(estimate);
  expect_equal(errors->ate_m, evo.at("ape translation_m se3  "), "table 1");
  expect_equal(errors->rpe_m, evo.at("rpe translation_m none 30 frames all"), "table 2");
  expect_equal(errors->rpe_deg, evo.at("rpe rotation_deg none 30 frames all"), "table 3");
}

TEST(Tables, ASequenceThatIsNotHereSaysSo) {
  const std::vector<tables::Row> rows = {{"walking_xyz", {}, {}}};
  EXPECT_NE(
      tables::error_table("Table 1", rows, &tables::Errors::ate_m).find("| walking_xyz | the sequence is not here"),
      std::string::npos);
  EXPECT_NE(tables::comparison_table(rows).find("| walking_xyz | not here | not here | 0.2995 |"), std::string::npos);
  EXPECT_NE(tables::as_csv(rows).find("walking_xyz,with,not here"), std::string::npos);
}

TEST(Tables, ATrackerThatGaveNoPosesIsLostAndNotMissing) {
  tables::Errors with;
  with.ate_m.rmse = 0.25;
  const std::vector<tables::Row> rows = {{"walking_xyz", with, {}, true}};
  EXPECT_NE(
      tables::error_table("Table 1", rows, &tables::Errors::ate_m).find("| walking_xyz | lost | – | – | – | 0.2500 |"),
      std::string::npos);
  EXPECT_NE(tables::comparison_table(rows).find("| walking_xyz | lost | 0.2500 | 0.2995 |"), std::string::npos);
  EXPECT_NE(tables::as_csv(rows).find("walking_xyz,without,lost,,,,,"), std::string::npos);
}

// Bonn's reference is a body on the camera: a rotation of the camera moves it in another way.
TEST(Tables, SayThatBonnsPosesAreNotTheCameras) {
  std::vector<tables::Row> rows = {{"desk", tables::Errors{}, tables::Errors{}, true}, {"bonn_crowd", {}, {}}};
  EXPECT_EQ(tables::notes(rows), "") << "not here: there is nothing to say";
  rows[1].filtered = tables::Errors{};
  EXPECT_NE(tables::notes(rows).find("bonn_*"), std::string::npos);
}

// η = (without − with) / without, in percent (Eq. 17).
TEST(Tables, ImprovementIsThatOfThePaper) {
  tables::Errors with, without;
  with.ate_m.rmse = 0.25;
  without.ate_m.rmse = 1.0;
  const std::vector<tables::Row> rows = {{"desk", with, without, true}};
  EXPECT_NE(tables::error_table("Table 1", rows, &tables::Errors::ate_m).find("| 75.00 |"), std::string::npos);
}

}  // namespace
