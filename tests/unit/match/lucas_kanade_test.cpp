// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/lucas_kanade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stillpoint/pipeline/policy_traits.hpp"
#include "wave_texture.hpp"

namespace stillpoint::lucas_kanade_test {
namespace {

static_assert(is_matcher<LucasKanade>::value);
struct Mute {};
static_assert(!is_matcher<Mute>::value);

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A texture, seen through a camera that moved so that its content moved by (dx, dy) pixels.
cv::Mat texture(double dx, double dy, int width = 160, int height = 120, std::uint64_t seed = 1) {
  return test::WaveTexture(seed).shifted(width, height, {dx, dy});
}

FrameView frame(const cv::Mat& gray, double time_s) { return FrameView(gray, DepthView(), time_s); }

Matches match(LucasKanade& matcher, const FrameView& reference, const FrameView& current,
              const std::vector<Vector2f>& pixels) {
  Matches matches;
  matches.begin(pixels);
  matcher.match(reference, current, matches);
  return matches;
}

std::vector<Vector2f> grid(float margin_px, int width = 160, int height = 120) {
  std::vector<Vector2f> pixels;
  for (float v = margin_px; v <= static_cast<float>(height - 1) - margin_px; v += 9.7f)
    for (float u = margin_px; u <= static_cast<float>(width - 1) - margin_px; u += 9.3f) pixels.emplace_back(u, v);
  return pixels;
}

TEST(LucasKanade, FindsKnownSubPixelShifts) {
  constexpr float kPrecision = 0.05f;  // 8-bit rounding and the derivative filter over a window of 21 × 21 pixels
  const cv::Mat reference = texture(0, 0);
  for (const Vector2f& shift : {Vector2f(0, 0), Vector2f(0.3f, -0.6f), Vector2f(2.25f, 1.5f), Vector2f(-5.4f, 3.1f)}) {
    const cv::Mat current = texture(static_cast<double>(shift.x()), static_cast<double>(shift.y()));
    LucasKanade matcher;
    const std::vector<Vector2f> pixels = grid(22);
    const Matches matches = match(matcher, frame(reference, 1.0), frame(current, 1.1), pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      ASSERT_EQ(matches.state[i], MatchState::matched) << pixels[i].transpose();
      EXPECT_LE((matches.reference.pixel[i] - (pixels[i] - shift)).norm(), kPrecision) << pixels[i].transpose();
      EXPECT_EQ(matches.current.pixel[i], pixels[i]) << "the host's pixel stays";
    }
  }
}

// Where the reference shows something else, what is found does not come back.
TEST(LucasKanade, LosesWhatDoesNotComeBack) {
  const cv::Mat current = texture(0, 0, 160, 120, 1), unrelated = texture(0, 0, 160, 120, 2);
  const std::vector<Vector2f> pixels = grid(22);
  LucasKanade checked, unchecked;
  unchecked.options.forward_backward_px = 0;
  const Matches with = match(checked, frame(unrelated, 1.0), frame(current, 1.1), pixels);
  const Matches without = match(unchecked, frame(unrelated, 1.0), frame(current, 1.1), pixels);
  std::size_t found_with = 0, found_without = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    found_with += with.matched(i);
    found_without += without.matched(i);
    if (!with.matched(i)) {
      EXPECT_EQ(with.state[i], MatchState::lost);
      EXPECT_TRUE(with.reference.pixel[i].array().isNaN().all()) << "no pixel is claimed for a lost feature";
    }
  }
  EXPECT_GT(found_without, pixels.size() / 2) << "without the check most are claimed";
  EXPECT_LT(found_with, found_without / 3);
}

TEST(LucasKanade, RepeatedTextureIsLostOrAWholeNumberOfPeriodsOff) {
  // Stripes with a period of 8 pixels, moved by 3: the search may land on a neighbour; a match that is claimed comes
  // back, so that it is on a stripe of the same phase.
  cv::Mat reference(120, 160, CV_8UC1), current(120, 160, CV_8UC1);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const auto stripes = [v](double at) {
        return cv::saturate_cast<std::uint8_t>(128 + 60 * std::sin(0.785398 * at) + 60 * std::sin(0.785398 * v));
      };
      reference.at<std::uint8_t>(v, u) = stripes(u);
      current.at<std::uint8_t>(v, u) = stripes(u - 3.0);
    }
  }
  LucasKanade matcher;
  const std::vector<Vector2f> pixels = grid(30);
  const Matches matches = match(matcher, frame(reference, 1.0), frame(current, 1.1), pixels);
  std::size_t matched = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!matches.matched(i)) continue;
    ++matched;
    const float periods = (matches.reference.pixel[i].x() - (pixels[i].x() - 3.0f)) / 8.0f;
    EXPECT_NEAR(periods, std::round(periods), 0.05f);
  }
  EXPECT_GT(matched, pixels.size() / 2) << "else the test asks little";
}

