// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/filter_frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "mock_policies.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/depth/no_depth_registration.hpp"
#include "stillpoint/depth/no_hole_filling.hpp"
#include "stillpoint/memory/no_memory.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/verdict/no_keep_floor.hpp"

namespace stillpoint::filter_frame_test {
namespace {

static_assert(is_memory<NoMemory>::value && !is_memory<NoKeepFloor>::value);
static_assert(is_keep_floor<NoKeepFloor>::value && !is_keep_floor<NoMemory>::value);
static_assert(PolicyContract<mock::Policies>::holds);

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kNoPixel = std::numeric_limits<float>::quiet_NaN();

class FrameFilterTest : public testing::Test {
 protected:
  FrameFilterTest() { mock::log_to(log_, filter_); }

  const FrameResult& at(double time_s) {
    return filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), time_s), keypoints_);
  }

  /// The frame is not judged: everything is kept, nothing is claimed.
  void expect_open(const FrameResult& result, Status status) {
    EXPECT_EQ(result.status(), status) << to_string(result.status());
    ASSERT_EQ(result.size(), keypoints_.size());
    ASSERT_EQ(result.keep().size(), keypoints_.size());
    EXPECT_EQ(result.kept_count(), keypoints_.size());
    EXPECT_FALSE(result.motion().usable());
    EXPECT_EQ(result.motion().status, status);
    EXPECT_EQ(result.keep_floor_kept(), 0u);
    for (std::size_t i = 0; i < result.size(); ++i) {
      EXPECT_EQ(result.keep()[i], 1);
      EXPECT_TRUE(result.label(i).keep);
      EXPECT_EQ(result.label(i).reason, Reason::not_judged);
      EXPECT_EQ(result.label(i).cluster, Label::kNoCluster);
      EXPECT_FALSE(result.score(i).scored());
      EXPECT_EQ(result.depth_m(i), 0.0);
    }
  }

  void expect_judged(const FrameResult& result, double reference_s) {
    EXPECT_EQ(result.status(), Status::ok) << to_string(result.status());
    EXPECT_EQ(filter_.matcher.reference_time_s, reference_s);
    EXPECT_EQ(result.motion().reference_timestamp_s, reference_s);
  }

  mock::Log log_;
  mock::Filter filter_{Camera(50, 50, 32, 24, 64, 48)};
  cv::Mat gray_ = cv::Mat(48, 64, CV_8UC1, cv::Scalar(7));
  cv::Mat depth_ = cv::Mat(48, 64, CV_16UC1, cv::Scalar(10000));
  std::vector<cv::KeyPoint> keypoints_ = {{10, 10, 7}, {20, 10, 7}, {30, 10, 7}, {40, 20, 7}, {50, 40, 7}};
};

TEST_F(FrameFilterTest, CallsEachStageOnceInTheOrderOfTheDataFlow) {
  at(1.0);
  EXPECT_EQ(log_.calls, (std::vector<std::string>{"matcher.reset", "memory.reset"})) << "nothing to compare with yet";
  log_.calls.clear();
  at(1.1);
  EXPECT_EQ(log_.calls, (std::vector<std::string>{"prior", "match", "motion", "score", "gate", "classify", "memory",
                                                  "keep_floor"}));
}

TEST_F(FrameFilterTest, HandsTheAnswersOfTheStagesOn) {
  at(1.0);
  const FrameResult& result = at(1.1);
  expect_judged(result, 1.0);
  ASSERT_EQ(result.size(), 5u);
  EXPECT_EQ(result.kept_count(), 3u);
  for (std::size_t i = 0; i < 5; ++i) {
    const bool kept = i % 2 == 0;
    EXPECT_EQ(result.keep()[i], kept ? 1 : 0);
    EXPECT_EQ(result.label(i).keep, kept);
    EXPECT_EQ(result.label(i).reason, kept ? Reason::static_cluster : Reason::moving_cluster);
    EXPECT_EQ(result.label(i).cluster, static_cast<int>(i));
    EXPECT_EQ(result.label(i).probability, 0.5f) << "the gate's threshold went to the classifier";
    EXPECT_EQ(result.score(i).value, static_cast<float>(i));
    EXPECT_EQ(result.depth_m(i), 2.0);  // 10000 / 5000
  }
  EXPECT_GE(result.timings().total_ms(), 0.0);
  std::vector<cv::KeyPoint> compacted = keypoints_;
  EXPECT_EQ(compact(result.keep(), compacted), 3u);
  EXPECT_EQ(compacted[1].pt.x, 30.0f);
}

