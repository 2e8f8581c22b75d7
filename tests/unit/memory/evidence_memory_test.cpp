// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/memory/evidence_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"

namespace stillpoint {
namespace {

static_assert(is_memory<EvidenceMemory>::value && recalls<EvidenceMemory>::value);

struct Feature {
  Vector2f pixel;
  double depth_m = 2.0;
};

/// Frames come every tenth of a second. Half of the log-odds stay from one to the next, they are held within ± 3,
/// dynamic above 0. Above 2 the dynamic prior is 1 at once, and nine tenths of that stay.
class EvidenceMemoryTest : public testing::Test {
 protected:
  static constexpr double kElapsed_s = 0.1;

  EvidenceMemoryTest() {
    memory_.options.log_odds_decay_s = kElapsed_s / std::log(2.0);
    memory_.caution = 0.0f;
    memory_.options.dynamic_prior_rise_s = 1e-6;
    memory_.options.dynamic_prior_decay_s = kElapsed_s / std::log(1.0 / 0.9);
  }

  /// One frame in which the features have these log-odds by themselves.
  void frame(const std::vector<Feature>& features, const std::vector<float>& log_odds,
             Reason reason = Reason::consistent) {
    std::vector<Vector2f> pixels;
    for (const Feature& feature : features) pixels.push_back(feature.pixel);
    matches_.begin(pixels);
    matches_.elapsed_s = elapsed_s_;
    matches_.unjudged_s = unjudged_s_;
    matches_.pixel_scale = pixel_scale_;
    for (std::size_t i = 0; i < features.size(); ++i) {
      matches_.current.depth_m[i] = features[i].depth_m;
      matches_.current.depth_sigma_m[i] = 0.008;  // one surface: within 0.06 + 5 · 0.008 = 0.1 m
    }
    matches_.past_observations.surfaces = surfaces_;
    recall();
    labels_.assign(features.size(), Label{});
    for (std::size_t i = 0; i < features.size(); ++i) {
      labels_[i].log_odds = log_odds[i];
      labels_[i].reason = reason;
    }
    memory_.update({matches_, {}, remembered_}, Motion{}, {}, labels_, workspace_);
  }
  void recall() {
    remembered_.begin(matches_);
    memory_.recall(matches_, remembered_, workspace_);
  }
  void frame(float log_odds) { frame({{Vector2f(50, 50)}}, {log_odds}); }

  static SurfaceCell cell(float u, double z) {
    SurfaceCell surface;
    surface.pixel = surface.predicted = {u, 50};
    surface.point = {0, 0, z};
    return surface;
  }

