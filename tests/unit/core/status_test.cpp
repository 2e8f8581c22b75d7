// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/status.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/timings.hpp"

namespace stillpoint {
namespace {

struct Row {
  Status status;
  const char* name;
  bool judged;
};

constexpr Row kTable[] = {
    {Status::ok, "ok", true},
    {Status::first_frame, "first_frame", false},
    {Status::no_image, "no_image", false},
    {Status::unsupported_image, "unsupported_image", false},
    {Status::depth_unit_missing, "depth_unit_missing", false},
    {Status::implausible_depth, "implausible_depth", false},
    {Status::size_changed, "size_changed", false},
    {Status::invalid_time, "invalid_time", false},
    {Status::invalid_options, "invalid_options", false},
    {Status::duplicate_frame, "duplicate_frame", false},
    {Status::out_of_order, "out_of_order", false},
    {Status::time_gap, "time_gap", false},
    {Status::no_keypoints, "no_keypoints", false},
    {Status::no_depth, "no_depth", false},
    {Status::too_few_matches, "too_few_matches", false},
    {Status::degenerate_geometry, "degenerate_geometry", false},
    {Status::no_consensus, "no_consensus", false},
};

TEST(Status, NamesAndJudgementAreThoseOfTheTable) {
  std::set<Status> seen;
  for (const Row& row : kTable) {
    EXPECT_STREQ(to_string(row.status), row.name);
    EXPECT_EQ(judged(row.status), row.judged) << row.name;
    Motion motion;
    motion.status = row.status;
    EXPECT_EQ(motion.usable(), row.judged) << row.name;
    seen.insert(row.status);
  }
  EXPECT_EQ(seen.size(), kStatusCount) << "a status is missing in the table";
}

TEST(Warnings, AreASetWithNames) {
  std::set<std::string> names;
  for (std::size_t w = 0; w < kWarningCount; ++w) names.insert(to_string(static_cast<Warning>(w)));
  EXPECT_EQ(names.size(), kWarningCount);
  EXPECT_EQ(names.count("?"), 0u);
  Warnings warnings;
  EXPECT_TRUE(warnings.empty());
  warnings.add(Warning::keep_floor);
  warnings.add(Warning::scale_differs);
  EXPECT_TRUE(warnings.has(Warning::keep_floor) && warnings.has(Warning::scale_differs));
  EXPECT_FALSE(warnings.has(Warning::nothing_fits));
  EXPECT_NE(warnings, Warnings(Warning::keep_floor));
  std::string order;
  warnings.for_each([&](Warning warning) { order += to_string(warning) + std::string(" "); });
  EXPECT_EQ(order, "keep_floor scale_differs ");
}

TEST(Reason, EveryReasonHasItsOwnName) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kReasonCount; ++i) names.insert(to_string(static_cast<Reason>(i)));
  EXPECT_EQ(names.size(), kReasonCount);
  EXPECT_EQ(names.count("?"), 0u);
  EXPECT_STREQ(to_string(Reason::moving_cluster), "moving_cluster");
}

TEST(Verdict, Names) {
  EXPECT_STREQ(to_string(Verdict::kept), "kept");
  EXPECT_STREQ(to_string(Verdict::dynamic), "dynamic");
  EXPECT_STREQ(to_string(Verdict::unknown), "unknown");
}

TEST(Mobility, FixedIsWrittenAsThePapersStatic) {
  EXPECT_STREQ(to_string(Mobility::fixed), "static");
  EXPECT_STREQ(to_string(Mobility::movable), "movable");
  EXPECT_STREQ(to_string(Mobility::dynamic), "dynamic");
  EXPECT_STREQ(to_string(Mobility::unknown), "unknown");
}

TEST(FeatureScore, IsNotScoredByDefault) {
  EXPECT_FALSE(FeatureScore{}.scored());
  FeatureScore zero;
  zero.value = 0.0f;
  EXPECT_TRUE(zero.scored());
}

TEST(Timings, AddUpTheRunsOfAStage) {
  Timings timings;
  int runs = 0;
  timings.run(Stage::match, [&runs] { ++runs; });
  EXPECT_GE(timings[Stage::match], 0.0);
  timings.ms[static_cast<std::size_t>(Stage::match)] = 1000.0;
  timings.run(Stage::match, [&runs] { ++runs; });
  EXPECT_EQ(runs, 2);
  EXPECT_GE(timings[Stage::match], 1000.0);
  EXPECT_EQ(timings[Stage::score], 0.0);
  timings.ms = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(timings.total_ms(), 45.0);
  EXPECT_STREQ(to_string(Stage::prior), "prior");
  EXPECT_STREQ(to_string(Stage::verdict), "verdict");
}

}  // namespace
}  // namespace stillpoint
