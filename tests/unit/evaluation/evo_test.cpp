// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
// The numbers that evo gives for published trajectories (expected.csv of the shared data) come out of our code.

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "stillpoint/evaluation/trajectory_error.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/trajectory_file.hpp"

namespace stillpoint::evo_test {
namespace {

#ifdef STILLPOINT_SHARED_DATA
const std::filesystem::path kTrajectories = std::filesystem::path(STILLPOINT_SHARED_DATA) / "trajectories";
#else
const std::filesystem::path kTrajectories;
#endif

/// Printed with nine decimals: half a unit of the last, and the rounding of a different order of operations.
constexpr double kTolerance = 1e-8;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

RelativeErrorOptions options_of(const std::string& delta, const std::string& pairs) {
  RelativeErrorOptions options;
  const std::size_t blank = delta.find(' ');
  options.delta = parse_number(delta.substr(0, blank)).value();
  options.unit = delta.substr(blank + 1) == "m" ? DeltaUnit::metres : DeltaUnit::frames;
  options.pairs = pairs == "all" ? PairSelection::all : PairSelection::consecutive;
  return options;
}

TEST(Evo, EveryRowOfTheExpectedFiguresIsReproduced) {
  std::ifstream table(kTrajectories / "expected.csv");
  if (kTrajectories.empty() || !table) GTEST_SKIP() << "the shared data with evo's figures is not here";
  std::string line;
  const auto next_line = [&table, &line] {
    const bool found = static_cast<bool>(std::getline(table, line));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return found;
  };
  ASSERT_TRUE(next_line());
  ASSERT_EQ(line, "reference,estimate,metric,quantity,alignment,delta,pairs,count,rmse,mean,median,std,min,max");

  int rows = 0;
  while (next_line()) {
    SCOPED_TRACE(line);
    const std::vector<std::string> field = split(line);
    ASSERT_EQ(field.size(), 14u);
    const Trajectory reference = read_trajectory(kTrajectories / field[0]);
    const Trajectory estimate = read_trajectory(kTrajectories / field[1]);
    const Alignment alignment = field[4] == "se3"    ? Alignment::se3
                                : field[4] == "sim3" ? Alignment::sim3
                                                     : Alignment::none;
    const TrajectoryErrors errors =
        field[2] == "ape" ? absolute_trajectory_error(reference, estimate, alignment).errors
                          : relative_trajectory_error(reference, estimate, options_of(field[5], field[6]));
    const ErrorStatistics found =
        error_statistics(field[3] == "rotation_deg" ? errors.rotation_deg : errors.translation_m);

    EXPECT_EQ(std::to_string(found.count), field[7]);
    const double figures[] = {found.rmse, found.mean, found.median, found.std, found.min, found.max};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(figures[i], parse_number(field[8 + i]).value(), kTolerance) << i;
    ++rows;
  }
  EXPECT_EQ(rows, 60);
}

}  // namespace
}  // namespace stillpoint::evo_test
