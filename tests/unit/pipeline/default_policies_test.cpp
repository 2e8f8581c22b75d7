// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// DefaultPolicies and input as hosts hand it over on a bad day: it is answered, and what can't be judged is kept.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "clip.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint::default_policies_test {
namespace {

static_assert(std::is_same_v<FrameFilter<>, FrameFilter<DefaultPolicies>>, "what users get");

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

void expect_sound(const FrameResult& result, std::size_t keypoints) {
  ASSERT_EQ(result.size(), keypoints);
  ASSERT_EQ(result.keep().size(), keypoints);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keypoints; ++i) {
    kept += result.keep()[i];
    EXPECT_EQ(result.keep()[i] == 1, result.label(i).keep);
    EXPECT_TRUE(std::isfinite(result.label(i).log_odds));
    EXPECT_TRUE(std::isfinite(result.depth_m(i)));
  }
  EXPECT_EQ(result.kept_count(), kept);
  EXPECT_TRUE(result.motion().current_from_reference.matrix().allFinite());
  EXPECT_TRUE(result.motion().covariance.allFinite());
}

void expect_open(const FrameResult& result, std::size_t keypoints, Status status) {
  EXPECT_EQ(result.status(), status) << to_string(result.status());
  EXPECT_EQ(result.kept_count(), keypoints);
  expect_sound(result, keypoints);
}

class DefaultFilter : public testing::Test {
 protected:
  const FrameResult& run(std::size_t f) {
    return filter_.filter_frame(clip_.frames[f].view(), clip_.frames[f].keypoints);
  }
  std::size_t count(std::size_t f) const { return clip_.frames[f].keypoints.size(); }

  mock::Clip clip_{21, 8};
  FrameFilter<> filter_{mock::Clip::camera()};
};

TEST_F(DefaultFilter, JudgesAnOrdinaryClip) {
  expect_open(run(0), count(0), Status::first_frame);
  for (std::size_t f = 1; f < 8; ++f) {
    const FrameResult& result = run(f);
    expect_sound(result, count(f));
    EXPECT_TRUE(judged(result.status())) << to_string(result.status());
    EXPECT_GT(result.kept_count(), count(f) / 2);
  }
}

TEST_F(DefaultFilter, OnePixelIsAnImage) {
  FrameFilter<> filter(Camera(1, 1, 0, 0, 1, 1));
  cv::Mat gray(1, 1, CV_8UC1, cv::Scalar(9)), depth(1, 1, CV_16UC1, cv::Scalar(9000));
  const std::vector<Vector2f> keypoints = {{0, 0}, {5, 5}, {kNaN, 0}};
  for (int f = 0; f < 4; ++f)
    expect_open(filter.filter_frame(FrameView(gray, DepthView::tum(depth), 0.1 * f), keypoints), 3,
                f == 0 ? Status::first_frame : Status::too_few_matches);
}

TEST_F(DefaultFilter, SmallImagesOfEverySize) {
  Random random(1);
  for (int size = 2; size < 40; size += 3) {
    FrameFilter<> filter(Camera(size, size, 0.5 * size, 0.5 * size, size, size + 3));
    const std::vector<Vector2f> keypoints = {{0, 0}, {static_cast<float>(size - 1), 1}};
    for (int f = 0; f < 3; ++f) {
      cv::Mat gray(size + 3, size, CV_8UC1), depth(size + 3, size, CV_16UC1, cv::Scalar(9000));
      for (int v = 0; v < gray.rows; ++v)
        for (int u = 0; u < gray.cols; ++u) gray.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random.index(256));
      expect_sound(filter.filter_frame(FrameView(gray, DepthView::tum(depth), 0.1 * f), keypoints), 2);
    }
  }
}

TEST_F(DefaultFilter, ImagesOnePixelWideOrHigh) {
  for (const auto& [width, height] : {std::pair{1, 200}, {200, 1}, {2, 200}, {200, 3}}) {
    FrameFilter<> filter(Camera(50, 50, 0.5 * width, 0.5 * height, width, height));
    const cv::Mat depth(height, width, CV_16UC1, cv::Scalar(9000));
    cv::Mat gray(height, width, CV_8UC1);
    Random random(1);
    std::vector<Vector2f> keypoints;
    for (int i = 0; i < 200; i += 2)
      keypoints.emplace_back(static_cast<float>(i % width), static_cast<float>(i % height));
    for (int f = 0; f < 4; ++f) {
      for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u) gray.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random.index(255));
      const FrameResult& result = filter.filter_frame(FrameView(gray, DepthView::tum(depth), 0.1 * f), keypoints);
      expect_sound(result, keypoints.size());
      EXPECT_NE(result.status(), Status::depth_unit_missing) << "then no stage runs";
    }
  }
}