  EvidenceMemory memory_;
  Matches matches_;
  Remembered remembered_;
  double elapsed_s_ = kElapsed_s;  ///< from each frame to the next
  double unjudged_s_ = 0;
  float pixel_scale_ = 1;
  std::vector<SurfaceCell> surfaces_;  ///< of every frame
  std::vector<Label> labels_;
  Workspace workspace_;
};

constexpr float kRounding = 1e-4f;

// Parked: −2, then −2 + ½ (−2) = −3. It moves: 3 − 1.5 = 1.5, 3 + 0.75 = 3.75, held at 3. It parks: −1 + 1.5 = 0.5,
// which is still dynamic; −1 + 0.25.
TEST_F(EvidenceMemoryTest, ParkedMovingParked) {
  const float now[] = {-2, -2, 3, 3, -1, -1};
  const float sum[] = {-2, -3, 1.5f, 3, 0.5f, -0.75f};
  const bool keep[] = {true, true, false, false, false, true};
  for (int f = 0; f < 6; ++f) {
    frame(now[f]);
    EXPECT_NEAR(labels_[0].log_odds, sum[f], kRounding) << f;
    EXPECT_EQ(labels_[0].keep, keep[f]) << f;
    EXPECT_EQ(labels_[0].verdict, keep[f] ? Verdict::kept : Verdict::dynamic) << f;
    EXPECT_NEAR(labels_[0].probability, 1.0f / (1.0f + std::exp(-sum[f])), kRounding) << f;
  }
}

// A host's map outweighs two frames that agree, for what is near on the same surface, and for one frame.
TEST_F(EvidenceMemoryTest, AHostsMapIsEvidence) {
  const std::vector<Feature> features = {{Vector2f(50, 50)}, {Vector2f(60, 50)}, {Vector2f(50, 60), 3.0}};
  frame(features, {-3, -3, -3});
  const std::vector<std::uint8_t> is_dynamic = {1, 0, 0};
  memory_.expect_dynamic(is_dynamic);
  frame(features, {-3, -3, -3});
  EXPECT_FALSE(labels_[0].keep);
  EXPECT_EQ(labels_[0].reason, Reason::remembered);
  EXPECT_FALSE(labels_[1].keep) << "its neighbour";
  EXPECT_TRUE(labels_[2].keep) << "behind it";
  frame(features, {-3, -3, -3});
  EXPECT_TRUE(labels_[0].keep) << "the map no longer says so";
  memory_.expect_dynamic(is_dynamic);
  memory_.reset();
  frame(features, {-3, -3, -3});
  EXPECT_TRUE(labels_[0].keep);
}

// The lens is covered for a while: whatever the map said was of the first of those frames.
TEST_F(EvidenceMemoryTest, WhatTheMapSaidOfAFrameThatWasNotJudgedIsGone) {
  frame(-3);
  memory_.expect_dynamic(std::vector<std::uint8_t>{1});
  unjudged_s_ = kElapsed_s;
  frame(-3);
  EXPECT_TRUE(labels_[0].keep);
}

// Half of the log-odds are left after 0.1 s, a quarter after 0.2; while the frames are judged they are those of the
// last.
TEST_F(EvidenceMemoryTest, WhatIsRecalledHasAgedWhileNothingWasJudged) {
  frame(2.0f);
  recall();
  EXPECT_NEAR(remembered_.log_odds[0], 2.0f, kRounding);
  matches_.unjudged_s = 2 * kElapsed_s;
  recall();
  EXPECT_NEAR(remembered_.log_odds[0], 0.5f, kRounding);
}

TEST_F(EvidenceMemoryTest, WhatTheMapSaysOfAKeypointThatIsNoneIsSaidOfNoOther) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Feature> features = {{Vector2f(nan, nan)}, {Vector2f(60, 50)}};
  frame(features, {-3, -3});
  memory_.expect_dynamic(std::vector<std::uint8_t>{1, 0});
  frame(features, {-3, -3});
  EXPECT_TRUE(labels_[1].keep);
}

TEST_F(EvidenceMemoryTest, SaysWhatDecided) {
  frame({{Vector2f(50, 50)}, {Vector2f(150, 50)}}, {3, -3});
  EXPECT_EQ(labels_[0].reason, Reason::inconsistent);
  EXPECT_EQ(labels_[1].reason, Reason::consistent);
  frame(-0.5f);
  EXPECT_FALSE(labels_[0].keep);
  EXPECT_EQ(labels_[0].reason, Reason::remembered);
  memory_.reset();
  frame({{Vector2f(50, 50)}}, {3}, Reason::neighbours);
  EXPECT_EQ(labels_[0].reason, Reason::neighbours);
  memory_.reset();
  frame({{Vector2f(50, 50)}}, {-1}, Reason::no_depth);
  EXPECT_EQ(labels_[0].verdict, Verdict::unknown);
  EXPECT_TRUE(labels_[0].keep);
}

TEST_F(EvidenceMemoryTest, LogOddsAreHeld) {
  frame(100.0f);
  EXPECT_EQ(labels_[0].log_odds, 3.0f);
  memory_.reset();
  frame(-100.0f);
  EXPECT_EQ(labels_[0].log_odds, -3.0f);
}

// 9 px on: the same feature; 15 px and more: another one. On another surface it never is.
TEST_F(EvidenceMemoryTest, AFeatureIsRecognisedByPlaceAndDepth) {
  struct Case {
    Feature feature;
    float recalled;
  };
  for (const Case& c : {Case{{{59, 50}, 2.0}, 1.5f},
                        {{{65, 50}, 2.0}, 0.0f},
                        {{{50, 50}, 2.09}, 1.5f},
                        {{{50, 50}, 2.2}, 0.0f},
                        {{{50, 50}, 1.8}, 0.0f},
                        {{{50, 50}, 0.0}, 1.5f}}) {
    memory_.reset();
    frame(3.0f);
    frame({c.feature}, {-0.1f});
    EXPECT_NEAR(labels_[0].log_odds, c.recalled - 0.1f, kRounding)
        << c.feature.pixel.transpose() << " " << c.feature.depth_m;
  }
}

TEST_F(EvidenceMemoryTest, AMatchedFeatureIsLookedUpWhereItWas) {
  frame(3.0f);
  const std::vector<Vector2f> pixels = {{120, 90}};
  matches_.begin(pixels);
  matches_.current.depth_m[0] = 2.0;
  matches_.reference.pixel[0] = {50, 50};
  matches_.state[0] = MatchState::matched;
  recall();
  labels_.assign(1, Label{});
  memory_.update({matches_, {}, remembered_}, Motion{}, {}, labels_, workspace_);
  EXPECT_NEAR(labels_[0].log_odds, 1.5f, kRounding);
}

// Of the log-odds 3 a quarter is left after 0.2 s, in one frame or in two.
TEST_F(EvidenceMemoryTest, LogOddsFadeWithTimeNotWithFrames) {
  frame(3.0f);
  elapsed_s_ = 0.2;
  frame(0.0f);
  EXPECT_NEAR(labels_[0].log_odds, 0.75f, kRounding);
  memory_.reset();
  elapsed_s_ = kElapsed_s;
  frame(3.0f);
  frame(0.0f);
  frame(0.0f);
  EXPECT_NEAR(labels_[0].log_odds, 0.75f, kRounding) << "two frames of 0.1 s are one of 0.2 s";
}

// Frames that were not judged came between: what is remembered is of 0.1 s before the reference, twice as old. Of a
// dynamic prior of 1 there is 0.9² = 0.81 left, a static prior of 1 − 0.99 · 0.81.
TEST_F(EvidenceMemoryTest, WhatIsRememberedAgesInFramesThatAreNotJudged) {
  frame(3.0f);
  unjudged_s_ = 0.1;
  frame(0.0f);
  EXPECT_NEAR(labels_[0].log_odds, 0.75f, kRounding);
  EXPECT_NEAR(remembered_.static_prior[0], 0.1981f, kRounding);
}

// A focal length of a quarter: what was within 25 px is within 6.
TEST_F(EvidenceMemoryTest, AHostsMapReachesAsFarInAnyImage) {
  const std::vector<Feature> features = {{Vector2f(50, 50)}, {Vector2f(60, 50)}};
  for (const auto& [scale, reaches] : {std::pair(1.0f, true), std::pair(0.25f, false)}) {
    pixel_scale_ = scale;
    memory_.reset();
    frame(features, {-3, -3});
    memory_.expect_dynamic(std::vector<std::uint8_t>{1, 0});
    frame(features, {-3, -3});
    EXPECT_FALSE(labels_[0].keep);
    EXPECT_EQ(labels_[1].keep, !reaches) << scale;
  }
}

// Nobody followed the feature. A corner 10 px beside it on its surface came from 70 px to the left: so did the feature.
// One on another surface says nothing: then it is looked up where it was if it stands still.
TEST_F(EvidenceMemoryTest, AFeatureThatNobodyFollowedIsLookedUpWhereItsSurfaceWas) {
  for (const auto& [corner_depth_m, recalled] : {std::pair(2.0, 1.5f), std::pair(3.0, -1.0f)}) {
    memory_.reset();
    frame({{Vector2f(50, 50)}, {Vector2f(200, 50)}}, {3.0f, -2.0f});
    const std::vector<Vector2f> pixels = {{120, 50}};
    matches_.begin(pixels);
    matches_.elapsed_s = kElapsed_s;
    matches_.predicted[0] = {200, 50};
    matches_.resize(2);
    matches_.current.pixel[1] = {130, 50};
    matches_.reference.pixel[1] = {60, 50};
    matches_.state[1] = MatchState::matched;
    matches_.current.depth_m[0] = 2.0;
    matches_.current.depth_m[1] = corner_depth_m;
    matches_.current.depth_sigma_m.assign(2, 0.008);
    recall();
    EXPECT_NEAR(remembered_.log_odds[0] * 0.5f, recalled, kRounding) << corner_depth_m;
  }
}

// Of the log-odds' memory 1 / (1 − 1/2) = 2 frames count. At 30 Hz, a third of the interval, 1 / (1 − 2^(−1/3)) = 4.847
// would: ln(4.847 / 2) = 0.885.
TEST_F(EvidenceMemoryTest, FewerFramesNeedStrongerEvidence) {
  memory_.caution = 0.5f;
  frame(1.0f);
  EXPECT_NEAR(labels_[0].log_odds, 1.0f - 0.5f * 0.885f, 1e-3f);
  memory_.reset();
  elapsed_s_ = 1.0 / 60.0;
  frame(1.0f);
  EXPECT_NEAR(labels_[0].log_odds, 1.0f, kRounding) << "more frames need no weaker";
}

TEST_F(EvidenceMemoryTest, ResetForgets) {
  frame(4.0f);
  memory_.reset();
  frame(-0.1f);
  EXPECT_NEAR(labels_[0].log_odds, -0.1f, kRounding);
  EXPECT_EQ(remembered_.static_prior[0], 1.0f);
}

// ---- Dynamic prior ----

// What moved once keeps a dynamic prior when it stands again: its weight is 1 − 0.99 · 0.9 in the next frame.
TEST_F(EvidenceMemoryTest, WhatMovedOnceHasLittleSayForLong) {
  frame(-2.0f);
  frame(-2.0f);
  EXPECT_EQ(remembered_.static_prior[0], 1.0f);
  frame(5.0f);
  frame(-6.0f);
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.9f, kRounding);
  frame(-6.0f);
  EXPECT_TRUE(labels_[0].keep) << "the dynamic prior drives no verdict";
  EXPECT_LT(remembered_.static_prior[0], 0.3f);
}

