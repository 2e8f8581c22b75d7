// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/prior/propagated_prior.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint {
namespace {

static_assert(is_prior<PropagatedPrior>::value && observes<PropagatedPrior, Camera>::value);
static_assert(resets<PropagatedPrior>::value);
static_assert(!observes<BoxPrior, Camera>::value && !resets<BoxPrior>::value);

constexpr double kFrame_s = 0.1, kObject_m = 1.5, kWall_m = 3.0, kFocal_px = 100.0;

/// A thing 40 × 60 pixels large at 1.5 m before a wall at 3 m, seen by a camera of 320 × 240 pixels ten times per
/// second. Features lie on a grid of 6 pixels.
class PropagatedPriorTest : public testing::Test {
 protected:
  Detection seen(const Box& box, float confidence = 0.8f) const { return {box, Mobility::dynamic, confidence}; }
  double time_s(int frame) const { return kFrame_s * frame; }
  double now_s() const { return time_s(frame_); }

  /// What happens from one frame to the next.
  struct Change {
    Vector2f thing = Vector2f::Zero();  ///< pixels
    Vector2f wall = Vector2f::Zero();
    double camera_x_m = 0.0;  ///< of a static point in the camera's frame, of which the pipeline is told
    int skipped = 0;          ///< frames before this one, of which the prior is not told
    bool has_features = true, is_observed = true, is_motion_known = true;
  };

  /// The next frame goes by; returns the regions of it.
  Regions next(const Change& change) {
    frame_ += 1 + change.skipped;
    truth_.x += change.thing.x() * static_cast<float>(1 + change.skipped);
    truth_.y += change.thing.y() * static_cast<float>(1 + change.skipped);
    cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0)), depth(240, 320, CV_32FC1, cv::Scalar(kWall_m));
    const cv::Rect painted(cv::Point(static_cast<int>(truth_.x), static_cast<int>(truth_.y)),
                           cv::Size(static_cast<int>(truth_.width), static_cast<int>(truth_.height)));
    depth(painted & cv::Rect(0, 0, 320, 240)).setTo(object_m_);
    if (occluder_m_ > 0) depth.setTo(occluder_m_);
    Regions regions;
    prior_.regions(FrameView(gray, DepthView::tum(depth), now_s()), regions);
    if (!change.is_observed) return regions;
    Motion motion;
    motion.status = change.is_motion_known ? Status::ok : Status::no_consensus;
    motion.reference_timestamp_s = time_s(frame_ - 1);
    motion.current_from_reference.translation().x() = change.camera_x_m;
    prior_.observe(test::observations_of(change.has_features ? features(change) : Matches()), motion, camera_);
    return regions;
  }
  Regions next() { return next(Change{}); }

  Matches features(const Change& change) const {
    Matches matches;
    std::vector<Vector2f> pixels;
    for (int v = 3; v < 240; v += 6)
      for (int u = 3; u < 320; u += 6) pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
    matches.begin(pixels);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const bool on_thing = truth_.contains(pixels[i]);
      matches.reference.pixel[i] = pixels[i] - (on_thing ? change.thing : change.wall);
      matches.current.depth_m[i] = on_thing ? object_m_ : kWall_m;
      matches.reference.depth_m[i] = on_thing ? object_before_m_ : kWall_m;
      matches.state[i] = MatchState::matched;
    }
    matches.state[0] = MatchState::lost;
    matches.reference.pixel[0].setConstant(std::numeric_limits<float>::quiet_NaN());
    return matches;
  }

  void expect_at_truth(const Box& box, float tolerance_px = 0.01f) const { expect_box(box, truth_, tolerance_px); }
  /// Each side of an unseen box goes out by 0.2 of its size in a second.
  void expect_grown_from_truth(const Box& box, double unseen_s) const {
    const auto growth = static_cast<float>(0.2 * unseen_s);
    expect_box(box, {truth_.x - growth * truth_.width, truth_.y - growth * truth_.height,
                     truth_.width * (1 + 2 * growth), truth_.height * (1 + 2 * growth)});
  }
  static void expect_box(const Box& box, const Box& expected, float tolerance_px = 0.01f) {
    EXPECT_NEAR(box.x, expected.x, tolerance_px);
    EXPECT_NEAR(box.y, expected.y, tolerance_px);
    EXPECT_NEAR(box.width, expected.width, tolerance_px);
    EXPECT_NEAR(box.height, expected.height, tolerance_px);
  }
  const CarriedDetection& only_thing() const {
    EXPECT_EQ(prior_.objects().size(), 1u);
    return prior_.objects()[0];
  }

  Camera camera_ = Camera(kFocal_px, kFocal_px, 159.5, 119.5, 320, 240);
  PropagatedPrior prior_;
  int frame_ = 0;
  Box truth_ = {100, 80, 40, 60};
  double object_m_ = kObject_m, object_before_m_ = kObject_m, occluder_m_ = 0;
};

