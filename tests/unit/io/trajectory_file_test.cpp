// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/trajectory_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint::trajectory_file_test {
namespace {

const std::string kGood = "1.0 0 0 0 0 0 0 1\n";

/// What the reader says of a second row, without the file's name.
std::string message_of_row(const std::string& row) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.txt", "# header\n" + kGood + row + "\n");
  const std::string message = error_of([&] { read_trajectory(file); });
  const std::string where = file.string() + ":3: found ";
  EXPECT_EQ(message.substr(0, where.size()), where) << message;
  return message.size() > where.size() ? message.substr(where.size()) : "";
}

TEST(ReadTrajectory, HandComputed) {
  const TemporaryFolder folder;
  // A quarter turn about z takes x to y; the quaternion (0 0 s s) of length 2 means the same as of length 1.
  const auto trajectory =
      read_trajectory(folder.write("t.txt", "# comment\n\n1.5\t1 2 3 0 0 1.414213562 1.414213562\r\n2 4 5 6 0 0 0 -1"));
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].timestamp_s, 1.5);
  EXPECT_EQ(Vector3d(trajectory[0].world_from_camera.translation()), Vector3d(1, 2, 3));
  constexpr double kRounding = 1e-14;
  EXPECT_LT((trajectory[0].world_from_camera.linear() * Vector3d::UnitX() - Vector3d::UnitY()).norm(), kRounding);
  EXPECT_LT((trajectory[1].world_from_camera.linear() - Matrix3d::Identity()).norm(), kRounding);
}

TEST(ReadTrajectory, FileWithoutARowIsEmpty) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_trajectory(folder.write("t.txt", "# header only\n")).empty());
}

TEST(ReadTrajectory, EqualTimesArePassed) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_trajectory(folder.write("t.txt", kGood + kGood)).size(), 2u);
}

TEST(ReadTrajectory, NamesWhatIsWrong) {
  EXPECT_EQ(message_of_row("2 0 0 0 0 0 1"), "7 columns, expected 8: timestamp tx ty tz qx qy qz qw");
  EXPECT_EQ(message_of_row("2 0 0 0 0 0 0 1 0"), "9 columns, expected 8: timestamp tx ty tz qx qy qz qw");
  EXPECT_EQ(message_of_row("2 0 x 0 0 0 0 1"), "ty 'x', expected a finite number");
  EXPECT_EQ(message_of_row("2 0 0 nan 0 0 0 1"), "tz 'nan', expected a finite number");
  EXPECT_EQ(message_of_row("2 0 0 0 inf 0 0 1"), "qx 'inf', expected a finite number");
  EXPECT_EQ(message_of_row("2 0 0 0 0 0 0 0"), "a quaternion of length zero, expected qx qy qz qw of length one");
  EXPECT_EQ(message_of_row("0.5 0 0 0 0 0 0 1"),
            "timestamp '0.5', expected not before 1.000000, the time of the row before");
}

TEST(ReadTrajectory, MissingFileIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "none.txt";
  EXPECT_EQ(error_of([&] { read_trajectory(file); }), file.string() + ": no such file");
}

TEST(WriteTrajectory, HasTheBytesOfTheFormat) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.txt";
  StampedPose pose;
  pose.timestamp_s = 1305031102.160407;
  pose.world_from_camera.translation() = Vector3d(0.5, -1.25, 1e-10);
  write_trajectory(file, {pose});
  EXPECT_EQ(TemporaryFolder::read(file),
            "# timestamp tx ty tz qx qy qz qw\n"
            "1305031102.160407 0.500000000 -1.250000000 0.000000000 "
            "0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(WriteTrajectory, IsReadBack) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.txt";
  Random random(3);
  Trajectory trajectory;
  for (int i = 0; i < 500; ++i) {
    StampedPose pose;
    pose.timestamp_s = 1e9 + i / 30.0;
    const double x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
    pose.world_from_camera.linear() = rotation_from_vector(2.0 * Vector3d(x, y, z));
    pose.world_from_camera.translation() = Vector3d(z, x, y);
    trajectory.push_back(pose);
  }
  write_trajectory(file, trajectory);
  const std::string bytes = TemporaryFolder::read(file);
  const Trajectory found = read_trajectory(file);
  ASSERT_EQ(found.size(), trajectory.size());
  constexpr double kNineDecimals = 1e-8;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].timestamp_s, trajectory[i].timestamp_s);
    EXPECT_TRUE(found[i].world_from_camera.isApprox(trajectory[i].world_from_camera, kNineDecimals)) << i;
  }
  write_trajectory(file, trajectory);
  EXPECT_EQ(TemporaryFolder::read(file), bytes);
}

TEST(WriteTrajectory, PoseThatIsNotFiniteIsAnErrorAndNoFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "t.txt";
  StampedPose pose;
  pose.timestamp_s = 2.0;
  pose.world_from_camera.translation().y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of([&] { write_trajectory(file, {pose}); }),
            file.string() + ": the pose at 2.000000 is not finite, expected finite poses to write");
  EXPECT_EQ(folder.count_files(), 0);
}

}  // namespace
}  // namespace stillpoint::trajectory_file_test
