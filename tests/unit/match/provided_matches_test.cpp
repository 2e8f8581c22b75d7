// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/provided_matches.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/policy_traits.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint::provided_matches_test {
namespace {

static_assert(is_matcher<ProvidedMatches>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class ProvidedMatchesTest : public testing::Test {
 protected:
  Matches match(const std::vector<Vector2f>& pixels) {
    const FrameView frame(image_, DepthView(), 1.0);
    Matches matches;
    matches.begin(pixels);
    matcher_.match(frame, frame, matches);
    return matches;
  }

  cv::Mat image_ = cv::Mat(60, 80, CV_8UC1, cv::Scalar(0));
  ProvidedMatches matcher_;
};

TEST_F(ProvidedMatchesTest, TakesTheHostsTracksAsTheyAre) {
  matcher_.reference_pixels = {{11.5f, 12.25f}, {kNaN, kNaN}, {30, kNaN}, {40, 31}};
  const Matches matches = match({{12, 13}, {20, 20}, {30, 30}, {41, 31}});
  EXPECT_EQ(matches.state[0], MatchState::matched);
  EXPECT_EQ(matches.reference.pixel[0], Vector2f(11.5f, 12.25f));
  EXPECT_EQ(matches.state[1], MatchState::lost) << "NaN: not seen";
  EXPECT_EQ(matches.state[2], MatchState::lost);
  EXPECT_TRUE(matches.reference.pixel[2].array().isNaN().all());
  EXPECT_EQ(matches.state[3], MatchState::matched);
}

TEST_F(ProvidedMatchesTest, AListOfAnotherLengthIsNoList) {
  const std::vector<Vector2f> pixels = {{20, 20}, {30, 30}};
  for (const std::size_t size : {0u, 1u, 3u}) {
    matcher_.reference_pixels.assign(size, Vector2f(20, 20));
    for (const MatchState state : match(pixels).state) EXPECT_EQ(state, MatchState::lost) << size;
  }
}

TEST_F(ProvidedMatchesTest, NothingOutsideTheImageIsAMatch) {
  matcher_.reference_pixels = {{20, 20}, {20, 20}, {-0.5f, 20}, {20, 59.5f}, {1e30f, 20}};
  const Matches matches = match({{-1, 20}, {kNaN, 20}, {20, 20}, {20, 20}, {20, 20}});
  EXPECT_EQ(matches.state[0], MatchState::outside);
  EXPECT_EQ(matches.state[1], MatchState::outside);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_EQ(matches.state[i], MatchState::lost) << i;
}

TEST_F(ProvidedMatchesTest, NearTheBorderFeaturesAreMarked) {
  const std::vector<Vector2f> pixels = {{9.9f, 30}, {10, 30}, {69.1f, 30}, {40, 49.1f}, {40, 49}};
  matcher_.reference_pixels = pixels;
  const Matches matches = match(pixels);
  const MatchState expected[] = {MatchState::near_edge, MatchState::matched, MatchState::near_edge,
                                 MatchState::near_edge, MatchState::matched};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(matches.state[i], expected[i]) << i;
  matcher_.options.border_px = 0;
  matcher_.reference_pixels = pixels;
  for (const MatchState state : match(pixels).state) EXPECT_EQ(state, MatchState::matched);
}

TEST_F(ProvidedMatchesTest, NearTheBorderOfTheReferenceIsMarkedToo) {
  matcher_.reference_pixels = {{9.9f, 30}, {10, 30}};
  const Matches matches = match({{40, 30}, {40, 30}});
  EXPECT_EQ(matches.state[0], MatchState::near_edge);
  EXPECT_EQ(matches.state[1], MatchState::matched);
}

TEST_F(ProvidedMatchesTest, TracksAreUsedOnce) {
  matcher_.reference_pixels = {{20, 20}};
  EXPECT_EQ(match({{21, 20}}).state[0], MatchState::matched);
  EXPECT_EQ(match({{22, 20}}).state[0], MatchState::lost) << "these were the tracks of the frame before";
}

TEST_F(ProvidedMatchesTest, ResetForgetsTheTracks) {
  matcher_.reference_pixels = {{20, 20}};
  matcher_.reset();
  EXPECT_EQ(match({{20, 20}}).state[0], MatchState::lost);
}

}  // namespace
}  // namespace stillpoint::provided_matches_test