TEST_F(FrameFilterTest, TheFirstFrameIsKept) {
  expect_open(at(1.0), Status::first_frame);
  filter_.reset();
  expect_open(at(1.1), Status::first_frame);
}

// Frames that are none: named, kept, and the filter goes on as if they had not been.
TEST_F(FrameFilterTest, RejectedFramesLeaveTheStateUntouched) {
  const cv::Mat none, short_integers(48, 64, CV_16SC3, cv::Scalar(0)), float_gray(48, 64, CV_32FC1, cv::Scalar(0)),
      other_size(24, 32, CV_8UC1, cv::Scalar(0)), long_depth(48, 64, CV_32SC1, cv::Scalar(0));
  struct Case {
    cv::Mat image, depth;
    double time_s;
    Status status;
  };
  at(0.9);
  at(1.0);
  for (const Case& c : {Case{none, depth_, 1.05, Status::no_image},
                        {short_integers, depth_, 1.05, Status::unsupported_image},
                        {float_gray, depth_, 1.05, Status::unsupported_image},
                        {gray_, long_depth, 1.05, Status::unsupported_image},
                        {other_size, depth_, 1.05, Status::size_changed},
                        {gray_, depth_, kNaN, Status::invalid_time},
                        {gray_, depth_, 1.0, Status::duplicate_frame}}) {
    log_.calls.clear();
    expect_open(filter_.filter_frame(FrameView(c.image, DepthView::tum(c.depth), c.time_s), keypoints_), c.status);
    EXPECT_TRUE(log_.calls.empty()) << "no stage is asked: " << to_string(c.status);
  }
  Pose expected = Pose::Identity();
  expected.translation() = Vector3d(1, 2, 3);
  filter_.expect_motion(expected);
  expect_open(at(1.0), Status::duplicate_frame);
  expect_judged(at(1.1), 1.0);
  EXPECT_EQ(filter_.matcher.reference_gray, 7);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference) << "the expectation waits for a frame";
  EXPECT_EQ(filter_.ego_motion.asked.current_from_reference->translation(), Vector3d(1, 2, 3));
}

TEST_F(FrameFilterTest, ATimeGapForgetsEverything) {
  at(1.0);
  at(1.1);
  log_.calls.clear();
  expect_open(at(2.2), Status::time_gap);
  EXPECT_EQ(log_.calls, (std::vector<std::string>{"matcher.reset", "memory.reset"}));
  expect_judged(at(2.3), 2.2);
  EXPECT_FALSE(filter_.ego_motion.asked.current_from_reference) << "no motion is known across the gap";
}

TEST_F(FrameFilterTest, TimeRunningBackwardsForgetsEverything) {
  at(10.0);
  at(10.1);
  log_.calls.clear();
  expect_open(at(5.0), Status::out_of_order);
  EXPECT_EQ(log_.calls, (std::vector<std::string>{"matcher.reset", "memory.reset"}));
  expect_judged(at(5.1), 5.0);
}

TEST_F(FrameFilterTest, AFrameWithoutKeypointsBecomesTheReference) {
  at(1.0);
  at(1.1);
  log_.calls.clear();
  const std::vector<cv::KeyPoint> none;
  gray_.setTo(55);
  const FrameResult& result = filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.2), none);
  EXPECT_EQ(result.status(), Status::no_keypoints);
  EXPECT_EQ(result.size(), 0u);
  EXPECT_EQ(result.kept_count(), 0u);
  EXPECT_FALSE(result.motion().usable());
  EXPECT_EQ(log_.calls,
            (std::vector<std::string>{"prior", "match", "motion", "score", "gate", "classify", "memory", "keep_floor"}))
      << "a matcher may have corners of its own";
  expect_judged(at(1.3), 1.2);
  EXPECT_EQ(filter_.matcher.reference_gray, 55);
  // The first frame is the first frame, with keypoints or without.
  filter_.reset();
  EXPECT_EQ(filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.4), none).status(), Status::first_frame);
}

TEST_F(FrameFilterTest, WithoutAMotionEverythingIsKeptAndTheFrameBecomesTheReference) {
  at(1.0);
  double reference_s = 1.0;
  for (const Status status :
       {Status::no_depth, Status::too_few_matches, Status::degenerate_geometry, Status::no_consensus}) {
    filter_.ego_motion.answer.status = status;
    log_.calls.clear();
    const double time_s = reference_s + 0.1;
    expect_open(at(time_s), status);
    EXPECT_EQ(log_.calls, (std::vector<std::string>{"prior", "match", "motion"}));
    EXPECT_EQ(filter_.matcher.reference_time_s, reference_s);
    reference_s = time_s;
  }
}