TEST_F(PropagatedPriorTest, WhatIsHandedOverIsOfTheComingFrameAsItIs) {
  prior_.detections = {seen(truth_), {{10, 10, 30, 30}, Mobility::fixed, 0.5f}};
  const Regions regions = next();
  ASSERT_EQ(regions.detections.size(), 2u);
  expect_box(regions.detections[0].box, truth_, 0.0f);
  EXPECT_EQ(regions.detections[0].confidence, 0.8f);
  EXPECT_NEAR(regions.detections[0].farthest_m, 1.6, 1e-6) << "with the depth of the thing";
  EXPECT_EQ(regions.detections[1].mobility, Mobility::fixed);
  EXPECT_TRUE(prior_.detections.empty()) << "they were of that frame, not of the next";
}

TEST_F(PropagatedPriorTest, WithoutAnyDetectionThereIsNothing) {
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(next({{3, 0}, {1, 0}}).detections.empty());
}

TEST_F(PropagatedPriorTest, AThingIsCarriedByTheFeaturesOnIt) {
  next();
  prior_.detections = {seen(truth_)};
  const Change change{{3, -1}, {-2, 0}};
  next(change);
  truth_ = prior_.objects()[0].detection.box;  // the box was that of the frame before it moved
  for (int i = 0; i < 8; ++i) {
    const Regions regions = next(change);
    ASSERT_EQ(regions.detections.size(), 1u);
    // The velocity was learnt in the frame of the detection.
    expect_grown_from_truth(regions.detections[0].box, (i + 1) * kFrame_s);
    expect_at_truth(only_thing().detection.box);
  }
}

TEST_F(PropagatedPriorTest, AThingThatChangesItsMindIsFollowedOneFrameLater) {
  prior_.detections = {seen(truth_)};
  next();
  for (const Vector2f& step : {Vector2f(4, 0), Vector2f(-4, 2), Vector2f(0, 0), Vector2f(2, -3)}) {
    next({step, {0, 0}});
    expect_at_truth(only_thing().detection.box);
  }
}

// Half of the grid's features in the box are the wall's, seen past the thing: of another depth, so they are not asked.
TEST_F(PropagatedPriorTest, TheWallBesideTheThingDoesNotCarryIt) {
  const Box wide = {truth_.x - 25, truth_.y, truth_.width + 50, truth_.height};
  prior_.detections = {seen(wide)};
  next();
  for (int i = 0; i < 5; ++i) next({{3, 0}, {-4, 0}});
  expect_box(only_thing().detection.box, {wide.x + 15, wide.y, wide.width, wide.height});
}

TEST_F(PropagatedPriorTest, WithoutFeaturesTheVelocityHolds) {
  next();
  prior_.detections = {seen(truth_)};
  next({{3, -1}, {0, 0}});
  truth_ = only_thing().detection.box;
  Change blind{{3, -1}, {0, 0}};
  for (int i = 0; i < 4; ++i) {
    blind.is_observed = i % 2 == 0;  // the frame was not judged: nobody told what moved
    blind.has_features = blind.is_motion_known = false;
    next(blind);
    expect_at_truth(only_thing().detection.box);
  }
}

