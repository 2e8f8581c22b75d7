// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint_shim/compact.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/random.hpp"

namespace {

using Flags = std::vector<unsigned char>;

TEST(ShimCompact, KeepsTheOrderAndTheRows) {
  const Flags keep = {1, 0, 0, 1, 1};
  std::vector<std::string> names = {"a", "b", "c", "d", "e"};
  std::vector<bool> near = {true, false, false, false, true};
  cv::Mat rows = (cv::Mat_<int>(5, 2) << 0, 10, 1, 11, 2, 12, 3, 13, 4, 14);
  EXPECT_EQ(stillpoint_shim::compact(keep, names, near, rows), 3u);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "d", "e"}));
  EXPECT_EQ(near, (std::vector<bool>{true, false, true}));
  ASSERT_EQ(rows.size(), cv::Size(2, 3));
  const cv::Mat expected = (cv::Mat_<int>(3, 2) << 0, 10, 3, 13, 4, 14);
  EXPECT_EQ(cv::norm(rows, expected), 0.0);
}

TEST(ShimCompact, AnArrayOfAnotherSizeIsNamedAndNothingIsChanged) {
  std::vector<int> first = {1, 2, 3}, second = {1, 2};
  cv::Mat rows(3, 32, CV_8UC1, cv::Scalar(7));
  try {
    stillpoint_shim::compact(Flags{0, 1, 1}, first, rows, second);
    FAIL() << "two entries for three flags";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "compact: array 3 has 2 entries, expected one for each of the 3 keep flags");
  }
  EXPECT_EQ(first.size(), 3u);
  EXPECT_EQ(rows.rows, 3);
}

TEST(ShimCompact, NothingAndAllDropped) {
  std::vector<double> none, one = {1.0};
  cv::Mat rows(1, 32, CV_8UC1);
  EXPECT_EQ(stillpoint_shim::compact(Flags{}, none), 0u);
  EXPECT_EQ(stillpoint_shim::compact(Flags{0}, one, rows), 0u);
  EXPECT_TRUE(one.empty());
  EXPECT_EQ(rows.rows, 0);
  EXPECT_EQ(rows.cols, 32);
}

TEST(ShimCompact, NewIndicesTellWhereEachWent) {
  EXPECT_EQ(stillpoint_shim::new_indices(Flags{0, 1, 1, 0, 1}), (std::vector<int>{-1, 0, 1, -1, 2}));
  EXPECT_TRUE(stillpoint_shim::new_indices(Flags{}).empty());
}

TEST(ShimCompact, DoesWhatTheLibraryDoes) {
  stillpoint::Random random(3);
  for (int i = 0; i < 100; ++i) {
    Flags keep(random.index(40));
    std::vector<int> ours(keep.size()), theirs;
    for (std::size_t k = 0; k < keep.size(); ++k) {
      keep[k] = static_cast<unsigned char>(random.index(3));  // any flag but 0 keeps
      ours[k] = static_cast<int>(random.index(1000));
    }
    theirs = ours;
    cv::Mat our_rows = cv::Mat(ours, true), their_rows = our_rows.clone();
    EXPECT_EQ(stillpoint_shim::compact(keep, ours, our_rows), stillpoint::compact(keep, theirs, their_rows)) << i;
    EXPECT_EQ(ours, theirs) << i;
    ASSERT_EQ(our_rows.rows, their_rows.rows) << i;
    if (our_rows.empty()) continue;
    EXPECT_EQ(cv::norm(our_rows, their_rows), 0.0) << i;
  }
}

}  // namespace