// The memory is told how old it is: 1.1 was judged last, the reference of 1.5 is 1.4.
TEST_F(FrameFilterTest, SaysHowLongNothingWasJudged) {
  at(1.0);
  at(1.1);
  EXPECT_EQ(filter_.memory.unjudged_s, 0.0);
  filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.2), std::vector<cv::KeyPoint>());
  filter_.ego_motion.answer.status = Status::no_consensus;
  at(1.3);
  at(1.4);
  filter_.ego_motion.answer.status = Status::ok;
  at(1.5);
  EXPECT_NEAR(filter_.memory.unjudged_s, 0.2, 1e-9) << "a frame without keypoints has been to the memory";
  at(1.6);
  EXPECT_EQ(filter_.memory.unjudged_s, 0.0);
  at(1.7);
  filter_.reset();
  at(1.8);
  at(1.9);
  EXPECT_EQ(filter_.memory.unjudged_s, 0.0);
}

TEST_F(FrameFilterTest, WarningsOfTheMotionAreThoseOfAJudgedFrame) {
  double time_s = 1.0;
  at(time_s);
  for (const Warning warning : {Warning::rotation_only, Warning::consensus_inverted}) {
    filter_.ego_motion.answer.warnings = warning;
    const FrameResult& result = at(time_s += 0.1);
    EXPECT_EQ(result.status(), Status::ok);
    EXPECT_EQ(result.warnings(), Warnings(warning));
    EXPECT_EQ(result.kept_count(), 3u);
  }
}

TEST_F(FrameFilterTest, SaysWhereTheKeepFloorActed) {
  filter_.keep_floor.lowest = 1;
  filter_.ego_motion.answer.warnings = Warning::consensus_inverted;
  at(1.0);
  const FrameResult& result = at(1.1);
  EXPECT_EQ(result.status(), Status::ok);
  EXPECT_TRUE(result.warnings().has(Warning::keep_floor));
  EXPECT_TRUE(result.warnings().has(Warning::consensus_inverted)) << "one hides no other";
  EXPECT_EQ(result.keep_floor_kept(), 1u);
  EXPECT_EQ(result.kept_count(), 4u);
  EXPECT_EQ(result.keep()[1], 1);
  EXPECT_EQ(result.label(1).reason, Reason::keep_floor);
  EXPECT_EQ(result.label(1).verdict, Verdict::dynamic);
  EXPECT_EQ(result.keep()[3], 0);
}

