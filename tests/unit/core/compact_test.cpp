// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/compact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint {
namespace {

using Flags = std::vector<std::uint8_t>;

/// Parallel arrays of every kind a host has, each entry tagged with its index.
struct HostArrays {
  std::vector<int> ids;
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  Eigen::MatrixXf rows;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points;
  Eigen::VectorXd depths;
  std::vector<std::unique_ptr<int>> owners;
  std::vector<bool> bits;
  std::deque<std::string> names;

  explicit HostArrays(int count) : descriptors(count, 32, CV_8UC1), rows(count, 4), points(count, 3), depths(count) {
    for (int i = 0; i < count; ++i) {
      ids.push_back(i);
      keypoints.emplace_back(cv::Point2f(static_cast<float>(i), 0.5f), 31.0f, 45.0f, 1.0f, i % 8, i);
      descriptors.row(i).setTo(i % 251);
      rows.row(i).setConstant(static_cast<float>(i));
      points.row(i).setConstant(i);
      depths[i] = i;
      owners.push_back(std::make_unique<int>(i));
      bits.push_back(i % 3 == 0);
      names.push_back(std::to_string(i));
    }
  }

  std::size_t compact_all(const Flags& keep) {
    return compact(keep, ids, keypoints, descriptors, rows, points, depths, owners, bits, names);
  }

  void expect(const std::vector<int>& indices) const {
    ASSERT_EQ(ids, indices);
    const std::size_t count = indices.size();
    ASSERT_EQ(keypoints.size(), count);
    ASSERT_EQ(static_cast<std::size_t>(descriptors.rows), count);
    ASSERT_EQ(static_cast<std::size_t>(rows.rows()), count);
    ASSERT_EQ(static_cast<std::size_t>(points.rows()), count);
    ASSERT_EQ(static_cast<std::size_t>(depths.size()), count);
    ASSERT_TRUE(owners.size() == count && bits.size() == count && names.size() == count);
    for (std::size_t j = 0; j < count; ++j) {
      const int tag = indices[j], row = static_cast<int>(j);
      ASSERT_EQ(keypoints[j].class_id, tag);
      ASSERT_EQ(keypoints[j].pt, cv::Point2f(static_cast<float>(tag), 0.5f));
      ASSERT_EQ(cv::countNonZero(descriptors.row(row) != tag % 251), 0);
      ASSERT_TRUE((rows.row(row).array() == static_cast<float>(tag)).all());
      ASSERT_TRUE((points.row(row).array() == tag).all());
      ASSERT_EQ(depths[row], tag);
      ASSERT_EQ(*owners[j], tag);
      ASSERT_EQ(bits[j], tag % 3 == 0);
      ASSERT_EQ(names[j], std::to_string(tag));
    }
  }
};

TEST(Compact, KeepsOrderAndAlignmentOfAllArrays) {
  HostArrays host(6);
  EXPECT_EQ(host.compact_all({0, 1, 1, 0, 1, 0}), 3u);
  host.expect({1, 2, 4});
}

TEST(Compact, AnyNonZeroByteKeeps) {
  std::vector<int> ids = {0, 1, 2};
  EXPECT_EQ(compact(Flags{255, 0, 2}, ids), 2u);
  EXPECT_EQ(ids, (std::vector<int>{0, 2}));
}

TEST(Compact, RandomFlagsKeepEveryRowWithItsTag) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int count = static_cast<int>(random.index(60));
    HostArrays host(count);
    Flags keep;
    std::vector<int> expected;
    const double share = random.uniform();
    for (int i = 0; i < count; ++i) {
      keep.push_back(random.uniform() < share ? 1 : 0);
      if (keep.back() != 0) expected.push_back(i);
    }
    ASSERT_EQ(host.compact_all(keep), expected.size());
    host.expect(expected);
  }
}

TEST(Compact, AllNoneAndEmpty) {
  HostArrays all(5), none(5), empty(0);
  EXPECT_EQ(all.compact_all(Flags(5, 1)), 5u);
  all.expect({0, 1, 2, 3, 4});
  EXPECT_EQ(none.compact_all(Flags(5, 0)), 0u);
  none.expect({});
  EXPECT_EQ(empty.compact_all({}), 0u);
  empty.expect({});
}

