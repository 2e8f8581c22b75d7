// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/provided_matches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/depth/guarded_depth.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/pipeline/optional_stages.hpp"
#include "stillpoint/pipeline/policy_traits.hpp"
#include "unit/observations_of.hpp"

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

TEST_F(ProvidedMatchesTest, WithoutTracksWhatIsOutsideIsOutsideToo) {
  const Matches matches = match({{-1, 20}, {kNaN, 20}, {1e30f, 20}, {20, 20}});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(matches.state[i], MatchState::outside) << i;
  EXPECT_EQ(matches.state[3], MatchState::lost);
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

// ---- Chained over the history ----

/// A camera that stands before a plane at 2 m, without texture: tracks are what the host says they are.
class ChainedTracksTest : public testing::Test {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  FrameView frame() const { return FrameView(gray_, DepthView::tum(depth_), time_s_); }

  /// The next frame: the host's features, and where it says that they were.
  const Matches& next(const std::vector<Vector2f>& pixels, const std::vector<Vector2f>& before) {
    time_s_ += 1 / rate_hz_;
    matches_.begin(pixels);
    matches_.pixel_scale = pixel_scale(camera_);
    matcher_.reference_pixels = before;
    const FrameView current = frame(), reference = history_.empty() ? current : history_.back(1).view();
    matcher_.match(reference, current, matches_);
    lift(current, GuardedDepth(), camera_, KinectNoise(), matches_.current);
    lift(reference, GuardedDepth(), camera_, KinectNoise(), matches_.reference);
    if (!history_.empty()) {
      matcher_.choose_keyframes(history_, current, Pose::Identity(), camera_, KinectNoise(), matches_, workspace_);
      Observations observations = test::observations_of(matches_);
      matcher_.reproject_into_past(history_, current, Pose::Identity(), camera_, KinectNoise(), observations);
      matches_ = observations.matches;
    }
    history_.push(current, Pose::Identity());
    return matches_;
  }

  /// The feature's pixel in the older frames that were looked at, by age; none where no track says.
  std::map<std::size_t, float> columns(std::size_t i) const {
    std::map<std::size_t, float> columns;
    for (const OlderFrame& older : matches_.past_observations.frames())
      if (std::isfinite(older.of_feature[i].dissimilarity)) columns[older.age] = older.of_feature[i].found.x();
    return columns;
  }

  Camera camera_{150, 150, 79.5, 59.5, kWidth, kHeight};
  cv::Mat gray_ = cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(100));
  cv::Mat depth_ = cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(2.0));
  double time_s_ = 0, rate_hz_ = 30;
  FrameHistory history_{16};
  Matches matches_;
  Workspace workspace_;
  ProvidedMatches matcher_;
};

static_assert(reprojects_into_past<ProvidedMatches, Camera, KinectNoise>::value);

TEST_F(ChainedTracksTest, ATrackSaysWhereAFeatureWasInOlderFrames) {
  float u = 30;
  next({{u, 60}}, {});
  for (int f = 1; f <= 12; ++f, u += 3) next({{u + 3, 60}}, {{u, 60}});
  const auto found = columns(0);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_GT(found.rbegin()->first, 3u);
  for (const auto& [age, column] : found) EXPECT_NEAR(column, u - 3.0f * static_cast<float>(age), 1e-3) << age;
}

// Of 90 frames a second the history keeps every third, and the last one.
TEST_F(ChainedTracksTest, ATrackSkipsTheFramesThatTheHistorySkips) {
  rate_hz_ = 90;
  float u = 30;
  next({{u, 60}}, {});
  for (int f = 1; f <= 60; ++f, ++u) next({{u + 1, 60}}, {{u, 60}});
  double oldest_s = 0;
  for (const OlderFrame& older : matches_.past_observations.frames()) {
    oldest_s = std::max(oldest_s, older.elapsed_s);
    EXPECT_NEAR(older.of_feature[0].found.x(), u - static_cast<float>(rate_hz_ * older.elapsed_s), 1e-3) << older.age;
  }
  EXPECT_EQ(matches_.past_observations.frames().size(), 3u);
  EXPECT_GT(oldest_s, 16 / rate_hz_);
}

/// (148 − 79.5) / 60 = 1.14 rad aside, an undistorted pixel is 1 / cos² 1.14 = 5.8 times as small.
TEST_F(ChainedTracksTest, HowFarATrackIsFromItsPlaceIsMeasuredInTheImageWhateverTheLens) {
  camera_ = Camera(60, 60, 79.5, 59.5, kWidth, kHeight, EquidistantFisheye{});
  next({{148, 59.5f}}, {{kNaN, kNaN}});
  next({{148, 59.5f}}, {{147.5f, 59.5f}});
  const Observation& observation = matches_.past_observations.frames()[0].of_feature[0];
  ASSERT_EQ(observation.state, ObservationState::seen);
  EXPECT_NEAR(observation.offset_px, 0.5f, 0.01f) << "it was 2.8";
}