// It moved, which sets its dynamic prior to 1; then it stands for long, and its log-odds are held at
// −3 · (1 − 0.6 · 0.9) instead of −3, so that it is found sooner when it starts again. What never moved keeps the whole
// bound.
TEST_F(EvidenceMemoryTest, WhatMovedOnceIsFoundSoonerWhenItStartsAgain) {
  for (const float now : {5.0f, -6.0f, -6.0f, -6.0f}) frame({{Vector2f(50, 50)}, {Vector2f(200, 50)}}, {now, -6.0f});
  EXPECT_NEAR(labels_[0].log_odds, -3.0f * (1.0f - 0.6f * 0.9f), kRounding);
  EXPECT_NEAR(labels_[1].log_odds, -3.0f, kRounding);
  EXPECT_LT(labels_[0].static_prior, 0.3f);
  EXPECT_EQ(labels_[0].static_prior, remembered_.static_prior[0]);
  EXPECT_EQ(labels_[1].static_prior, 1.0f);
}

/// Ten old features round (50, 50) on one surface, all at the same distance, of which `moving` moved.
void ring(std::size_t moving, std::vector<Feature>& features, std::vector<float>& log_odds) {
  features.clear();
  log_odds.clear();
  for (std::size_t k = 0; k < 10; ++k) {
    const float angle = 0.6283f * static_cast<float>(k);
    features.push_back({Vector2f(50 + 20 * std::cos(angle), 50 + 20 * std::sin(angle))});
    log_odds.push_back(k < moving ? 5.0f : -5.0f);
  }
}

