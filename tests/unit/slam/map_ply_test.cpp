// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A point is a row, however far away it is.

#include "slam/map_ply.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "made_map.hpp"

namespace slam_test {
namespace {

TEST(MapPly, APointIsARowWithFourDecimals) {
  const std::string ply = slam::map_as_ply(made_map({Vector3d(0.5, -0.00004, 2.00006)}, 2), camera());
  EXPECT_NE(ply.find("\nelement vertex 11\n"), std::string::npos) << ply;  // a point, and five for each keyframe
  EXPECT_NE(ply.find("end_header\n0.5000 -0.0000 2.0001 3 2 1\n"), std::string::npos) << ply;
  EXPECT_NE(ply.find("\n0.0500 0.0000 0.0000 30 90 220\n"), std::string::npos) << ply;
}

TEST(MapPly, ARowIsAsLongAsItsNumbers) {
  slam::Map map = made_map(made_points(1), 2);
  map.point(0).p_world = Vector3d(1e300, -1e300, 1e300);
  const std::string ply = slam::map_as_ply(map, camera());
  const std::size_t begin = ply.find("end_header\n") + 11;
  const std::string row = ply.substr(begin, ply.find('\n', begin) - begin);
  EXPECT_EQ(row.size(), 3 * 306 + 1 + 3 + 5) << "301 digits, the point and four: " << row;
  EXPECT_EQ(row.substr(row.size() - 6), " 3 2 1");
}

}  // namespace
}  // namespace slam_test
