// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What fails in the thread of mapping is an error of who hands it keyframes.

#include "slam/map_keeper.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>

#include "made_map.hpp"

namespace slam_test {
namespace {

constexpr slam::KeyframeId kUnknown = 99;  // no keyframe of the map: std::out_of_range

TEST(MapKeeper, AFailureInTheThreadComesOutOfFinishAndAdd) {
  slam::MapKeeper keeper(camera(), slam::MeasurementNoise(), true);
  keeper.map = made_map(made_points(40), 4);
  keeper.add(kUnknown);
  EXPECT_THROW(keeper.finish(), std::out_of_range);
  EXPECT_THROW(keeper.add(3), std::out_of_range);
  EXPECT_THROW(keeper.finish(), std::out_of_range) << "nothing is kept after it";
  const std::lock_guard<std::mutex> lock(keeper.mutex);
  EXPECT_EQ(keeper.waiting(), 0u);
}

TEST(MapKeeper, AFailureThatNobodyAsksForEndsNoProgram) {
  slam::MapKeeper keeper(camera(), slam::MeasurementNoise(), true);
  keeper.add(kUnknown);
}

TEST(MapKeeper, InStepAFailureComesOutOfAdd) {
  slam::MapKeeper keeper(camera(), slam::MeasurementNoise(), false);
  EXPECT_THROW(keeper.add(kUnknown), std::out_of_range);
  EXPECT_NO_THROW(keeper.finish());
}

}  // namespace
}  // namespace slam_test