TEST_F(FrameFilterTest, TheMatchersOwnCornersAreInNoResult) {
  filter_.matcher.own_corners = 3;
  at(1.0);
  const FrameResult& result = at(1.1);
  EXPECT_EQ(filter_.ego_motion.features, 8u) << "they take part in the stages";
  EXPECT_EQ(filter_.ego_motion.memberships.size(), 8u);
  EXPECT_EQ(filter_.keep_floor.pixels_seen, 5u);
  EXPECT_EQ(filter_.keep_floor.labels_seen, 5u);
  ASSERT_EQ(result.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(result.score(i).value, static_cast<float>(i));
  filter_.matcher.own_corners = 0;
  at(1.2);
  EXPECT_EQ(filter_.ego_motion.features, 5u) << "those of the frame before are gone";
}

TEST_F(FrameFilterTest, ThePriorsRegionsReachTheMotion) {
  filter_.prior.detections = {{{15, 5, 10, 10}, Mobility::dynamic, 1.0f}};
  at(1.0);
  at(1.1);
  const std::vector<Membership>& memberships = filter_.ego_motion.memberships;
  ASSERT_EQ(memberships.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(memberships[i].in_dynamic, i == 1);
}

/// A prior that is carried along.
struct ObservingPrior : mock::Prior {
  std::size_t features = 0;
  double depth_m = 0, camera_x_m = 0;
  Status status = Status::first_frame;

  template <class Camera>
  void observe(const Observations& observations, const Motion& motion, const Camera&) {
    note("prior.observe");
    features = observations.size();
    depth_m = observations.matches.current.depth_m[0];
    camera_x_m = motion.current_from_reference.translation().x();
    status = motion.status;
  }
  void reset() { note("prior.reset"); }
};
struct ObservingPolicies : mock::Policies {
  using Prior = ObservingPrior;
};

TEST(FrameFilterWithAPriorThatObserves, ItIsToldOfEachMotionAndIsResetWithTheRest) {
  FrameFilter<ObservingPolicies> filter(Camera(50, 50, 31.5, 23.5, 64, 48));
  mock::Log log;
  filter.prior.log = filter.matcher.log = filter.ego_motion.log = filter.scorer.log = &log;
  filter.matcher.own_corners = 2;
  filter.ego_motion.answer.current_from_reference.translation().x() = 0.5;
  const cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(7)), depth(48, 64, CV_16UC1, cv::Scalar(10000));
  const std::vector<Vector2f> keypoints = {{5, 5}, {6, 6}};
  const auto at = [&](double time_s) { filter.filter_frame({gray, DepthView::tum(depth), time_s}, keypoints); };
  at(1.0);
  EXPECT_EQ(log.count("prior.observe"), 0u) << "nothing has moved yet";
  log.calls.clear();
  at(1.1);
  EXPECT_EQ(log.calls, (std::vector<std::string>{"prior", "match", "motion", "prior.observe", "score"}));
  EXPECT_EQ(filter.prior.features, 4u) << "the matcher's own corners are in it";
  EXPECT_EQ(filter.prior.depth_m, 2.0);
  EXPECT_EQ(filter.prior.camera_x_m, 0.5);
  filter.ego_motion.answer.status = Status::no_consensus;
  at(1.2);
  EXPECT_EQ(filter.prior.status, Status::no_consensus) << "features moved all the same";
  log.calls.clear();
  at(0.5);  // time runs backwards
  EXPECT_EQ(log.count("prior.reset"), 1u);
  filter.reset();
  EXPECT_EQ(log.count("prior.reset"), 2u);
}

/// A matcher that sees whole frames.
struct ContradictingMatcher : mock::Matcher {
  bool objects = false;
  mutable double camera_x_m = 0;

  template <class Camera>
  bool contradicts(const Pose& reference_from_current, const Camera&) const {
    note("matcher.contradicts");
    camera_x_m = reference_from_current.translation().x();
    return objects;
  }
};
struct ContradictingPolicies : mock::Policies {
  using Matcher = ContradictingMatcher;
};

// A motion is refused where it is in doubt and the whole frames speak against it; else it stays, and nobody is asked.
TEST(FrameFilterWithAMatcherThatContradicts, AMotionInDoubtNeedsTheFrames) {
  for (const auto& [is_doubtful, objects] : {std::pair{true, true}, {true, false}, {false, true}}) {
    FrameFilter<ContradictingPolicies> filter(Camera(50, 50, 31.5, 23.5, 64, 48));
    mock::Log log;
    filter.prior.log = filter.matcher.log = filter.ego_motion.log = filter.scorer.log = &log;
    filter.matcher.objects = objects;
    Motion& answer = filter.ego_motion.answer;
    answer.doubtful = is_doubtful;
    answer.current_from_reference.translation().x() = 0.5;
    answer.covariance.setIdentity();
    answer.warnings = Warning::consensus_inverted;
    answer.inliers = 4;
    answer.candidates = 10;
    const cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(7)), depth(48, 64, CV_16UC1, cv::Scalar(10000));
    const std::vector<Vector2f> keypoints = {{5, 5}, {6, 6}};
    filter.filter_frame({gray, DepthView::tum(depth), 1.0}, keypoints);
    log.calls.clear();
    const FrameResult& result = filter.filter_frame({gray, DepthView::tum(depth), 1.1}, keypoints);
    const bool is_refused = is_doubtful && objects;
    std::vector<std::string> calls = {"prior", "match", "motion"};
    if (is_doubtful) calls.emplace_back("matcher.contradicts");
    if (!is_refused) calls.emplace_back("score");
    EXPECT_EQ(log.calls, calls);
    if (is_doubtful) {
      EXPECT_EQ(filter.matcher.camera_x_m, -0.5) << "reference from current";
    }
    const Motion& motion = result.motion();
    EXPECT_EQ(result.status(), is_refused ? Status::no_consensus : Status::ok);
    EXPECT_EQ(motion.status, result.status());
    EXPECT_EQ(motion.candidates, 10);
    EXPECT_EQ(motion.inliers, is_refused ? 0 : 4);
    EXPECT_EQ(motion.current_from_reference.translation().x(), is_refused ? 0.0 : 0.5);
    EXPECT_EQ(motion.covariance.isZero(), is_refused);
    EXPECT_EQ(result.warnings(), is_refused ? Warnings() : Warnings(Warning::consensus_inverted));
    log.calls.clear();
    answer.status = Status::no_consensus;
    filter.filter_frame({gray, DepthView::tum(depth), 1.2}, keypoints);
    EXPECT_EQ(log.count("matcher.contradicts"), 0u) << "there is no motion to speak against";
  }
}