TEST_F(PropagatedPriorTest, OverFramesThatWereSkippedTheVelocityHolds) {
  next();
  prior_.detections = {seen(truth_)};
  Change change{{3, -1}, {0, 0}};
  next(change);
  truth_ = only_thing().detection.box;
  next(change);
  change.skipped = 2;
  next(change);  // its features were followed over the last of three steps
  expect_at_truth(only_thing().detection.box);
}

// f t / z = 100 · 0.03 / 1.5 = 2 px a frame is the camera's share, 3 px the thing's own. Then the camera stops.
TEST_F(PropagatedPriorTest, WithoutFeaturesTheCamerasMotionIsKnown) {
  next();
  prior_.detections = {seen(truth_)};
  Change change{{5, 0}, {1, 0}};
  change.camera_x_m = 0.03;
  next(change);
  truth_ = only_thing().detection.box;
  EXPECT_NEAR(only_thing().own_velocity_px_s().x(), 3 / kFrame_s, 0.1);
  Change stopped{{3, 0}, {0, 0}};
  stopped.has_features = false;
  for (int i = 0; i < 4; ++i) {
    next(stopped);
    expect_at_truth(only_thing().detection.box, 0.05f);
  }
}

TEST_F(PropagatedPriorTest, WithoutFeaturesTwoAnswersTellTheVelocity) {
  Change blind;
  blind.has_features = blind.is_motion_known = false;
  prior_.detections = {seen(truth_)};
  next(blind);
  next(blind);
  truth_.x += 8;  // within two frames
  prior_.detections = {seen(truth_)};
  next(blind);
  blind.thing = {4, 0};
  next(blind);
  expect_at_truth(only_thing().detection.box);
}

// All depths shrink by 1/30: the thing grows by 30/29.
TEST_F(PropagatedPriorTest, WhatComesNearerGrows) {
  prior_.detections = {seen(truth_)};
  next();
  object_before_m_ = 1.5;
  object_m_ = 1.45;
  next();
  const float grown = 1.5f / 1.45f;
  expect_box(only_thing().detection.box, {120 - 20 * grown, 110 - 30 * grown, 40 * grown, 60 * grown});
  EXPECT_NEAR(only_thing().depth_m(), 1.45, 1e-6);
}

TEST_F(PropagatedPriorTest, TooFewFeaturesCarryNothing) {
  truth_ = {100, 80, 8, 14};  // holds three features of the grid, before and after the step
  prior_.detections = {seen(truth_)};
  next();
  next({{3, 0}, {0, 0}});
  expect_box(only_thing().detection.box, {100, 80, 8, 14});
}

TEST_F(PropagatedPriorTest, WhatIsNotSeenGrowsUncertain) {
  prior_.detections = {seen(truth_, 0.8f)};
  next();
  Regions regions;
  for (int i = 0; i < 5; ++i) regions = next();
  // Half a second: each side a tenth of the size farther out, half of a half-life for the confidence.
  ASSERT_EQ(regions.detections.size(), 1u);
  expect_box(regions.detections[0].box, {96, 74, 48, 72}, 1e-3f);
  EXPECT_NEAR(regions.detections[0].confidence, 0.8f / std::sqrt(2.0f), 1e-5f);
  expect_at_truth(only_thing().detection.box);  // only what is handed on grows
  prior_.options.lowest_confidence = 0.55f;     // 0.8 · 2^−0.6 is 0.53
  EXPECT_TRUE(next().detections.empty()) << "doubted";
  prior_.detections = {seen(truth_, 0.8f)};
  expect_box(next().detections.at(0).box, truth_, 0.0f);
}

TEST_F(PropagatedPriorTest, WhatIsNotSeenForLongIsForgotten) {
  prior_.carrying.longest_s = 0.45;
  prior_.detections = {seen(truth_)};
  next();
  for (int i = 1; i <= 4; ++i) EXPECT_EQ(next().detections.size(), 1u) << i;
  EXPECT_TRUE(next().detections.empty());
  EXPECT_TRUE(prior_.objects().empty());
}

