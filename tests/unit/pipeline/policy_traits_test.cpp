// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Each requirement of each stage, one by one: a stage that keeps all but this is refused. That the refusal is readable
// is tested by tests/compile_fail.

#include "stillpoint/pipeline/policy_traits.hpp"

#include <gtest/gtest.h>

#include "compile_fail/sound_policies.hpp"
#include "stillpoint/depth/depth_registration.hpp"
#include "stillpoint/depth/no_depth_registration.hpp"
#include "stillpoint/depth/no_hole_filling.hpp"
#include "stillpoint/depth/temporal_hole_filling.hpp"

namespace stillpoint {
namespace {

struct Nothing {};

// A member that is deleted hides the sound one and cannot be called.
struct NoProject : Camera {
  void project(const Vector3d&) const = delete;
};
struct NoBackProject : Camera {
  void back_project(const Vector2d&, double) const = delete;
};
struct NoDistort : Camera {
  void distort(const Vector2d&) const = delete;
};
struct NoUndistort : Camera {
  void undistort(const Vector2d&) const = delete;
};
struct NoWidth : Camera {
  void width() const = delete;
};
struct NoHeight : Camera {
  void height() const = delete;
};
struct NoMatch : ProvidedMatches {
  void match(const FrameView&, const FrameView&, Matches&) = delete;
};
struct NoMatcherReset : ProvidedMatches {
  void reset() = delete;
};
struct NoUpdate : NoMemory {
  void update(const Observations&, const Motion&, const Evidence&, span<Label>, Workspace&) = delete;
};
struct NoMemoryReset : NoMemory {
  void reset() = delete;
};
struct PoseAlone {
  Pose estimate(const Observations&, const Camera&, const MotionPrior&, Workspace&);
};
struct WordlessGate {
  void threshold(span<const FeatureScore>, const Regions&, Workspace&);
};
struct WordlessFloor {
  void apply(span<const Vector2f>, const ImageView&, span<Label>, Workspace&);
};
struct WordlessNoise {
  void sigma(double) const;
};
struct ChangingNoise {
  double sigma(double);
};
struct ChangingLookup {
  double at(const DepthView&, const Vector2f&);
};
struct WithoutReset : NoDepthRegistration {
 private:
  void reset();
};
struct WithoutUndo : NoDepthRegistration {
 private:
  void undo();
};
struct FillingWithoutReset : NoHoleFilling {
 private:
  void reset();
};
struct WithoutFill : NoHoleFilling {
 private:
  void fill();
};
struct WithoutMemory : SoundPolicies {
 private:
  using Memory = NoMemory;
};
struct EmptyHistory : SoundPolicies {
  static constexpr std::size_t kHistoryLength = 0;
};
struct VagueHistory : SoundPolicies {
  static constexpr double kHistoryLength = 1.0;
};

TEST(PolicyTraits, SoundStagesAreTaken) {
  EXPECT_TRUE(is_camera<Camera>::value);
  EXPECT_TRUE(is_depth_noise<SoundPolicies::DepthNoise>::value);
  EXPECT_TRUE(is_depth_lookup<SoundPolicies::DepthLookup>::value);
  EXPECT_TRUE((is_depth_registration<NoDepthRegistration, Camera>::value));
  EXPECT_TRUE((is_depth_registration<DepthRegistration, Camera>::value));
  EXPECT_TRUE((is_hole_filling<NoHoleFilling, Camera, KinectNoise>::value));
  EXPECT_TRUE((is_hole_filling<TemporalHoleFilling, Camera, KinectNoise>::value));
  EXPECT_TRUE(is_prior<SoundPolicies::Prior>::value);
  EXPECT_TRUE(is_matcher<SoundPolicies::Matcher>::value);
  EXPECT_TRUE((is_ego_motion<SoundPolicies::EgoMotion, Camera>::value));
  EXPECT_TRUE((is_scorer<SoundPolicies::Scorer, Camera>::value));
  EXPECT_TRUE(is_gate<SoundPolicies::Gate>::value);
  EXPECT_TRUE(is_classifier<SoundPolicies::Classifier>::value);
  EXPECT_TRUE(is_memory<SoundPolicies::Memory>::value);
  EXPECT_TRUE(is_keep_floor<SoundPolicies::KeepFloor>::value);
  EXPECT_TRUE(names_all_stages<SoundPolicies>::value);
  EXPECT_TRUE(has_history_length<SoundPolicies>::value);
}

TEST(PolicyTraits, ATypeWithoutTheMemberIsNoStage) {
  EXPECT_FALSE(is_camera<Nothing>::value);
  EXPECT_FALSE(is_depth_noise<Nothing>::value);
  EXPECT_FALSE(is_depth_lookup<Nothing>::value);
  EXPECT_FALSE((is_depth_registration<Nothing, Camera>::value));
  EXPECT_FALSE((is_depth_registration<WithoutUndo, Camera>::value));
  EXPECT_FALSE((is_hole_filling<Nothing, Camera, KinectNoise>::value));
  EXPECT_FALSE((is_hole_filling<WithoutFill, Camera, KinectNoise>::value));
  EXPECT_FALSE(is_prior<Nothing>::value);
  EXPECT_FALSE(is_matcher<Nothing>::value);
  EXPECT_FALSE((is_ego_motion<Nothing, Camera>::value));
  EXPECT_FALSE((is_scorer<Nothing, Camera>::value));
  EXPECT_FALSE(is_gate<Nothing>::value);
  EXPECT_FALSE(is_classifier<Nothing>::value);
  EXPECT_FALSE(is_memory<Nothing>::value);
  EXPECT_FALSE(is_keep_floor<Nothing>::value);
  EXPECT_FALSE(names_all_stages<Nothing>::value);
  EXPECT_FALSE(has_history_length<Nothing>::value);
}

TEST(PolicyTraits, EachMemberOfACameraIsAskedFor) {
  EXPECT_FALSE(is_camera<NoProject>::value);
  EXPECT_FALSE(is_camera<NoBackProject>::value);
  EXPECT_FALSE(is_camera<NoDistort>::value);
  EXPECT_FALSE(is_camera<NoUndistort>::value);
  EXPECT_FALSE(is_camera<NoWidth>::value);
  EXPECT_FALSE(is_camera<NoHeight>::value);
}

TEST(PolicyTraits, WhoRemembersFramesMustForgetThem) {
  EXPECT_FALSE(is_matcher<NoMatch>::value);
  EXPECT_FALSE(is_matcher<NoMatcherReset>::value);
  EXPECT_FALSE(is_memory<NoUpdate>::value);
  EXPECT_FALSE(is_memory<NoMemoryReset>::value);
  EXPECT_FALSE((is_depth_registration<WithoutReset, Camera>::value));
  EXPECT_FALSE((is_hole_filling<FillingWithoutReset, Camera, KinectNoise>::value));
}

TEST(PolicyTraits, AnswersHaveTheirTypeAndModelsAreConst) {
  EXPECT_FALSE((is_ego_motion<PoseAlone, Camera>::value));
  EXPECT_FALSE(is_gate<WordlessGate>::value);
  EXPECT_FALSE(is_keep_floor<WordlessFloor>::value);
  EXPECT_FALSE(is_depth_noise<WordlessNoise>::value);
  EXPECT_FALSE(is_depth_noise<ChangingNoise>::value);
  EXPECT_FALSE(is_depth_lookup<ChangingLookup>::value);
}

TEST(PolicyTraits, ASetNamesAllStagesAndRemembersFrames) {
  EXPECT_FALSE(names_all_stages<WithoutMemory>::value);
  EXPECT_FALSE(has_history_length<EmptyHistory>::value);
  EXPECT_FALSE(has_history_length<VagueHistory>::value);
}

}  // namespace
}  // namespace stillpoint