TEST_F(FrameFilterTest, ColourBecomesGray) {
  cv::Mat colour(48, 64, CV_8UC3, cv::Scalar(200, 100, 50)), expected;
  cv::cvtColor(colour, expected, cv::COLOR_BGR2GRAY);
  filter_.filter_frame(FrameView(colour, DepthView::tum(depth_), 1.0), keypoints_);
  filter_.filter_frame(FrameView(colour, DepthView::tum(depth_), 1.1), keypoints_);
  EXPECT_EQ(filter_.matcher.current_gray, expected.at<std::uint8_t>(0, 0));
  EXPECT_EQ(filter_.matcher.reference_gray, expected.at<std::uint8_t>(0, 0));
  EXPECT_EQ(filter_.prior.colour_format, PixelFormat::bgr8) << "a prior still sees the colours";
}

TEST_F(FrameFilterTest, ViewsMayDieAfterTheCall) {
  {
    auto gray = std::make_unique<cv::Mat>(48, 64, CV_8UC1, cv::Scalar(33));
    auto depth = std::make_unique<cv::Mat>(48, 64, CV_16UC1, cv::Scalar(5000));
    filter_.filter_frame(FrameView(*gray, DepthView::tum(*depth), 1.0), keypoints_);
    gray->setTo(99);
    depth->setTo(0);
  }
  at(1.1);
  EXPECT_EQ(filter_.matcher.reference_gray, 33);
  EXPECT_EQ(filter_.matcher.current_gray, 7);
}

TEST_F(FrameFilterTest, NothingOfTheHostsIsChanged) {
  const cv::Mat gray = gray_.clone(), depth = depth_.clone();
  const std::vector<cv::KeyPoint> keypoints = keypoints_;
  at(1.0);
  at(1.1);
  EXPECT_EQ(cv::norm(gray, gray_, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(depth, depth_, cv::NORM_INF), 0.0);
  ASSERT_EQ(keypoints.size(), keypoints_.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    EXPECT_EQ(keypoints[i].pt, keypoints_[i].pt);
    EXPECT_EQ(keypoints[i].class_id, keypoints_[i].class_id);
    EXPECT_EQ(keypoints[i].size, keypoints_[i].size);
  }
}

// ---- What is expected of the next motion ----

Pose pose(const Vector3d& rotation_vector, const Vector3d& translation) {
  Pose result = Pose::Identity();
  result.linear() = rotation_from_vector(rotation_vector);
  result.translation() = translation;
  return result;
}

TEST_F(FrameFilterTest, TheLastMotionIsExpectedAgain) {
  filter_.ego_motion.answer.current_from_reference = pose({0, 0, 0.1}, {1, 2, 3});
  at(1.0);
  at(1.1);
  EXPECT_FALSE(filter_.ego_motion.asked.current_from_reference);
  at(1.2);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0, 0.1}, {1, 2, 3})));
  filter_.ego_motion.answer.status = Status::no_consensus;
  at(1.3);
  at(1.4);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference) << "a motion that failed does not stop the camera";
  at(1.71);
  at(1.8);
  EXPECT_FALSE(filter_.ego_motion.asked.current_from_reference) << "half a second is long ago";
}

TEST_F(FrameFilterTest, TwiceTheTimeTwiceTheMotionIsExpected) {
  filter_.ego_motion.answer.current_from_reference = pose({0, 0.1, 0}, {0, 0, 1});
  at(1.0);
  at(1.1);
  at(1.3);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0.2, 0}, {0, 0, 2}), 1e-9));
}

// The camera stood at (1, 2, 3) and then at (2, 2, 3), turned by a quarter about z. In the frame of the second, the
// first is at R₂ᵀ (t₁ − t₂) = Rz(−90°) (−1, 0, 0) = (0, 1, 0), and R = Rz(−90°).
TEST_F(FrameFilterTest, TwoPosesOfTheHostPredictTheNextMotion) {
  const double quarter = std::acos(0.0);
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {1, 2, 3}));
  at(1.1);
  filter_.feedback(pose({0, 0, quarter}, {2, 2, 3}));
  at(1.2);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0, -quarter}, {0, 1, 0}), 1e-12));
  at(1.3);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(Pose::Identity()))
      << "without further feedback: the filter's own last motion";
}

TEST_F(FrameFilterTest, PosesThatAreNotOfConsecutiveFramesPredictNothing) {
  const Pose own = filter_.ego_motion.answer.current_from_reference = pose({0, 0.1, 0}, {0, 0, 1});
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {1, 0, 0}));
  at(1.1);  // the host was lost here
  at(1.2);
  filter_.feedback(pose({0, 0, 0}, {3, 0, 0}));
  at(1.3);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(own)) << "two steps are not one";
}