TEST(LucasKanade, NearTheBorderFeaturesAreMarked) {
  const cv::Mat image = texture(0, 0);
  LucasKanade matcher;
  const Matches matches = match(matcher, frame(image, 1.0), frame(image, 1.1),
                                {{9.5f, 60}, {10, 60}, {149.5f, 60}, {149, 60}, {80, 110}, {0, 0}});
  const MatchState expected[] = {MatchState::near_edge, MatchState::matched,   MatchState::near_edge,
                                 MatchState::matched,   MatchState::near_edge, MatchState::near_edge};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(matches.state[i], expected[i]) << i;
  LucasKanade near_border;
  near_border.options.border_px = 0;
  EXPECT_EQ(match(near_border, frame(image, 1.0), frame(image, 1.1), {{2, 60}}).state[0], MatchState::matched);
}

TEST(LucasKanade, NearTheBorderOfTheReferenceIsMarkedToo) {
  const cv::Mat reference = texture(0, 0), current = texture(6, 0);  // 6 px from the left
  LucasKanade matcher;
  const Matches matches = match(matcher, frame(reference, 1.0), frame(current, 1.1), {{14, 60}, {18, 60}});
  EXPECT_EQ(matches.state[0], MatchState::near_edge);  // was at 8
  EXPECT_EQ(matches.state[1], MatchState::matched);    // was at 12
}

TEST(LucasKanade, WhatLeftTheImageIsLost) {
  const cv::Mat reference = texture(0, 0), current = texture(12, 0);  // came in from the left
  LucasKanade matcher;
  matcher.options.border_px = 0;
  const Matches matches = match(matcher, frame(reference, 1.0), frame(current, 1.1), {{2, 60}, {3, 80}, {60, 60}});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(matches.state[i], MatchState::lost);
    EXPECT_TRUE(matches.reference.pixel[i].array().isNaN().all());
  }
  EXPECT_EQ(matches.state[2], MatchState::matched);
}

TEST(LucasKanade, KeypointsOutsideTheImageAreNeverTracked) {
  const cv::Mat image = texture(0, 0);
  LucasKanade matcher;
  const std::vector<Vector2f> pixels = {{kNaN, 50},   {50, kNaN},     {kInfinity, 50}, {50, -kInfinity}, {-0.1f, 50},
                                        {50, 119.1f}, {1e30f, 1e30f}, {-1e9f, 5},      {50, 50},         {159, 119}};
  const Matches matches = match(matcher, frame(image, 1.0), frame(image, 1.1), pixels);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(matches.state[i], MatchState::outside) << i;
    EXPECT_TRUE(matches.reference.pixel[i].array().isNaN().all()) << i;
  }
  EXPECT_EQ(matches.state[8], MatchState::matched) << "the others are not moved out of their places";
  EXPECT_LE((matches.reference.pixel[8] - pixels[8]).norm(), 0.01f);
  EXPECT_EQ(matches.state[9], MatchState::near_edge);
}