TEST_F(PropagatedPriorTest, WhatIsMissedTooOftenIsForgotten) {
  prior_.detections = {seen(truth_)};
  next();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(next().detections.size(), 1u) << "no answer says nothing";
  for (int missed = 1; missed <= 8; ++missed) {
    prior_.detected(time_s(frame_ + 1), {});
    EXPECT_EQ(next().detections.size(), 1u);
    EXPECT_EQ(only_thing().missed, missed);
  }
  prior_.detected(time_s(frame_ + 1), {});
  EXPECT_TRUE(next().detections.empty()) << "the detector looked nine times and saw nothing";
}

TEST_F(PropagatedPriorTest, OneOfTwoIsMissed) {
  const Box other = {220, 90, 50, 80};
  prior_.detections = {seen(truth_), seen(other)};
  next();
  prior_.detections = {seen(other)};
  const Regions regions = next();
  ASSERT_EQ(regions.detections.size(), 2u);
  expect_box(regions.detections[0].box, other);  // what was seen comes first
  expect_grown_from_truth(regions.detections[1].box, kFrame_s);
  ASSERT_EQ(prior_.objects().size(), 2u);
  EXPECT_EQ(prior_.objects()[0].missed, 1);
  EXPECT_EQ(prior_.objects()[1].missed, 0);
  prior_.detections = {seen(truth_), seen(other)};
  EXPECT_EQ(next().detections.size(), 2u) << "seen again, not seen anew";
  EXPECT_EQ(prior_.objects()[0].missed, 0);
}

TEST_F(PropagatedPriorTest, ADetectionRefreshesTheThingThatItOverlapsMost) {
  const Box beside = {truth_.x + 16, truth_.y, truth_.width, truth_.height};
  prior_.detections = {seen(truth_), seen(beside)};
  next();
  // Each of the two overlaps both things; the order of an answer means nothing.
  const Box first = {truth_.x + 2, truth_.y, 40, 60}, second = {beside.x + 2, beside.y, 40, 60};
  prior_.detections = {seen(second), seen(first)};
  next();
  ASSERT_EQ(prior_.objects().size(), 2u);
  expect_box(prior_.objects()[0].detection.box, first);
  expect_box(prior_.objects()[1].detection.box, second);
}

TEST_F(PropagatedPriorTest, ADetectionElsewhereOrOfAnotherKindIsANewThing) {
  prior_.detections = {seen(truth_)};
  next();
  prior_.detections = {{truth_, Mobility::movable, 1.0f}, seen({200, 20, 40, 60})};
  EXPECT_EQ(next().detections.size(), 3u);
}

TEST_F(PropagatedPriorTest, ALateAnswerIsCarriedFromItsFrame) {
  const Change change{{3, -1}, {-1, 0}};
  for (int i = 0; i < 4; ++i) next(change);
  const Box then = truth_;
  const double then_s = now_s();
  for (int i = 0; i < 9; ++i) next(change);
  prior_.detected(then_s + 0.02, {seen(then)});  // clocks differ a little: the nearest frame is meant
  expect_at_truth(only_thing().detection.box);
  EXPECT_EQ(only_thing().seen_s, then_s);
  EXPECT_NEAR(only_thing().depth_m(), kObject_m, 1e-6) << "from the coarse depth of that frame";
  const Regions regions = next(change);
  ASSERT_EQ(regions.detections.size(), 1u);
  expect_grown_from_truth(regions.detections[0].box, now_s() - then_s);
}

TEST_F(PropagatedPriorTest, ALateAnswerRefreshesWhatIsCarried) {
  const Change change{{3, 0}, {0, 0}};
  prior_.detections = {seen(truth_)};
  next();
  for (int i = 0; i < 4; ++i) next(change);
  Box better = truth_;  // the detector now sees more of it
  better.height += 10;
  const double then_s = now_s();
  for (int i = 0; i < 5; ++i) next(change);
  prior_.detected(then_s, {seen(better)});
  EXPECT_EQ(only_thing().seen_s, then_s);
  expect_box(only_thing().detection.box, {truth_.x, truth_.y, 40, 70});
}