TEST(Compact, AnotherSizeThrowsAndChangesNothing) {
  HostArrays host(4);
  std::vector<int> longer = {0, 1, 2, 3, 4};
  const Flags keep = {1, 0, 1, 0};
  try {
    compact(keep, host.ids, host.descriptors, longer, host.rows);
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "compact: array 3 has 5 entries, expected one for each of the 4 keep flags");
  }
  host.expect({0, 1, 2, 3});
  EXPECT_EQ(longer, (std::vector<int>{0, 1, 2, 3, 4}));
  cv::Mat three(3, 2, CV_32FC1);
  EXPECT_THROW(compact(keep, three), Error);
  Eigen::MatrixXd five(5, 2);
  EXPECT_THROW(compact(keep, five), Error);
}

TEST(Compact, MatricesKeepTheirWidthAndType) {
  cv::Mat descriptors(3, 8, CV_32FC1, cv::Scalar(1.5));
  Eigen::MatrixXd points = Eigen::MatrixXd::Random(3, 7);
  compact(Flags{1, 0, 1}, descriptors, points);
  EXPECT_EQ(descriptors.cols, 8);
  EXPECT_EQ(descriptors.type(), CV_32FC1);
  EXPECT_EQ(points.cols(), 7);
  compact(Flags{0, 0}, descriptors, points);
  EXPECT_EQ(descriptors.rows, 0);
  EXPECT_EQ(descriptors.cols, 8) << "rows can be pushed behind it again";
  EXPECT_EQ(descriptors.type(), CV_32FC1);
  EXPECT_EQ(points.cols(), 7);
}

/// Counts how often an entry is moved or copied.
struct Instrumented {
  static inline std::size_t moves = 0, copies = 0;
  int tag = 0;
  Instrumented() = default;
  explicit Instrumented(int t) : tag(t) {}
  Instrumented(const Instrumented& other) : tag(other.tag) { ++copies; }
  Instrumented(Instrumented&& other) noexcept : tag(other.tag) { ++moves; }
  Instrumented& operator=(const Instrumented& other) {
    tag = other.tag;
    ++copies;
    return *this;
  }
  Instrumented& operator=(Instrumented&& other) noexcept {
    tag = other.tag;
    ++moves;
    return *this;
  }
};

TEST(Compact, MovesEachEntryAtMostOnce) {
  constexpr int count = 10000;
  std::vector<Instrumented> entries;
  for (int i = 0; i < count; ++i) entries.emplace_back(i);
  Flags keep(count, 1);
  keep[0] = 0;  // the worst case for erase(): everything moves up by one
  for (std::size_t i = 1; i < keep.size(); i += 2) keep[i] = 0;
  Instrumented::moves = Instrumented::copies = 0;
  const std::size_t kept = compact(keep, entries);
  EXPECT_EQ(kept, 4999u);  // the even indices but the first
  EXPECT_EQ(Instrumented::copies, 0u);
  EXPECT_EQ(Instrumented::moves, kept);
  Instrumented::moves = 0;
  compact(Flags(kept, 1), entries);
  EXPECT_EQ(Instrumented::moves, 0u) << "nothing to drop, nothing to move";
}

TEST(CompactionMap, SendsEachEntryWhereCompactPutsIt) {
  std::vector<int> old_to_new = {7, 7, 7, 7, 7, 7};  // reused, whatever it held
  EXPECT_EQ(compaction_map(Flags{0, 1, 255, 0, 1}, old_to_new), 3u);
  EXPECT_EQ(old_to_new, (std::vector<int>{-1, 0, 1, -1, 2}));
  EXPECT_EQ(compaction_map(Flags{}, old_to_new), 0u);
  EXPECT_TRUE(old_to_new.empty());

  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Flags keep(random.index(60));
    for (std::uint8_t& flag : keep) flag = random.uniform() < 0.5 ? 1 : 0;
    std::vector<int> ids;
    for (std::size_t i = 0; i < keep.size(); ++i) ids.push_back(static_cast<int>(i));
    const std::size_t kept = compact(keep, ids);
    ASSERT_EQ(compaction_map(keep, old_to_new), kept);
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (keep[i] == 0)
        ASSERT_EQ(old_to_new[i], -1);
      else
        ASSERT_EQ(ids[static_cast<std::size_t>(old_to_new[i])], static_cast<int>(i));
    }
  }
}

TEST(CompactionMap, AllocatesOnceForTheLargestFrame) {
  std::vector<int> old_to_new;
  compaction_map(Flags(1000, 1), old_to_new);
  const int* const memory = old_to_new.data();
  compaction_map(Flags(10, 0), old_to_new);
  compaction_map(Flags(1000, 1), old_to_new);
  EXPECT_EQ(old_to_new.data(), memory);
}

}  // namespace
}  // namespace stillpoint