// A share p of neighbours that moved hands on (p − ¼) / ½, held within 0 and 1, times 0.9.
TEST_F(EvidenceMemoryTest, DynamicPriorIsInheritedByMajority) {
  for (const auto& [moving, dynamic_prior] :
       {std::pair<std::size_t, float>{0, 0.0f}, {2, 0.0f}, {5, 0.45f}, {8, 0.9f}, {10, 0.9f}}) {
    memory_.reset();
    std::vector<Feature> features;
    std::vector<float> log_odds;
    ring(moving, features, log_odds);
    frame(features, log_odds);
    frame(-1.0f);  // one new feature in the middle, 20 px from each
    EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * dynamic_prior, 1e-3f) << moving;
    EXPECT_NEAR(labels_[0].log_odds, -1.0f, kRounding) << "a new feature inherits no log-odds";
  }
}

// What is known of a feature rises by g = 1 − exp(−0.1 s / 1 s) = 0.0952 of what is missing. The one that moved is in
// its second frame, 0.0952 + 0.0952 · 0.9048 = 0.1813; the other one, 40 px away, in its first. Half way between them
// its share is 0.1813 / (0.1813 + 0.0952) = 0.6558: (0.6558 − ¼) / ½ · 0.9 = 0.7304 is handed on, by equal votes
// 0.45.
TEST_F(EvidenceMemoryTest, WhoIsNewHasLittleOfAVote) {
  frame({{Vector2f(30, 50)}}, {5.0f});
  frame({{Vector2f(30, 50)}, {Vector2f(70, 50)}}, {5.0f, -1.0f});
  frame(-1.0f);
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.7304f, 1e-3f);
}