TEST_F(ChainedTracksTest, AFeatureGoesOnFromTheNearestOneOfTheLastFrame) {
  next({{30, 60}, {33, 60}}, {});
  next({{33, 60}, {36, 60}}, {{30, 60}, {33, 60}});
  next({{36.2f, 60}, {39, 62}, {36.8f, 60}}, {{33.2f, 60}, {37, 62}, {33.8f, 60}});
  EXPECT_NEAR(columns(0)[2], 30.2f, 1e-3) << "0.2 px beside the last frame's feature, and so before";
  EXPECT_EQ(columns(1).count(2), 0u) << "2.2 px from any: its track begins there";
  EXPECT_EQ(columns(1).count(1), 1u);
  EXPECT_NEAR(columns(2)[2], 30.8f, 1e-3) << "a keypoint that was detected anew, within a pixel of the last one";
}

TEST_F(ChainedTracksTest, SurfacesThatCameHaveLittleSayInTheMotion) {
  for (int f = 0; f < 15; ++f) next({{30, 60}}, {{30, 60}});  // half a second
  depth_(cv::Rect(60, 30, 60, 60)).setTo(1.2);
  next({{30, 60}}, {{30, 60}});
  int came = 0, stood = 0;
  for (const SurfaceCell& cell : matches_.past_observations.surfaces) {
    ++(cell.point.z() < 1.5 ? came : stood);
    EXPECT_EQ(cell.space_static_prior < 0.5f, cell.point.z() < 1.5) << cell.pixel.transpose();
  }
  EXPECT_GT(came, 10);
  EXPECT_GT(stood, 10);
}

TEST_F(ChainedTracksTest, AGapEndsATrack) {
  next({{30, 60}}, {});
  next({{33, 60}}, {{30, 60}});
  next({{36, 60}}, {{kNaN, kNaN}});
  EXPECT_TRUE(columns(0).empty());
  next({{39, 60}}, {{36, 60}});
  EXPECT_EQ(columns(0).size(), 1u);
  next({{42, 60}}, {});
  EXPECT_TRUE(columns(0).empty()) << "no list";
}

TEST_F(ChainedTracksTest, AFrameThatWasNotMatchedEndsAllTracks) {
  next({{30, 60}}, {});
  next({{33, 60}}, {{30, 60}});
  time_s_ += 1 / 30.0;
  history_.push(frame(), Pose::Identity());  // without keypoints
  next({{36, 60}}, {{33, 60}});
  EXPECT_EQ(columns(0).size(), 1u);
}

TEST_F(ChainedTracksTest, ResetEndsAllTracks) {
  next({{30, 60}}, {});
  next({{33, 60}}, {{30, 60}});
  matcher_.reset();
  next({{36, 60}}, {{33, 60}});
  EXPECT_EQ(columns(0).size(), 1u);
}

// The host's flow slides by 1.2 px a frame along a picture that stands.
TEST_F(ChainedTracksTest, ATrackThatSlidesIsFoundOutByItsPatch) {
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      gray_.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(
          128 + 50 * std::sin(0.7 * u) * std::cos(0.5 * v) + 40 * std::sin(0.31 * u + 0.43 * v));
  next({{60, 60}}, {});
  next({{60, 60}}, {{61.2f, 60}});
  EXPECT_NEAR(columns(0)[1], 60.0f, 0.3f);
}

TEST_F(ChainedTracksTest, BesideSomethingNearerNoTrackIsBelieved) {
  depth_(cv::Rect(40, 0, 60, kHeight)).setTo(1.0);
  next({{38, 60}, {20, 60}, {42, 60}}, {});
  next({{38, 60}, {20, 60}, {42, 60}}, {{38, 60}, {20, 60}, {42, 60}});
  EXPECT_TRUE(columns(0).empty()) << "two pixels beside";
  EXPECT_EQ(columns(1).size(), 1u);
  for (const OlderFrame& older : matches_.past_observations.frames())
    EXPECT_EQ(older.of_feature[1].state, ObservationState::seen) << older.age;
}

TEST_F(ChainedTracksTest, AHistoryOfOneFrameIsNotLookedBackInto) {
  history_ = FrameHistory(1);
  next({{30, 60}}, {});
  next({{33, 60}}, {{30, 60}});
  EXPECT_EQ(matches_.state[0], MatchState::matched);
  EXPECT_TRUE(matches_.past_observations.frames().empty());
}

}  // namespace
}  // namespace stillpoint::provided_matches_test
