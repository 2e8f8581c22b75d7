// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Where is a camera expected before its features are found again?

#include "backends/keyframe_pose.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "backends/orb_features.hpp"
#include "observations.hpp"

namespace {

using stillpoint::Pose;

/// A camera that stands two metres before a wall with 120 features, of which the test says how many are found again.
class StandingTracker : public testing::Test {
 protected:
  StandingTracker() {
    for (int i = 0; i < 120; ++i) {
      const auto column = static_cast<float>(i % 12), row = static_cast<float>(i / 12);
      features_.keypoints.emplace_back(50.0f + 45.0f * column, 50.0f + 38.0f * row, 31.0f);
    }
    track(0);  // the first keyframe
  }

  stillpoint::FrameView view() const {
    const stillpoint::ImageView depth(depth_.data(), 640, 480, 640 * sizeof(std::uint16_t),
                                      stillpoint::PixelFormat::depth16);
    stillpoint::FrameView frame;
    frame.depth = stillpoint::DepthView(depth, 5000.0);
    return frame;
  }

  /// @param found  so many of the features
  /// @return       camera_from_world as it was expected first
  Pose track(std::size_t found) {
    std::optional<Pose> first_expected;
    pose_ = tracker_.track(view(), features_,
                           [&](const auto& keyframe, const auto&, const Pose& expected, bool, auto& again) {
                             if (!first_expected) first_expected = expected;
                             for (std::size_t i = 0; i < found; ++i)
                               again.push_back({i * 7 % 120, keyframe.pixel[i * 7 % 120], 2.0});
                           });
    return first_expected.value_or(Pose::Identity());
  }

  std::vector<std::uint16_t> depth_ = std::vector<std::uint16_t>(640 * 480, 10000);
  examples::OrbFeatures features_;
  examples::KeyframePose<examples::OrbFeatures> tracker_{camera()};
  std::optional<Pose> pose_;
};

TEST_F(StandingTracker, BelievesItsOwnVelocityWhereMuchFits) {
  track(100);
  ASSERT_TRUE(pose_);
  tracker_.expect_motion(aside(0.05));
  EXPECT_TRUE(track(100).isApprox(Pose::Identity(), 1e-6)) << "it stood";
}

TEST_F(StandingTracker, BelievesTheOtherWhereLittleFitted) {
  track(50);
  ASSERT_TRUE(pose_) << "50 of the 50 that were found";
  tracker_.expect_motion(aside(0.05));
  EXPECT_TRUE(track(100).isApprox(aside(0.05), 1e-6));
  ASSERT_TRUE(pose_);
  EXPECT_TRUE(pose_->isApprox(Pose::Identity(), 1e-3)) << "an expectation, not the answer";
  EXPECT_TRUE(track(100).isApprox(Pose::Identity(), 1e-3)) << "for one frame";
}

TEST_F(StandingTracker, AddsUpWhatItIsToldWhileItIsLost) {
  track(100);
  for (const double x_m : {0.02, 0.03}) {
    tracker_.expect_motion(aside(x_m));
    track(0);
    EXPECT_FALSE(pose_);
  }
  tracker_.expect_motion(aside(0.04));
  EXPECT_TRUE(track(0).isApprox(aside(0.09), 1e-6)) << "of the three frames since the last pose";
}

// 0.3 m at once, in the frame in which it was lost: a keyframe shows it, and the next is expected there.
TEST_F(StandingTracker, WhereItIsFoundAnewIsNoVelocity) {
  track(100);
  const auto track_at = [&](double x_m) {
    std::optional<Pose> first_expected;
    const stillpoint::FrameView frame = view();
    pose_ = tracker_.track(frame, features_,
                           [&](const auto& keyframe, const auto&, const Pose& expected, bool is_lost, auto& again) {
                             if (!first_expected) first_expected = expected;
                             if (!is_lost && (expected.translation() - aside(x_m).translation()).norm() > 0.1) return;
                             const double keyframe_x_m = -keyframe.world_from_camera.translation().x();
                             const double step_px = camera().fx() * (x_m - keyframe_x_m) / 2.0;
                             for (std::size_t i = 0; i < 100; ++i)
                               again.push_back({i, keyframe.pixel[i] - stillpoint::Vector2d(step_px, 0), 2.0});
                           });
    return first_expected->translation().x();
  };
  track_at(-0.3);
  ASSERT_TRUE(pose_);
  ASSERT_NEAR(pose_->translation().x(), 0.3, 1e-3);
  EXPECT_NEAR(track_at(-0.3), -0.3, 1e-3) << "not as far again";
  track_at(0.1);
  ASSERT_TRUE(pose_);
  tracker_.expect_motion(aside(0.05));
  EXPECT_NEAR(track_at(0.15), 0.15, 1e-3) << "whoever knows the motion is listened to";
}

TEST_F(StandingTracker, AFrameThatIsToldNothingEndsTheSum) {
  track(100);
  tracker_.expect_motion(aside(0.02));
  track(0);
  track(0);
  tracker_.expect_motion(aside(0.04));
  EXPECT_TRUE(track(100).isApprox(Pose::Identity(), 1e-6)) << "where it was last, for want of better";
  ASSERT_TRUE(pose_);
  track(50);
  tracker_.expect_motion(aside(0.04));
  EXPECT_TRUE(track(100).isApprox(aside(0.04), 1e-6)) << "found again, it listens again";
}

}  // namespace
