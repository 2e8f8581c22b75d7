// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/extend.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace stillpoint::extend_test {

TEST(Extend, KeepsWhatWasThereAndCutsWhatIsTooLong) {
  std::vector<int> values{1, 2};
  extend(values, 4, 7);
  EXPECT_EQ(values, (std::vector<int>{1, 2, 7, 7}));
  extend(values, 1, 9);
  EXPECT_EQ(values, std::vector<int>{1});
}

TEST(Refill, OverwritesAll) {
  std::vector<int> values{1, 2, 3};
  refill(values, 2, 7);
  EXPECT_EQ(values, (std::vector<int>{7, 7}));
  refill(values, 3, 8);
  EXPECT_EQ(values, (std::vector<int>{8, 8, 8}));
}

}  // namespace stillpoint::extend_test