// The camera goes at 10 m/s. The host has a pose of the rejected frame at 1.15 s, too.
TEST_F(FrameFilterTest, APoseOfARejectedFrameIsNotThatOfTheLastOne) {
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {0, 0, 0}));
  at(1.1);
  filter_.feedback(pose({0, 0, 0}, {1, 0, 0}));
  expect_open(filter_.filter_frame(FrameView(cv::Mat(), DepthView::tum(depth_), 1.15), keypoints_), Status::no_image);
  filter_.feedback(pose({0, 0, 0}, {1.5, 0, 0}));
  at(1.2);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0, 0}, {-1, 0, 0})));
}

TEST_F(FrameFilterTest, ALaterPoseOfTheSameFrameReplacesTheEarlier) {
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {1, 0, 0}));
  at(1.1);
  filter_.feedback(pose({0, 0, 0}, {5, 0, 0}));
  filter_.feedback(pose({0, 0, 0}, {2, 0, 0}));  // after the host's bundle adjustment
  at(1.2);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0, 0}, {-1, 0, 0})));
}

TEST_F(FrameFilterTest, APoseThatIsNotFiniteIsNoPose) {
  const Pose own = filter_.ego_motion.answer.current_from_reference = pose({0, 0.1, 0}, {0, 0, 1});
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {1, 0, 0}));
  at(1.1);
  filter_.feedback(pose({0, 0, 0}, {kNaN, 0, 0}));
  filter_.expect_motion(pose({0, 0, 0}, {0, kNaN, 0}));
  at(1.2);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(own));
}

TEST_F(FrameFilterTest, AnExpectedMotionHoldsForOneFrame) {
  at(1.0);
  filter_.expect_motion(pose({0, 0, 0.2}, {1, 0, 0}));
  at(1.1);
  ASSERT_TRUE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(pose({0, 0, 0.2}, {1, 0, 0})));
  at(1.2);
  EXPECT_TRUE(filter_.ego_motion.asked.current_from_reference->isApprox(Pose::Identity()));
}

TEST_F(FrameFilterTest, ResetForgetsFramesAndPosesButNoSetting) {
  filter_.gate.level = 3.0;
  at(1.0);
  filter_.feedback(pose({0, 0, 0}, {1, 2, 3}));
  at(1.1);
  filter_.feedback(pose({0, 0, 0}, {2, 2, 3}));
  log_.calls.clear();
  filter_.reset();
  EXPECT_EQ(log_.count("matcher.reset"), 1u);
  EXPECT_EQ(log_.count("memory.reset"), 1u);
  expect_open(at(0.5), Status::first_frame);
  filter_.feedback(pose({0, 0, 0}, {9, 9, 9}));
  at(0.6);
  EXPECT_FALSE(filter_.ego_motion.asked.current_from_reference);
  EXPECT_EQ(filter_.gate.level, 3.0);
}

TEST_F(FrameFilterTest, TheStandOfTheCameraIsTheLastMotionsUntilReset) {
  at(1.0);
  filter_.ego_motion.answer.stationary = false;
  at(1.1);
  EXPECT_TRUE(filter_.ego_motion.asked.stationary) << "robots are switched on at rest";
  at(1.2);
  EXPECT_FALSE(filter_.ego_motion.asked.stationary);
  filter_.reset();
  at(1.3);
  at(1.4);
  EXPECT_TRUE(filter_.ego_motion.asked.stationary);
}

// ---- Keypoints and masks ----

TEST_F(FrameFilterTest, TakesAnyContiguousRangeOfKeypoints) {
  at(1.0);
  const std::vector<Eigen::Vector2d> doubles = {{10, 10}, {20, 10}};
  EXPECT_EQ(filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.1), doubles).size(), 2u);
  const std::array<cv::Point2f, 3> array = {cv::Point2f(1, 2), cv::Point2f(3, 4), cv::Point2f(5, 6)};
  EXPECT_EQ(filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.2), array).size(), 3u);
  const span<const cv::KeyPoint> part = span<const cv::KeyPoint>(keypoints_).first(4);
  EXPECT_EQ(filter_.filter_frame(FrameView(gray_, DepthView::tum(depth_), 1.3), part).size(), 4u);
}