TEST_F(DefaultFilter, ACameraOfAnotherSizeBeginsAnew) {
  for (std::size_t f = 0; f < 3; ++f) run(f);
  const mock::Clip::Frame& frame = clip_.frames[3];
  cv::Mat gray, depth;
  cv::resize(frame.gray, gray, {200, 90});
  cv::resize(frame.depth, depth, {200, 90}, 0, 0, cv::INTER_NEAREST);
  filter_.camera = Camera(100, 100, 100, 45, 200, 90);
  ImageBuffer mask;
  filter_.predicted_keep_mask(frame.time_s, 3, mask);
  EXPECT_EQ(cv::countNonZero(as_mat(mask.view())), 200 * 90) << "what was seen is of another image";
  const FrameView other(gray, DepthView::tum(depth), frame.time_s);
  expect_open(filter_.filter_frame(other, frame.keypoints), count(3), Status::first_frame);
  const FrameView next(gray, DepthView::tum(depth), frame.time_s + 0.1);
  expect_sound(filter_.filter_frame(next, frame.keypoints), count(3));
  filter_.camera = mock::Clip::camera();
  expect_open(run(5), count(5), Status::first_frame);
  EXPECT_TRUE(judged(run(6).status()));
}

TEST_F(DefaultFilter, AbsurdPosesOfTheHostAreNotBelieved) {
  Pose absurd = Pose::Identity();
  absurd.linear() *= 1e308;
  for (std::size_t f = 0; f < 8; ++f) {
    filter_.expect_motion(absurd);
    const FrameResult& result = run(f);
    expect_sound(result, count(f));
    EXPECT_EQ(judged(result.status()), f > 0) << to_string(result.status());
    filter_.feedback(absurd);
  }
}

TEST_F(DefaultFilter, WithoutDepthNothingIsJudged) {
  for (const bool no_image : {false, true}) {
    filter_.reset();
    for (std::size_t f = 0; f < 4; ++f) {
      if (no_image)
        clip_.frames[f].depth = cv::Mat();
      else
        clip_.frames[f].depth.setTo(0);
      expect_open(run(f), count(f), f == 0 ? Status::first_frame : Status::no_depth);
    }
  }
}

TEST_F(DefaultFilter, DepthThatComesAndGoes) {
  for (const std::size_t f : {2u, 5u}) clip_.frames[f].depth = cv::Mat();
  for (std::size_t f = 0; f < 8; ++f) expect_sound(run(f), count(f));
}

TEST_F(DefaultFilter, DepthOfNaNInfinityAndNegativeMetres) {
  for (std::size_t f = 0; f < 8; ++f) {
    cv::Mat& depth = clip_.frames[f].depth;
    depth.convertTo(depth, CV_32F, 1.0 / 5000.0);
    const float odd[] = {kNaN, std::numeric_limits<float>::infinity(), -1.0f, 1e30f, 1e-30f};
    for (int k = 0; k < 200; ++k) depth.at<float>((17 * k) % 120, (29 * k) % 160) = odd[k % 5];
    expect_sound(run(f), count(f));
  }
}

TEST_F(DefaultFilter, DepthOfAnotherResolution) {
  mock::Clip coarse(21, 8);
  FrameFilter<> of_coarse(mock::Clip::camera());
  for (std::size_t f = 0; f < 8; ++f) {
    cv::resize(coarse.frames[f].depth, coarse.frames[f].depth, {80, 60}, 0, 0, cv::INTER_NEAREST);
    const FrameResult& result = of_coarse.filter_frame(coarse.frames[f].view(), coarse.frames[f].keypoints);
    expect_sound(result, count(f));
    if (f > 0) {
      EXPECT_TRUE(judged(result.status())) << to_string(result.status());
      EXPECT_GT(result.kept_count(), count(f) / 2);
    }
  }
  for (std::size_t f = 0; f < 8; ++f) {  // and one of a few pixels
    cv::resize(coarse.frames[f].depth, coarse.frames[f].depth, {2, 1}, 0, 0, cv::INTER_NEAREST);
    filter_.filter_frame(coarse.frames[f].view(), coarse.frames[f].keypoints);
  }
}