// The same with a surface cell where the moving one was, which knows 0.0952 of it and watches for a frame more: 0.1813.
// Of the prior 0.9 is left: 0.9 · 0.6558 = 0.5902, (0.5902 − ¼) / ½ · 0.9 = 0.6124.
TEST_F(EvidenceMemoryTest, ASurfaceCellIsWatchedToo) {
  frame({{Vector2f(30, 50)}}, {5.0f});
  surfaces_ = {cell(30, 2.0)};
  frame({{Vector2f(70, 50)}}, {-1.0f});
  frame(-1.0f);
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.6124f, 1e-3f);
}

TEST_F(EvidenceMemoryTest, DynamicPriorDoesNotJumpToAnotherSurface) {
  std::vector<Feature> features;
  std::vector<float> log_odds;
  ring(10, features, log_odds);
  frame(features, log_odds);
  frame({{Vector2f(50, 50), 3.0}}, {-1.0f});
  EXPECT_EQ(remembered_.static_prior[0], 1.0f);
}

TEST_F(EvidenceMemoryTest, SurfaceCellsHaveThePriorOfTheFeaturesOnThem) {
  std::vector<Feature> features;
  std::vector<float> log_odds;
  ring(10, features, log_odds);
  frame(features, log_odds);
  matches_.past_observations.surfaces = {cell(50, 2.0), cell(50, 3.0), cell(200, 2.0)};
  recall();
  EXPECT_NEAR(remembered_.surface_static_prior[0], 1.0f - 0.99f * 0.9f, kRounding);
  EXPECT_EQ(remembered_.surface_static_prior[1], 1.0f);
  EXPECT_EQ(remembered_.surface_static_prior[2], 1.0f);
}

// Two views of seconds ago saw a surface in its place, and none saw through: a dynamic prior there is a mistake.
TEST_F(EvidenceMemoryTest, AfterSecondsAtRestTheDynamicPriorIsGone) {
  frame({{Vector2f(50, 50)}}, {5.0f});
  for (const auto& [occupied_views, space_static_prior, expected] :
       {std::tuple(0, 1.0f, 0.109f), {1, 1.0f, 0.109f}, {2, 1.0f, 1.0f}, {2, 0.5f, 0.109f}}) {
    const std::vector<Vector2f> pixels = {{50, 50}};
    matches_.begin(pixels);
    matches_.elapsed_s = kElapsed_s;
    matches_.current.depth_m[0] = 2.0;
    matches_.current.depth_sigma_m[0] = 0.008;
    matches_.occupied_views[0] = static_cast<std::uint8_t>(occupied_views);
    matches_.space_static_prior[0] = space_static_prior;
    matches_.past_observations.surfaces = {cell(50, 2.0)};
    matches_.past_observations.surfaces[0].occupied_views = static_cast<std::uint8_t>(occupied_views);
    matches_.past_observations.surfaces[0].space_static_prior = space_static_prior;
    recall();
    EXPECT_NEAR(remembered_.static_prior[0], expected, kRounding) << occupied_views << " " << space_static_prior;
    EXPECT_NEAR(remembered_.surface_static_prior[0], expected, kRounding)
        << occupied_views << " " << space_static_prior;
  }
}