TEST_F(FrameFilterTest, KeypointsThatAreNoneAreAnsweredToo) {
  keypoints_ = {{kNoPixel, 10, 7}, {-100, -100, 7}, {1e30f, 1e30f, 7}, {kNoPixel, kNoPixel, 7}, {63.9f, 47.9f, 7}};
  expect_open(at(1.0), Status::first_frame);
  const FrameResult& result = at(1.1);
  ASSERT_EQ(result.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(result.depth_m(i), 0.0) << i;
}

std::vector<std::string> drawn(const ImageBuffer& mask) {
  std::vector<std::string> rows;
  const ImageView view = mask.view();
  for (int v = 0; v < view.height; ++v) {
    rows.emplace_back();
    for (int u = 0; u < view.width; ++u) {
      const int value = view.row<std::uint8_t>(v)[u];
      rows.back() += value == 255 ? '#' : value == 0 ? '.' : '?';
    }
  }
  return rows;
}

// Radius 2: rows at distance 0, 1, 2 reach ⌊√4⌋ = 2, ⌊√3⌋ = 1, ⌊√0⌋ = 0 pixels to either side.
TEST(FrameResultMask, IsZeroInADiscAroundDroppedFeaturesAnd255Elsewhere) {
  mock::Filter filter(Camera(10, 10, 4, 3, 9, 7));
  const cv::Mat gray(7, 9, CV_8UC1, cv::Scalar(0));
  // Features 1 and 3 are dropped: at (3.6, 3.4), which rounds to (4, 3), and at the corner. 0 is kept; 5 is nowhere.
  const std::vector<Vector2f> keypoints = {{7, 0}, {3.6f, 3.4f}, {0, 0}, {8, 6}, {0, 0}, {1e30f, 1e30f}};
  filter.filter_frame(FrameView(gray, DepthView(), 1.0), keypoints);
  ImageBuffer mask;
  filter.filter_frame(FrameView(gray, DepthView(), 1.1), keypoints).mask(mask, 2);
  EXPECT_EQ(drawn(mask), (std::vector<std::string>{"#########",  //
                                                   "####.####",  //
                                                   "###...###",  //
                                                   "##.....##",  //
                                                   "###...##.",  //
                                                   "####.##..",  //
                                                   "######..."}));
}

TEST_F(FrameFilterTest, TheMaskOfAFrameThatWasNotJudgedKeepsAll) {
  ImageBuffer mask;
  at(1.0).mask(mask);
  EXPECT_EQ(mask.view().width, 64);
  EXPECT_EQ(mask.view().height, 48);
  EXPECT_EQ(cv::countNonZero(as_mat(mask.view()) != 255), 0);
  at(1.1).mask(mask, 0);  // radius 0: the pixel itself
  EXPECT_EQ(cv::countNonZero(as_mat(mask.view()) == 0), 2);
  EXPECT_EQ(as_mat(mask.view()).at<std::uint8_t>(10, 20), 0);
  EXPECT_EQ(as_mat(mask.view()).at<std::uint8_t>(20, 40), 0);
  at(1.2).mask(mask, 100000);
  EXPECT_EQ(cv::countNonZero(as_mat(mask.view())), 0) << "a disc that covers everything";
}

/// Says that depth is late, and gives 3 m everywhere in its place.
struct ThreeMetres : NoDepthRegistration {
  template <class Camera>
  DepthView undo(const FrameView&, const FrameView&, const Pose&, const Camera&) noexcept {
    return DepthView(undone_m);
  }
  template <class Camera>
  void observe(const FrameView& frame, const Matches&, span<const Label>, const Motion&, const Camera&) {
    observed = frame.depth.image.data;
  }
  Warnings warnings() const noexcept { return Warning::depth_unsynchronised; }

  cv::Mat undone_m = cv::Mat(48, 64, CV_32FC1, cv::Scalar(3.0));
  const std::uint8_t* observed = nullptr;
};
/// Which depth a matcher sees of the last frame, metres.
struct DepthMatcher : mock::Matcher {
  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    reference_m = reference.depth.metres(10, 10);
    mock::Matcher::match(reference, current, matches);
  }
  float reference_m = 0;
};
struct LateDepth : mock::Policies {
  using Matcher = DepthMatcher;
  using DepthRegistration = ThreeMetres;
};

/// A wall at 1 m, as the sensor sees it.
struct Wall {
  Camera camera{50, 50, 32, 24, 64, 48};
  cv::Mat gray = cv::Mat(48, 64, CV_8UC1, cv::Scalar(3)), depth_m = cv::Mat(48, 64, CV_32FC1, cv::Scalar(1.0));
  std::vector<Vector2f> keypoints = {{10, 10}, {20, 20}};

  FrameView at(double timestamp_s) const { return FrameView(gray, depth_m, timestamp_s); }
};