TEST_F(DefaultFilter, KeypointsOutsideAndNowhereAreAnswered) {
  const std::vector<Vector2f> odd = {{kNaN, 10},      {10, kNaN},          {-100, -100},
                                     {1e30f, 1e30f},  {4294967808.0f, 50}, {std::numeric_limits<float>::infinity(), 0},
                                     {159.9f, 119.9f}};
  for (std::size_t f = 0; f < 8; ++f) {
    clip_.frames[f].keypoints.insert(clip_.frames[f].keypoints.begin(), odd.begin(), odd.end());
    const FrameResult& result = run(f);
    expect_sound(result, count(f));
    for (std::size_t i = 0; i < odd.size(); ++i) EXPECT_EQ(result.depth_m(i), 0.0) << i;
    if (!judged(result.status())) continue;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(result.label(i).reason, Reason::outside_image) << i;
  }
}

TEST_F(DefaultFilter, OnlyKeypointsThatAreNone) {
  for (mock::Clip::Frame& frame : clip_.frames) frame.keypoints.assign(3, Vector2f::Constant(kNaN));
  for (std::size_t f = 0; f < 4; ++f) {
    const FrameResult& result = run(f);
    expect_sound(result, 3);
    EXPECT_EQ(result.kept_count(), 3u);
  }
}

TEST_F(DefaultFilter, EmptyImagesAndOddTimesLeaveItAsItWas) {
  FrameFilter<> undisturbed(mock::Clip::camera());
  for (std::size_t f = 0; f < 4; ++f) {
    run(f);
    undisturbed.filter_frame(clip_.frames[f].view(), clip_.frames[f].keypoints);
    expect_open(filter_.filter_frame(FrameView(), clip_.frames[f].keypoints), count(f), Status::no_image);
    mock::Clip::Frame odd = clip_.frames[f];
    odd.time_s = kNoTime;
    expect_open(filter_.filter_frame(odd.view(), odd.keypoints), count(f), Status::invalid_time);
    expect_open(filter_.filter_frame(clip_.frames[f].view(), odd.keypoints), count(f), Status::duplicate_frame);
  }
  mock::Answer one, other;
  one.add(run(4));
  other.add(undisturbed.filter_frame(clip_.frames[4].view(), clip_.frames[4].keypoints));
  EXPECT_EQ(one, other);
}

TEST_F(DefaultFilter, FlatImagesAreNotJudged) {
  for (std::size_t f = 0; f < 3; ++f) {
    clip_.frames[f].gray.setTo(100);
    expect_open(run(f), count(f), f == 0 ? Status::first_frame : Status::too_few_matches);
  }
}

// The filter follows corners of its own: a frame without keypoints of the host teaches it what one keypoint would that
// is none.
TEST_F(DefaultFilter, AFrameWithoutKeypointsIsNoGap) {
  FrameFilter<> with_one(mock::Clip::camera());
  for (std::size_t f = 0; f < clip_.frames.size(); ++f) {
    const mock::Clip::Frame& frame = clip_.frames[f];
    std::vector<Vector2f> none = frame.keypoints, one = frame.keypoints;
    const bool is_blind = f == 3;
    if (is_blind) {
      none.clear();
      one.assign(1, Vector2f(kNaN, kNaN));
    }
    const FrameResult& result = filter_.filter_frame(frame.view(), none);
    const FrameResult& expected = with_one.filter_frame(frame.view(), one);
    if (is_blind) {
      expect_open(result, 0, Status::no_keypoints);
      continue;
    }
    ASSERT_EQ(result.status(), expected.status()) << f;
    for (std::size_t i = 0; i < result.size(); ++i)
      EXPECT_EQ(result.label(i).log_odds, expected.label(i).log_odds) << f << ' ' << i;
  }
}

}  // namespace
}  // namespace stillpoint::default_policies_test
