// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/lanes.hpp"

#include <gtest/gtest.h>

namespace stillpoint::lanes_test {

TEST(Lanes, ComputeAndChooseInEachLaneByItself) {
  const Lanes a = lanes(1.0, -2.0), b = lanes_of<Lanes>(3.0);
  const Lanes product = a * b + 1.0;
  EXPECT_EQ(product[0], 4.0);
  EXPECT_EQ(product[1], -5.0);
  const Lanes chosen = where<Lanes>(a > 0.0, a, b);
  EXPECT_EQ(chosen[0], 1.0);
  EXPECT_EQ(chosen[1], 3.0);
  EXPECT_EQ(sum_of(chosen), 4.0);
  EXPECT_EQ(where<double>(false, 1.0, 2.0), 2.0);
}

TEST(Lanes, FourFloatsComeFromAnyPlaceInMemory) {
  const float values[] = {9, 1, -2, 3, -4};
  const FloatLanes four = float_lanes(values + 1), least = {};
  EXPECT_EQ(sum_of(four), -2.0f);
  EXPECT_EQ(sum_of(larger(four, least)), 4.0f);
}

}  // namespace stillpoint::lanes_test
