// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/filtered_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stillpoint/core/compact.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/null_filter.hpp"

namespace {

using stillpoint::FilteredTracker;
using stillpoint::FrameView;
using stillpoint::Motion;
using stillpoint::NullFilter;
using stillpoint::Pose;
using stillpoint::span;
using stillpoint::Status;
using stillpoint::Vector2f;

using Log = std::shared_ptr<std::vector<std::string>>;

Pose at_x(double x_m) {
  Pose pose = Pose::Identity();
  pose.translation().x() = x_m;
  return pose;
}

struct Features {
  std::vector<Vector2f> keypoints;
  std::vector<int> ids;
  Log log;
  std::vector<float> weights = {};

  void weigh(span<const float> some) {
    if (log) log->push_back("weigh");
    weights.assign(some.begin(), some.end());
  }

  void compact(span<const std::uint8_t> keep) {
    if (log) log->push_back("compact");
    stillpoint::compact(keep, keypoints, ids);
    if (!weights.empty()) stillpoint::compact(keep, weights);
  }
};

/// Five features a frame, the id of each ten times its x; the pose is what the test sets.
struct MockBackend {
  Log log = std::make_shared<std::vector<std::string>>();
  std::optional<Pose> pose = at_x(1.0);
  Features tracked;
  std::vector<double> feedback_x_m, expected_x_m;

  Features extract(const FrameView&) {
    log->push_back("extract");
    Features features;
    for (int i = 0; i < 5; ++i) {
      features.keypoints.emplace_back(static_cast<float>(i), 0.0f);
      features.ids.push_back(10 * i);
    }
    features.log = log;
    return features;
  }

  std::optional<Pose> track(const FrameView&, const Features& features) {
    log->push_back("track");
    tracked = features;
    return pose;
  }

  void expect_motion(const Pose& current_from_reference) {
    log->push_back("backend.expect_motion");
    expected_x_m.push_back(current_from_reference.translation().x());
  }

  void feedback(const Pose& world_from_camera) {
    log->push_back("backend.feedback");
    feedback_x_m.push_back(world_from_camera.translation().x());
  }
};

struct MockResult {
  std::vector<std::uint8_t> flags;
  Motion found;
  span<const std::uint8_t> keep() const { return flags; }
  const Motion& motion() const { return found; }
};

/// The weight of each is a quarter of its place.
void weights(const MockResult& result, std::vector<float>& found) {
  found.clear();
  for (std::size_t i = 0; i < result.flags.size(); ++i) found.push_back(0.25f * static_cast<float>(i));
}

struct MockFilter {
  Log log;
  std::vector<std::uint8_t> flags{1, 0, 1, 0, 1};
  Motion motion;
  std::vector<double> feedback_x_m;

  MockResult filter_frame(const FrameView&, const std::vector<Vector2f>&) {
    log->push_back("filter_frame");
    return {flags, motion};
  }