TEST(LucasKanade, NothingToMatchIsFine) {
  const cv::Mat image = texture(0, 0);
  LucasKanade matcher;
  EXPECT_EQ(match(matcher, frame(image, 1.0), frame(image, 1.1), {}).size(), 0u);
  EXPECT_EQ(match(matcher, frame(image, 1.1), frame(image, 1.2), {{kNaN, kNaN}}).state[0], MatchState::outside);
  EXPECT_EQ(match(matcher, frame(image, 1.2), frame(image, 1.3), {{50, 50}}).state[0], MatchState::matched);
}

TEST(LucasKanade, ImagesSmallerThanItsWindowAreFine) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 7), cv::Size(5, 4), cv::Size(22, 3)}) {
    const cv::Mat image(size, CV_8UC1, cv::Scalar(9));
    LucasKanade matcher;
    for (int i = 0; i < 3; ++i) {
      const Matches matches = match(matcher, frame(image, i), frame(image, i + 1), {{0, 0}, {3, 3}});
      EXPECT_EQ(matches.size(), 2u);
    }
  }
}

TEST(LucasKanade, FlatImagesLoseEverything) {
  const cv::Mat flat(120, 160, CV_8UC1, cv::Scalar(100));
  LucasKanade matcher;
  const Matches matches = match(matcher, frame(flat, 1.0), frame(flat, 1.1), grid(20));
  for (const MatchState state : matches.state) EXPECT_EQ(state, MatchState::lost);
}

TEST(LucasKanade, TheRememberedPyramidGivesTheSameAsARebuiltOne) {
  LucasKanade remembering;
  const std::vector<Vector2f> pixels = grid(15);
  for (int i = 0; i < 4; ++i) {
    const cv::Mat reference = texture(1.7 * i, -0.4 * i), current = texture(1.7 * (i + 1), -0.4 * (i + 1));
    LucasKanade fresh;
    const Matches a = match(remembering, frame(reference, i), frame(current, i + 1), pixels);
    const Matches b = match(fresh, frame(reference, i), frame(current, i + 1), pixels);
    EXPECT_EQ(a.state, b.state);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if (a.matched(k)) {
        EXPECT_EQ(a.reference.pixel[k], b.reference.pixel[k]) << "byte for byte";
      }
    }
  }
}

TEST(LucasKanade, AnotherReferenceIsNotTakenForTheLastFrame) {
  const cv::Mat first = texture(0, 0), second = texture(3, 0), third = texture(6, 0);
  LucasKanade matcher;
  match(matcher, frame(first, 1.0), frame(second, 1.1), {{80, 60}});
  // The reference is again the first frame, six pixels from the third, not the second, three pixels away.
  const Matches skipped = match(matcher, frame(first, 1.0), frame(third, 1.2), {{80, 60}});
  EXPECT_NEAR(skipped.reference.pixel[0].x(), 74.0f, 0.1f);
  // Another recording with the same times: only reset() tells.
  matcher.reset();
  const Matches other = match(matcher, frame(second, 1.2), frame(third, 1.3), {{80, 60}});
  EXPECT_NEAR(other.reference.pixel[0].x(), 77.0f, 0.1f);
}

TEST(LucasKanade, OptionsMayChangeBetweenFrames) {
  const cv::Mat a = texture(0, 0), b = texture(2, 0), c = texture(4, 0);
  LucasKanade matcher;
  match(matcher, frame(a, 1.0), frame(b, 1.1), {{80, 60}});
  matcher.options.window_px = 31;
  matcher.options.pyramid_levels = 2;
  const Matches matches = match(matcher, frame(b, 1.1), frame(c, 1.2), {{80, 60}});
  ASSERT_EQ(matches.state[0], MatchState::matched);
  EXPECT_NEAR(matches.reference.pixel[0].x(), 78.0f, 0.1f);
}

}  // namespace
}  // namespace stillpoint::lucas_kanade_test