TEST_F(PropagatedPriorTest, AnswersOfTheFrameThatCameLastAndOfTheComingOne) {
  next();
  next();
  prior_.detected(now_s(), {seen(truth_)});
  expect_at_truth(only_thing().detection.box);
  prior_.detected(time_s(frame_ + 1), {seen({truth_.x + 5, truth_.y, 40, 60})});
  EXPECT_EQ(prior_.detections.size(), 1u) << "waits for its frame";
  const Regions regions = next({{5, 0}, {0, 0}});
  ASSERT_EQ(regions.detections.size(), 1u);
  expect_box(regions.detections[0].box, truth_, 0.0f);
  EXPECT_EQ(only_thing().seen_s, now_s());
}

TEST_F(PropagatedPriorTest, ALateAnswersDepthIsThatOfItsFrame) {
  next();
  next();
  occluder_m_ = 0.6;  // since then something has passed before it
  next();
  next();
  prior_.detected(time_s(2), {seen(truth_)});
  EXPECT_NEAR(only_thing().depth_m(), kObject_m, 1e-6);
}

TEST_F(PropagatedPriorTest, ALateAnswerThatIsDoubtedIsNone) {
  prior_.options.lowest_confidence = 0.5f;
  next();
  next();
  prior_.detected(now_s(), {seen(truth_, 0.4f)});
  EXPECT_TRUE(prior_.objects().empty());
}

// The pipeline asks for regions from its second frame on, and detectors begin with the first.
TEST_F(PropagatedPriorTest, ALateAnswerOfTheFrameBeforeTheFirstIsTaken) {
  const Box first = truth_;
  for (int i = 0; i < 5; ++i) next();
  prior_.detected(time_s(0), {seen(first)});
  expect_box(only_thing().detection.box, first);
}

TEST_F(PropagatedPriorTest, AnswersThatCameTooLateAreIgnored) {
  for (int i = 0; i < 4; ++i) next();
  prior_.detected(time_s(3), {seen(truth_)});
  prior_.detected(time_s(3), {});
  prior_.detected(time_s(2), {seen({200, 20, 40, 60})});
  EXPECT_EQ(only_thing().missed, 0);
  prior_.reset();
  for (std::size_t i = 0; i < ImageMotions::kCapacity + 4; ++i) next();
  prior_.carrying.longest_s = 1e9;
  prior_.detected(time_s(6), {seen(truth_)});
  EXPECT_TRUE(prior_.objects().empty()) << "nobody remembers that frame";
  prior_.detected(std::numeric_limits<double>::quiet_NaN(), {seen(truth_)});
  EXPECT_TRUE(prior_.objects().empty());
}

TEST_F(PropagatedPriorTest, AMaskGoesAlong) {
  Detection masked = seen(truth_);
  masked.mask = std::make_shared<const BoxMask>(BoxMask{2, 1, {1, 0}});  // the left half
  prior_.detections = {masked};
  next();
  const Regions regions = (next({{6, 0}, {0, 0}}), next({{6, 0}, {0, 0}}));
  ASSERT_EQ(regions.detections.size(), 1u);
  EXPECT_EQ(regions.detections[0].mask, masked.mask);
  EXPECT_TRUE(regions.detections[0].holds({truth_.x + 10, truth_.y + 30}, kObject_m));
  EXPECT_FALSE(regions.detections[0].holds({truth_.x + 30, truth_.y + 30}, kObject_m));
}

TEST_F(PropagatedPriorTest, DepthSeparatesACarriedThingFromWhatIsBehindAndBefore) {
  prior_.detections = {seen(truth_)};
  next();
  const Regions regions = next({{3, 0}, {0, 0}});
  EXPECT_FALSE(regions.detections.at(0).holds({truth_.x + 20, truth_.y + 30}, kWall_m));
  EXPECT_TRUE(regions.detections.at(0).holds({truth_.x + 20, truth_.y + 30}, kObject_m));
  occluder_m_ = 0.6;
  const Regions hidden = next();
  EXPECT_NEAR(hidden.detections.at(0).nearest_m, 1.4, 1e-6) << "something passes before it: its depth stays";
  EXPECT_NEAR(hidden.detections.at(0).farthest_m, 1.6, 1e-6);
}