  void feedback(const Pose& world_from_camera) {
    log->push_back("filter.feedback");
    feedback_x_m.push_back(world_from_camera.translation().x());
  }
};

/// The least a backend may be: no feedback.
struct MinimalBackend {
  std::size_t tracked_count = 0;
  Features extract(const FrameView&) { return {{{1, 2}, {3, 4}}, {7, 8}, nullptr}; }
  Pose track(const FrameView&, const Features& features) {
    tracked_count = features.keypoints.size();
    return at_x(2.0);
  }
};

FilteredTracker<MockFilter, MockBackend> mock_tracker() {
  MockBackend backend;
  MockFilter filter;
  filter.log = backend.log;
  return {filter, backend};
}

TEST(FilteredTracker, CallsEachPartOnceInOrder) {
  auto tracker = mock_tracker();
  tracker.track(FrameView{});
  const std::vector<std::string> expected{"extract", "filter_frame",    "weigh",           "compact",
                                          "track",   "filter.feedback", "backend.feedback"};
  EXPECT_EQ(*tracker.backend.log, expected);
}

TEST(FilteredTracker, WeightsGoWithTheirFeatures) {
  auto tracker = mock_tracker();
  tracker.track(FrameView{});
  EXPECT_EQ(tracker.backend.tracked.weights, (std::vector<float>{0.0f, 0.5f, 1.0f}));
}

TEST(FilteredTracker, AFilterWithoutWeightsWeighsNothing) {
  FilteredTracker<NullFilter, MockBackend> tracker(NullFilter{}, MockBackend{});
  tracker.track(FrameView{});
  EXPECT_TRUE(tracker.backend.tracked.weights.empty());
}

TEST(FilteredTracker, TracksOnlyWhatIsKeptAndKeepsArraysAligned) {
  auto tracker = mock_tracker();
  tracker.track(FrameView{});
  EXPECT_EQ(tracker.backend.tracked.ids, (std::vector<int>{0, 20, 40}));
  ASSERT_EQ(tracker.backend.tracked.keypoints.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(static_cast<int>(tracker.backend.tracked.keypoints[i].x()) * 10, tracker.backend.tracked.ids[i]);
}

TEST(FilteredTracker, ReturnsThePoseAndFeedsItBackToBothSides) {
  auto tracker = mock_tracker();
  const std::optional<Pose> pose = tracker.track(FrameView{});
  ASSERT_TRUE(pose.has_value());
  EXPECT_EQ(pose->translation().x(), 1.0);
  EXPECT_EQ(tracker.filter.feedback_x_m, std::vector<double>{1.0});
  EXPECT_EQ(tracker.backend.feedback_x_m, std::vector<double>{1.0});
}

TEST(FilteredTracker, TellsTheBackendTheFiltersMotion) {
  auto tracker = mock_tracker();
  tracker.filter.motion.status = Status::ok;
  tracker.filter.motion.current_from_reference = at_x(0.25);
  tracker.track(FrameView{});
  EXPECT_EQ(tracker.backend.expected_x_m, std::vector<double>{0.25});
  const std::vector<std::string> expected{"extract",         "filter_frame",          "weigh",
                                          "compact",         "backend.expect_motion", "track",
                                          "filter.feedback", "backend.feedback"};
  EXPECT_EQ(*tracker.backend.log, expected);
}

TEST(FilteredTracker, TellsTheBackendNoMotionThatIsNone) {
  auto tracker = mock_tracker();
  for (const Status status : {Status::first_frame, Status::no_depth, Status::no_consensus}) {
    tracker.filter.motion.status = status;
    tracker.track(FrameView{});
  }
  tracker.filter.motion.status = Status::ok;
  tracker.filter.motion.metric = false;  // nobody knows how long it is
  tracker.track(FrameView{});
  EXPECT_TRUE(tracker.backend.expected_x_m.empty());
}

// The third frame has depth of kilometres: the filter refuses it, the backend sees it. The filter's next motion goes
// back to the second.
TEST(FilteredTracker, TellsTheBackendNoMotionThatReachesBackOverAFrame) {
  auto tracker = mock_tracker();
  Motion& motion = tracker.filter.motion;
  motion.current_from_reference = at_x(0.25);
  const auto track_at = [&](double timestamp_s, Status status, double reference_timestamp_s) {
    motion.status = status;
    motion.reference_timestamp_s = reference_timestamp_s;
    FrameView frame;
    frame.timestamp_s = timestamp_s;
    tracker.track(frame);
    return tracker.backend.expected_x_m.size();
  };
  track_at(1.0, Status::first_frame, std::nan(""));
  EXPECT_EQ(track_at(2.0, Status::ok, 1.0), 1u);
  EXPECT_EQ(track_at(3.0, Status::implausible_depth, std::nan("")), 1u);
  EXPECT_EQ(track_at(4.0, Status::ok, 2.0), 1u);
  EXPECT_EQ(track_at(5.0, Status::ok, 4.0), 2u);
}

TEST(FilteredTracker, TellsTheFilterNothingThatIsNotToBelieveTheBackend) {
  auto tracker = mock_tracker();
  tracker.tells_filter = false;
  EXPECT_TRUE(tracker.track(FrameView{}).has_value());
  EXPECT_TRUE(tracker.filter.feedback_x_m.empty());
  EXPECT_EQ(tracker.backend.feedback_x_m, std::vector<double>{1.0});
}

TEST(FilteredTracker, FeedsNothingBackWithoutAPoseAndGoesOn) {
  auto tracker = mock_tracker();
  tracker.backend.pose.reset();
  EXPECT_FALSE(tracker.track(FrameView{}).has_value());
  EXPECT_TRUE(tracker.filter.feedback_x_m.empty());
  EXPECT_TRUE(tracker.backend.feedback_x_m.empty());
  tracker.backend.pose = at_x(3.0);
  EXPECT_TRUE(tracker.track(FrameView{}).has_value());
  EXPECT_EQ(tracker.filter.feedback_x_m, std::vector<double>{3.0});
}

TEST(FilteredTracker, ShowsAllKeypointsToTheObserverBeforeCompaction) {
  auto tracker = mock_tracker();
  std::size_t keypoint_count = 0, flag_count = 0;
  tracker.track(FrameView{}, [&](const auto& keypoints, const auto& result) {
    keypoint_count = keypoints.size();
    flag_count = result.keep().size();
  });
  EXPECT_EQ(keypoint_count, 5u);
  EXPECT_EQ(flag_count, 5u);
}

TEST(FilteredTracker, ThrowsWhereTheFilterGivesTooFewFlags) {
  auto tracker = mock_tracker();
  tracker.filter.flags = {1, 0, 1};
  EXPECT_THROW(tracker.track(FrameView{}), stillpoint::Error);
}

TEST(FilteredTracker, NeedsNoFeedbackOfEitherSide) {
  FilteredTracker<NullFilter, MinimalBackend> tracker(NullFilter{}, MinimalBackend{});
  EXPECT_TRUE(tracker.track(FrameView{}).has_value());
  EXPECT_EQ(tracker.backend.tracked_count, 2u);
}

TEST(NullFilter, KeepsEveryKeypointOfEachFrame) {
  NullFilter filter;
  for (const std::size_t count : {std::size_t{3}, std::size_t{0}, std::size_t{5}}) {
    const span<const std::uint8_t> keep = filter.filter_frame(FrameView{}, std::vector<Vector2f>(count)).keep();
    ASSERT_EQ(keep.size(), count);
    for (const std::uint8_t flag : keep) EXPECT_EQ(flag, 1);
  }
}

TEST(TrackerContract, TellsWhatIsMissing) {
  struct Nothing {};
  static_assert(stillpoint::has_extract<MinimalBackend>::value && !stillpoint::has_extract<Nothing>::value);
  static_assert(stillpoint::has_keypoints<Features>::value && !stillpoint::has_keypoints<Nothing>::value);
  static_assert(stillpoint::has_compact<Features>::value && !stillpoint::has_compact<Nothing>::value);
  static_assert(stillpoint::has_track<MinimalBackend, Features>::value);
  static_assert(!stillpoint::has_track<Nothing, Features>::value);
  static_assert(stillpoint::has_filter_frame<NullFilter, Features>::value);
  static_assert(!stillpoint::has_filter_frame<Nothing, Features>::value);
  static_assert(!stillpoint::has_feedback<NullFilter>::value && stillpoint::has_feedback<MockFilter>::value);
}

}  // namespace