TEST(FrameFilter, UsesAndRemembersTheDepthOfTheImagesTimeAndObservesItAsItCame) {
  const Wall wall;
  FrameFilter<LateDepth> filter(wall.camera);
  filter.filter_frame(wall.at(1.0), wall.keypoints);
  const FrameResult& result = filter.filter_frame(wall.at(1.1), wall.keypoints);
  ASSERT_EQ(result.status(), Status::ok);
  EXPECT_EQ(result.depth_m(0), 3.0);
  EXPECT_EQ(filter.depth_registration.observed, wall.depth_m.data);
  filter.filter_frame(wall.at(1.2), wall.keypoints);
  EXPECT_EQ(filter.matcher.reference_m, 3.0f);
}

/// Fills the whole image with 2 m, and remembers what it was given.
struct TwoMetres : NoHoleFilling {
  template <class Camera, class Noise>
  DepthView fill(const FrameView& reference, const FrameView& current, const Pose&, const Camera&, const Noise&) {
    reference_m = reference.depth.metres(10, 10);
    current_m = current.depth.metres(10, 10);
    return DepthView(filled_m);
  }

  cv::Mat filled_m = cv::Mat(48, 64, CV_32FC1, cv::Scalar(2.0));
  float reference_m = 0, current_m = 0;
};
struct FilledDepth : LateDepth {
  using HoleFilling = TwoMetres;
};

TEST(FrameFilter, FillsHolesOfTheDepthOfTheImagesTimeAndRemembersThemFilled) {
  const Wall wall;
  FrameFilter<FilledDepth> filter(wall.camera);
  filter.filter_frame(wall.at(1.0), wall.keypoints);
  const FrameResult& result = filter.filter_frame(wall.at(1.1), wall.keypoints);
  EXPECT_EQ(result.depth_m(0), 2.0);
  EXPECT_EQ(filter.hole_filling.reference_m, 1.0f) << "the first frame is not judged: as it came";
  EXPECT_EQ(filter.hole_filling.current_m, 3.0f) << "undone";
  EXPECT_EQ(filter.depth_registration.observed, wall.depth_m.data) << "observed as it came";
  filter.filter_frame(wall.at(1.2), wall.keypoints);
  EXPECT_EQ(filter.hole_filling.reference_m, 2.0f);
}

TEST(FrameFilter, SaysThatDepthIsLateInFramesThatAreNotJudged) {
  const Wall wall;
  FrameFilter<LateDepth> filter(wall.camera);
  filter.filter_frame(wall.at(1.0), std::vector<Vector2f>{{10, 10}});
  const FrameResult& result = filter.filter_frame(wall.at(1.1), std::vector<Vector2f>{});
  EXPECT_EQ(result.status(), Status::no_keypoints);
  EXPECT_TRUE(result.warnings().has(Warning::depth_unsynchronised));
}

TEST(FrameFilter, WorksOnOnePixel) {
  mock::Filter filter(Camera(1, 1, 0, 0, 1, 1));
  const cv::Mat gray(1, 1, CV_8UC1, cv::Scalar(3)), depth(1, 1, CV_32FC1, cv::Scalar(1.0));
  const std::vector<Vector2f> keypoints = {{0, 0}, {0, 0}};
  filter.filter_frame(FrameView(gray, DepthView::tum(depth), 1.0), keypoints);
  const FrameResult& result = filter.filter_frame(FrameView(gray, DepthView::tum(depth), 1.1), keypoints);
  EXPECT_EQ(result.status(), Status::ok);
  EXPECT_EQ(result.depth_m(0), 1.0);
  ImageBuffer mask;
  result.mask(mask);
  EXPECT_EQ(mask.view().row<std::uint8_t>(0)[0], 0);
}

TEST(FrameFilter, TwoInTurnDoNotKnowOfEachOther) {
  mock::Filter a(Camera(50, 50, 32, 24, 64, 48)), b(Camera(50, 50, 32, 24, 64, 48));
  const cv::Mat dark(48, 64, CV_8UC1, cv::Scalar(1)), bright(48, 64, CV_8UC1, cv::Scalar(2));
  const std::vector<Vector2f> keypoints = {{1, 1}, {2, 2}};
  for (int i = 0; i < 3; ++i) {
    a.filter_frame(FrameView(dark, DepthView(), 1.0 + i * 0.1), keypoints);
    b.filter_frame(FrameView(bright, DepthView(), 77.0 - 0.01 * i), keypoints);  // always backwards
  }
  EXPECT_EQ(a.matcher.reference_gray, 1);
  EXPECT_EQ(a.matcher.reference_time_s, 1.1);
  EXPECT_EQ(b.matcher.reference_gray, -1) << "b never had a frame to compare with";
}

}  // namespace
}  // namespace stillpoint::filter_frame_test
