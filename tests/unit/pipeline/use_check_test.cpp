// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/pipeline/use_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/status.hpp"
#include "stillpoint/core/warnings.hpp"

namespace stillpoint::use_check_test {
namespace {

/// Frames without keypoints, with a depth of 2 m everywhere.
class UseCheckTest : public testing::Test {
 protected:
  UseCheckTest() {
    gray_.resize(64, 48, PixelFormat::gray8);
    depth_.resize(64, 48, PixelFormat::depth32f);
    for (int v = 0; v < 48; ++v) {
      std::fill_n(gray_.row<std::uint8_t>(v), 64, std::uint8_t{100});
      std::fill_n(depth_.row<float>(v), 64, 2.0f);
    }
  }

  void observe(int frames, Status status, double step_m = 0.0, bool with_depth = true) {
    Motion motion;
    motion.metric = true;
    motion.current_from_reference.translation().z() = step_m;
    const FrameView frame(gray_.view(), with_depth ? DepthView(depth_.view()) : DepthView(), 0.0);
    for (int i = 0; i < frames; ++i) check_.observe(status, frame, camera_, {}, {}, motion);
  }
  bool warns(Warning warning) const { return check_.warnings().has(warning); }

  Camera camera_{60, 60, 32, 24, 64, 48};
  UseCheck check_;
  ImageBuffer gray_, depth_;
};

TEST_F(UseCheckTest, MetresFromFrameToFrameAreSaidAfterTwentyFrames) {
  observe(19, Status::ok, 2.1);
  EXPECT_FALSE(warns(Warning::motion_too_fast));
  observe(1, Status::ok, 2.1);
  EXPECT_TRUE(warns(Warning::motion_too_fast));
  observe(1, Status::ok, 0.1);
  EXPECT_FALSE(warns(Warning::motion_too_fast)) << "one usual step takes two of them back";
}

// Limits of an image of 64 x 48: 22.4 and 41.6 in x, 16.8 and 31.2 in y (half of the size, and 15 % of it to each
// side).
TEST_F(UseCheckTest, IntrinsicsOfAnotherResolutionAreSaidAfterTwenty) {
  camera_ = Camera(60, 60, 42, 31, 64, 48);
  observe(30, Status::ok);
  EXPECT_FALSE(warns(Warning::principal_point_aside)) << "in x alone: an image that was cut";
  camera_ = Camera(60, 60, 41, 32, 64, 48);
  observe(30, Status::ok);
  EXPECT_FALSE(warns(Warning::principal_point_aside)) << "in y alone";
  camera_ = Camera(60, 60, 42, 32, 64, 48);
  observe(19, Status::no_consensus);
  EXPECT_FALSE(warns(Warning::principal_point_aside));
  observe(1, Status::no_consensus);
  EXPECT_TRUE(warns(Warning::principal_point_aside)) << "those of a larger image";
  camera_ = Camera(60, 60, 32, 24, 64, 48);
  observe(10, Status::ok);
  EXPECT_FALSE(warns(Warning::principal_point_aside)) << "set right";
  camera_ = Camera(60, 60, 22, 16, 64, 48);
  observe(20, Status::ok);
  EXPECT_TRUE(warns(Warning::principal_point_aside)) << "those of a smaller image";
}

// Image 64 x 48 is 4 : 3, as 32 x 24; depth of a 16 : 9 sensor is not.
TEST_F(UseCheckTest, DepthOfAnotherShapeIsSaidAfterTwenty) {
  depth_.resize(32, 24, PixelFormat::depth32f);
  observe(30, Status::ok);
  EXPECT_FALSE(warns(Warning::depth_shape_differs)) << "smaller, of the same shape";
  depth_.resize(64, 36, PixelFormat::depth32f);
  observe(19, Status::ok);
  EXPECT_FALSE(warns(Warning::depth_shape_differs));
  observe(1, Status::ok);
  EXPECT_TRUE(warns(Warning::depth_shape_differs));
  observe(10, Status::ok, 0.0, false);
  EXPECT_FALSE(warns(Warning::depth_shape_differs)) << "without depth";
}

TEST_F(UseCheckTest, ACarMayMoveByTwoMetresAndWithoutDepthNothingIsMetres) {
  observe(30, Status::ok, 1.9);
  EXPECT_FALSE(warns(Warning::motion_too_fast));
  observe(30, Status::ok, 5.0, false);
  EXPECT_FALSE(warns(Warning::motion_too_fast));
}

TEST_F(UseCheckTest, FramesThatCannotBeJudgedAreSaidAfterTwenty) {
  observe(19, Status::no_consensus);
  EXPECT_FALSE(warns(Warning::nothing_fits));
  observe(1, Status::too_few_matches);
  EXPECT_TRUE(warns(Warning::nothing_fits));
}

// A time in whole seconds, or in a float.
TEST_F(UseCheckTest, FramesOfTheSameTimeAreSaidAfterTwenty) {
  for (int i = 0; i < 25; ++i) {  // a host that passes each frame twice
    observe(1, Status::ok);
    observe(1, Status::duplicate_frame);
  }
  EXPECT_FALSE(warns(Warning::times_far_apart));
  observe(20, Status::duplicate_frame);
  EXPECT_TRUE(warns(Warning::times_far_apart));
}

std::string hint_of(Warning warning) {
  Warnings warnings;
  warnings.add(warning);
  return UseCheck::hint(Status::ok, warnings);
}

TEST_F(UseCheckTest, WhatIsSaidNamesWhatToLookAt) {
  EXPECT_NE(hint_of(Warning::motion_too_fast).find("metres from frame to frame"), std::string::npos);
  EXPECT_NE(hint_of(Warning::nothing_fits).find("Hardly a frame can be judged"), std::string::npos);
  EXPECT_NE(hint_of(Warning::times_far_apart).find("in seconds"), std::string::npos);
}

// Limits: twice as far, half as far, and a step of 1 cm.
TEST_F(UseCheckTest, AHostOfAnotherScaleIsSaidAfterTwenty) {
  const auto compare = [this](int frames, double host_m, double filter_m) {
    Pose host = Pose::Identity();
    host.translation().x() = host_m;
    Motion motion;
    motion.status = Status::ok;
    motion.metric = true;
    motion.current_from_reference.translation().x() = filter_m;
    for (int i = 0; i < frames; ++i) check_.compare(host, motion);
    return warns(Warning::scale_differs);
  };
  EXPECT_FALSE(compare(30, 0.009, 0.001)) << "smaller steps are noise";
  EXPECT_FALSE(compare(30, 0.1, 0.051));
  EXPECT_FALSE(compare(19, 0.1, 0.049));
  EXPECT_TRUE(compare(1, 0.1, 0.049)) << "twice as far";
  EXPECT_FALSE(compare(10, 0.1, 0.1));
  EXPECT_TRUE(compare(20, 0.02, 0.1)) << "a fifth";
}

TEST_F(UseCheckTest, WithoutAnyDepthTheFirstFrameSaysSo) {
  EXPECT_NE(std::string(UseCheck::hint(Status::no_depth, {})).find("MonocularPolicies"), std::string::npos);
}

TEST_F(UseCheckTest, FramesWithoutKeypointsOrThatAreRefusedSayNothing) {
  observe(30, Status::no_keypoints);
  observe(30, Status::first_frame);
  observe(30, Status::size_changed);
  EXPECT_FALSE(warns(Warning::nothing_fits));
}

}  // namespace
}  // namespace stillpoint::use_check_test