TEST_F(PropagatedPriorTest, AnEdgeAtThePicturesBorderStaysThere) {
  truth_ = {2, 80, 40, 60};  // somebody comes in from the left: more of them follows
  prior_.detections = {seen(truth_)};
  next();
  next({{8, 0}, {0, 0}});
  expect_box(only_thing().detection.box, {0, 80, 50, 60});
  prior_.reset();
  truth_ = {280, 180, 38, 59};  // and from the right, below
  prior_.detections = {seen(truth_)};
  next();
  next({{-8, -6}, {0, 0}});
  expect_box(only_thing().detection.box, {272, 174, 48, 66});
}

TEST_F(PropagatedPriorTest, WhatHasLeftThePictureIsForgotten) {
  truth_ = {250, 80, 40, 60};
  next();
  prior_.detections = {seen(truth_)};
  Change change{{20, 0}, {0, 0}};
  next(change);
  change.has_features = change.is_motion_known = false;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(next(change).detections.size(), 1u);
  EXPECT_TRUE(next(change).detections.empty()) << "its left edge is at 250 + 4 · 20 = 330";
}

TEST_F(PropagatedPriorTest, WhatIsNoDetectionIsNotCarried) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  prior_.detections = {seen({kNaN, 0, 10, 10}), seen({0, 0, -5, 10}), seen(truth_)};
  EXPECT_EQ(next().detections.size(), 1u);
  next();
  prior_.detected(now_s(), {seen({0, kNaN, 10, 10}), seen(truth_)});
  EXPECT_EQ(prior_.objects().size(), 1u);
}

TEST_F(PropagatedPriorTest, ResetForgetsThingsAndFrames) {
  prior_.detections = {seen(truth_)};
  next();
  prior_.reset();
  EXPECT_TRUE(prior_.objects().empty());
  prior_.detections = {seen(truth_)};
  prior_.reset();
  EXPECT_EQ(prior_.detections.size(), 1u) << "of the coming frame";
  frame_ = -50;  // a recording begins anew
  EXPECT_EQ(next().detections.size(), 1u);
}

// A bag of 2 s that plays in a loop: nothing that was seen before the reset can be as late as this.
TEST_F(PropagatedPriorTest, TheSecondRoundOfARecordingIsAnsweredToItsEnd) {
  for (int i = 0; i < 40; ++i) next();
  prior_.reset();
  frame_ = -1;
  for (int i = 0; i < 40; ++i) {
    next();
    if (now_s() <= prior_.carrying.longest_s) continue;
    prior_.detected(now_s(), {seen(truth_)});
    ASSERT_EQ(prior_.objects().size(), 1u) << now_s();
  }
}

// At 5 Hz who goes away at 1.3 m/s is 0.26 m farther in each frame.
TEST_F(PropagatedPriorTest, AtLowRatesDepthMayChangeByMore) {
  prior_.detections = {seen(truth_)};
  next();
  for (int i = 0; i < 4; ++i) {
    object_before_m_ = object_m_;
    object_m_ += 0.26;
    next({Vector2f::Zero(), Vector2f::Zero(), 0.0, 1});
    EXPECT_NEAR(only_thing().depth_m(), object_m_, 1e-6) << i;
  }
}

// A detector that runs beside the filter answers after the filter was reset.
TEST_F(PropagatedPriorTest, AnswersOfFramesBeforeAResetAreIgnored) {
  for (int i = 0; i < 3; ++i) next();
  prior_.reset();
  prior_.detected(now_s(), {seen(truth_)});
  EXPECT_TRUE(next().detections.empty()) << "of another place";
  prior_.reset();
  prior_.detected(time_s(frame_ + 1), {seen(truth_)});
  EXPECT_EQ(next().detections.size(), 1u) << "of the coming frame";
  prior_.reset();
  frame_ = -50;  // a recording begins anew
  next();
  prior_.detected(now_s(), {seen(truth_)});
  EXPECT_EQ(prior_.objects().size(), 1u);
}