// A ring of features moves and is gone a frame later; the cell in its middle, 20 px from each, keeps its dynamic prior
// by itself, and hands that on to the next feature there. Nothing else knows of it any more.
TEST_F(EvidenceMemoryTest, SurfaceCellsHandTheDynamicPriorOnWhereThereIsNoFeature) {
  std::vector<Feature> features;
  std::vector<float> log_odds;
  ring(10, features, log_odds);
  surfaces_ = {cell(50, 2.0), cell(120, 2.0)};
  frame(features, log_odds);
  frame(features, log_odds);
  frame({{Vector2f(300, 300)}}, {-1.0f});
  frame({{Vector2f(50, 50)}, {Vector2f(50, 52), 3.0}, {Vector2f(120, 50)}}, {-1.0f, -1.0f, -1.0f});
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.9f, kRounding);
  EXPECT_EQ(remembered_.static_prior[1], 1.0f) << "another surface";
  EXPECT_EQ(remembered_.static_prior[2], 1.0f) << "a cell that was never beside anything that moved";
  EXPECT_NEAR(labels_[0].log_odds, -1.0f, kRounding) << "a cell hands no log-odds on";
}

// Ten features with a depth moved, ten without stood still, all 20 px from the middle: a new feature there asks its own
// kind, and the other, with a vote of 0.02, only where there is none of its own.
TEST_F(EvidenceMemoryTest, FeaturesWithADepthAndWithoutHaveNoVoteAmongEachOther) {
  std::vector<Feature> features, depthless;
  std::vector<float> log_odds, standing;
  ring(10, features, log_odds);
  frame(features, log_odds);
  frame({{Vector2f(50, 50), 0.0}}, {-1.0f});
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.9f, kRounding) << "there is no other to ask";
  memory_.reset();
  ring(0, depthless, standing);
  for (std::size_t k = 0; k < depthless.size(); ++k) {
    features.push_back({depthless[k].pixel, 0.0});
    log_odds.push_back(standing[k]);
  }
  frame(features, log_odds);
  frame({{Vector2f(50, 50)}, {Vector2f(50, 50), 0.0}}, {-1.0f, -1.0f});
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.9f, kRounding);
  EXPECT_EQ(remembered_.static_prior[1], 1.0f);
}

// A gain of 0.6: the first frame adds 0.6, which a majority of (0.6 − 0.25) / 0.5 = 0.7 hands on, times 0.9: 0.63. The
// second makes it 0.63 + 0.6 · 0.37 = 0.852, all of which is handed on: 0.9.
TEST_F(EvidenceMemoryTest, DynamicPriorGrowsFromFrameToFrame) {
  memory_.options.dynamic_prior_rise_s = kElapsed_s / std::log(1.0 / 0.4);
  frame(2.5f);
  frame(2.5f);
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.63f, kRounding);
  frame(2.5f);
  EXPECT_NEAR(remembered_.static_prior[0], 1.0f - 0.99f * 0.9f, kRounding);
}

TEST_F(EvidenceMemoryTest, PixelsThatAreNoneAreAnsweredToo) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (int f = 0; f < 3; ++f) {
    frame({{Vector2f(kNaN, 50)}, {Vector2f(1e30f, 1e30f)}, {Vector2f(-50, -50), 0.0}}, {-1, -1, 2});
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(std::isfinite(labels_[i].log_odds));
      EXPECT_TRUE(std::isfinite(remembered_.static_prior[i]));
    }
  }
  frame({}, {});
  frame(1.0f);
  EXPECT_NEAR(labels_[0].log_odds, 1.0f, kRounding);
}

}  // namespace
}  // namespace stillpoint