TEST_F(PropagatedPriorTest, WithoutDepthTheFeaturesInTheBoxCarryIt) {
  Regions regions;
  Box box = {100, 80, 40, 60};
  prior_.detections = {seen(box)};
  Motion motion;
  for (int f = 0; f < 6; ++f) {
    const cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0));
    prior_.regions(FrameView(gray, DepthView(), 0.1 * f), regions);
    Matches matches = features({{3, 0}, {3, 0}});
    for (double& depth_m : matches.current.depth_m) depth_m = 0;
    prior_.observe(test::observations_of(matches), motion, camera_);
    if (f > 0) box.x += 3;
    expect_box(only_thing().detection.box, box);
    EXPECT_FALSE(only_thing().has_depth_range());
  }
}

// A method without depth over images with depth: no feature has one, and the motion is a direction of length 1. Taken
// for a metre, at 1.5 m, it would be 67 px a frame.
TEST_F(PropagatedPriorTest, AMethodWithoutDepthCarriesBoxesOfImagesWithDepth) {
  Regions regions;
  Box box = {100, 80, 40, 60};
  prior_.detections = {seen(box)};
  Motion motion;
  motion.status = Status::ok;
  motion.metric = false;
  motion.current_from_reference.translation() = Vector3d(1, 0, 0);
  for (int f = 0; f < 6; ++f) {
    const cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(0)), depth(240, 320, CV_32FC1, cv::Scalar(kObject_m));
    prior_.regions(FrameView(gray, DepthView::tum(depth), 0.1 * f), regions);
    motion.reference_timestamp_s = 0.1 * (f - 1);
    Matches matches = features({{3, 0}, {3, 0}});
    for (FrameFeatures* side : {&matches.reference, &matches.current})
      std::fill(side->depth_m.begin(), side->depth_m.end(), 0.0);
    prior_.observe(test::observations_of(matches), motion, camera_);
    if (f > 0) box.x += 3;
    expect_box(only_thing().detection.box, box);
  }
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
static_assert(std::is_same_v<decltype(std::declval<const PropagatedPrior&>().things()), span<const CarriedDetection>>,
              "objects() was things() in 0.1");
#pragma GCC diagnostic pop

// A driver delivers two frames in a burst: 6 px within a millisecond are no velocity.
TEST(PropagatedPriorStamps, NextToEachOtherTakeNoBoxAway) {
  constexpr double kInterval_s = 1.0 / 30.0;
  const Camera camera(525, 525, 319.5, 239.5, 640, 480);
  const cv::Mat gray(480, 640, CV_8UC1, cv::Scalar(100));
  for (const double burst_s : {1e-6, 1e-3, 5e-3}) {
    PropagatedPrior prior;
    double before_s = 0.0;
    for (int f = 0; f < 12; ++f) {
      const double now_s = 1.0 + kInterval_s * f - (f == 6 ? kInterval_s - burst_s : 0.0);
      const Box walker{200.0f + 6.0f * static_cast<float>(f), 100, 80, 200};
      if (f == 0) prior.detections = {{walker, Mobility::dynamic, 1.0f}};
      Regions regions;
      prior.regions(FrameView(gray, DepthView(), now_s), regions);
      ASSERT_EQ(regions.detections.size(), 1u) << burst_s << " s, frame " << f;
      EXPECT_NEAR(regions.detections[0].box.x, walker.x, 40.0f) << burst_s << " s, frame " << f;
      std::vector<Vector2f> pixels;
      for (int k = 0; k < 80; ++k) {
        const Vector2f step(static_cast<float>(9 * (k % 8)), static_cast<float>(35 * (k / 8 % 5)));
        pixels.push_back(k < 40 ? Vector2f(walker.x + 5, 110) + step : Vector2f(10, 20) + step);
      }
      Matches matches;
      matches.begin(pixels);
      for (std::size_t i = 0; i < matches.size(); ++i) {
        matches.state[i] = MatchState::matched;
        matches.reference.pixel[i] = pixels[i] - (i < 40 ? Vector2f(6, 0) : Vector2f(0, 0));
      }
      Motion motion;
      motion.status = Status::ok;
      motion.reference_timestamp_s = before_s;
      if (f > 0) prior.observe(test::observations_of(std::move(matches)), motion, camera);
      before_s = now_s;
    }
  }
}

}  // namespace
}  // namespace stillpoint
