// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/adapters/orb_slam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "unit/adapters/finished_orb_frame.hpp"
#include "unit/adapters/look_alikes.hpp"
#include "unit/adapters/tagged_arrays.hpp"
#include "unit/error_of.hpp"

namespace {

namespace orb_slam = stillpoint::orb_slam;
using stillpoint::error_of;
using Flags = std::vector<std::uint8_t>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(OrbSlam, ArraysOfAForkAreCompactedWithTheOthers) {
  look_alikes::OrbFrame<> frame;
  look_alikes::fill_all(std::tie(frame.mvKeys, frame.mvKeysUn, frame.mvuRight, frame.mvDepth, frame.mDescriptors), 4);
  std::vector<int> labels = {0, 1, 2, 3};
  EXPECT_EQ(orb_slam::compact_after_depth(Flags{0, 1, 1, 0}, frame, labels), 2u);
  EXPECT_EQ(labels, (std::vector<int>{1, 2}));
  EXPECT_EQ(frame.N, 2);
}

TEST(OrbSlam, ACopyOfTheFrameKeepsItsDescriptors) {  // the host clones them in its copy constructor
  look_alikes::OrbFrame<> frame;
  look_alikes::fill_all(std::tie(frame.mvKeys, frame.mDescriptors), 4);
  const cv::Mat copy = frame.mDescriptors.clone();
  orb_slam::compact_after_extraction(Flags{0, 1, 1, 0}, frame);
  EXPECT_TRUE(look_alikes::holds(copy, {0, 1, 2, 3}));
}

TEST(OrbSlam, AnErrorNamesTheArray) {
  look_alikes::OrbFrame<> frame;
  look_alikes::fill_all(std::tie(frame.mvKeys, frame.mvKeysUn, frame.mvuRight, frame.mvDepth, frame.mDescriptors), 4);
  frame.mvDepth.pop_back();
  EXPECT_EQ(error_of([&] { orb_slam::compact_after_depth(Flags(4, 1), frame); }),
            "orb_slam: mvDepth has 3 entries, expected one for each of the 4 keep flags");
}

TEST(OrbSlam, AFrameOfTwoFisheyesIsSentToTheOtherHook) {
  look_alikes::OrbFrame<> frame;
  look_alikes::fill_all(std::tie(frame.mvKeys, frame.mvDepth, frame.mDescriptors), 4);
  EXPECT_EQ(
      error_of([&] { orb_slam::compact_after_depth(Flags(4, 1), frame); }),
      "orb_slam: mvKeysUn is empty, which is so in a Frame of two fisheye cameras; expected one entry per keypoint, "
      "or compact_mono_first for each camera after extraction");
}

TEST(OrbSlam, AFinishedFrameIsAsIfMadeOfWhatIsKept) {
  look_alikes::FinishedOrbFrame frame(200);
  Flags keep(200);
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = i % 3 != 1;
  std::vector<int> labels(200);
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<int>(i);
  EXPECT_EQ(orb_slam::compact_frame(keep, frame, labels), 133u);
  EXPECT_EQ(frame.N, 133);
  EXPECT_EQ(labels.size(), 133u);
  EXPECT_EQ(frame.mvKeys[2].class_id, 3);
  EXPECT_TRUE(frame.is_consistent());
  EXPECT_EQ(orb_slam::compact_frame(Flags(133, 1), frame), 133u);
  EXPECT_EQ(orb_slam::compact_frame(Flags(133, 0), frame), 133u) << "never empty";
  EXPECT_TRUE(frame.is_consistent());
}

TEST(OrbSlam, AFinishedFrameWithOneWrongArrayIsLeftAlone) {
  look_alikes::FinishedOrbFrame frame(4);
  frame.mvbOutlier.pop_back();
  EXPECT_EQ(error_of([&] {
              orb_slam::compact_frame(Flags{1, 0, 1, 1}, frame);
            }),
            "orb_slam: mvbOutlier has 3 entries, expected one for each of the 4 keep flags");
  EXPECT_EQ(frame.mvKeys.size(), 4u);
  EXPECT_EQ(frame.N, 4);
}

TEST(OrbSlam, TheCountOfMonocularKeyPointsFollows) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  look_alikes::fill(keypoints, 6);
  look_alikes::fill(descriptors, 6);
  int mono_left = 4;  // 0 to 3 are seen by one camera, 4 and 5 by both
  EXPECT_EQ(orb_slam::compact_mono_first(Flags{1, 0, 1, 0, 0, 1}, keypoints, descriptors, mono_left), 3u);
  EXPECT_EQ(mono_left, 2);
  EXPECT_TRUE(look_alikes::holds(keypoints, {0, 2, 5}));
  EXPECT_EQ(orb_slam::compact_mono_first(Flags{0, 0, 0}, keypoints, descriptors, mono_left), 3u) << "never empty";
  EXPECT_EQ(mono_left, 2);
  mono_left = 7;
  EXPECT_EQ(error_of([&] { orb_slam::compact_mono_first(Flags(3, 1), keypoints, descriptors, mono_left); }),
            "orb_slam: mono_count is 7, expected 0 to the 3 keypoints of the camera");
  mono_left = -1;  // what the host has in a frame of one camera
  EXPECT_THROW(orb_slam::compact_mono_first(Flags(3, 1), keypoints, descriptors, mono_left), stillpoint::Error);
}

TEST(OrbSlam, AsksForMoreFeaturesWhereMuchOfTheImageGoes) {
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.0), 1000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.2), 1250);  // 1000 / 0.8
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.5), 2000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.9), 2000) << "bounded by twice as many";
  EXPECT_EQ(orb_slam::features_to_extract(1000, 1.0), 2000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, 7.0), 2000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.6, 2.2), 2200);
  EXPECT_EQ(orb_slam::features_to_extract(1000, -0.5), 1000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, kNaN), 1000);
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.5, 0.3), 1000) << "never fewer than wanted";
  EXPECT_EQ(orb_slam::features_to_extract(1000, 0.5, kNaN), 1000);
}

TEST(OrbSlam, ACandidateIsLookedUpWhereItsKeyPointWillBe) {
  // Level with scale 2 and a border of 16 pixels of that level: candidate (4, 3) becomes (2 (4 + 16), 2 (3 + 16)).
  cv::Mat mask(480, 640, CV_8UC1, cv::Scalar(255));
  mask.at<unsigned char>(38, 40) = 0;
  std::vector<cv::KeyPoint> candidates;
  candidates.reserve(5);
  for (int i = 0; i < 3; ++i) candidates.emplace_back(static_cast<float>(3 + i), 3.0f, 7.0f, -1.0f, 0.0f, 0, i);
  candidates.emplace_back(static_cast<float>(kNaN), 3.0f, 7.0f, -1.0f, 0.0f, 0, 3);
  candidates.emplace_back(5000.0f, 3.0f, 7.0f, -1.0f, 0.0f, 0, 4);  // outside of the mask
  orb_slam::erase_masked_candidates(mask, candidates, 16, 2.0);
  std::vector<int> left;
  left.reserve(candidates.size());
  for (const cv::KeyPoint& candidate : candidates) left.push_back(candidate.class_id);
  EXPECT_EQ(left, (std::vector<int>{0, 2, 3, 4})) << "in order; where the mask says nothing, they stay";
  orb_slam::erase_masked_candidates(stillpoint::ImageView(), candidates, 16, 2.0);
  EXPECT_EQ(candidates.size(), 4u);
}

struct CountedCandidate {
  cv::Point2f pt;
  explicit CountedCandidate(float x) : pt(x, 0.0f) {}
  CountedCandidate(const CountedCandidate& other) : pt(other.pt) { ++look_alikes::Counter::moves; }
  CountedCandidate& operator=(const CountedCandidate& other) {
    pt = other.pt;
    ++look_alikes::Counter::moves;
    return *this;
  }
};

TEST(OrbSlam, ErasingCandidatesMovesEachAtMostOnce) {
  constexpr int count = 10000;
  cv::Mat mask(1, count, CV_8UC1, cv::Scalar(255));
  std::vector<CountedCandidate> candidates;
  for (int i = 0; i < count; ++i) {
    candidates.emplace_back(static_cast<float>(i));
    if (i % 2 == 0) mask.at<unsigned char>(0, i) = 0;
  }
  look_alikes::Counter::moves = 0;
  orb_slam::erase_masked_candidates(mask, candidates, 0, 1.0);
  ASSERT_EQ(candidates.size(), 5000u);
  EXPECT_LE(look_alikes::Counter::moves, 5000u);
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(candidates[static_cast<std::size_t>(i)].pt.x, static_cast<float>(2 * i + 1));
}

TEST(OrbSlam, AWeightMultipliesTheInformationAndNeverTakesAllOfIt) {
  const std::vector<float> weights = {1.0f, 0.25f, 0.0f, static_cast<float>(kNaN), 3.0f};
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5f, weights, 0), 0.5f);
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5f, weights, 1), 0.125f);
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5f, weights, 2), 0.5f * 0.05f);
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5f, weights, 3), 0.5f * 0.05f);
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5f, weights, 4), 0.5f);
  EXPECT_EQ(orb_slam::weighted_inv_sigma2(0.5, std::vector<float>(), 17), 0.5) << "no weights: all are 1";
}

TEST(OrbSlam, TheCameraIsThatOfTheConstructorsArguments) {
  const cv::Mat K = (cv::Mat_<float>(3, 3) << 535.4f, 0, 320.1f, 0, 539.2f, 247.6f, 0, 0, 1);
  const stillpoint::Camera ideal = orb_slam::camera(K, cv::Mat(), 640, 480);
  EXPECT_EQ(ideal.fx(), 535.4f);
  EXPECT_EQ(ideal.fy(), 539.2f);
  EXPECT_EQ(ideal.cx(), 320.1f);
  EXPECT_EQ(ideal.cy(), 247.6f);
  EXPECT_EQ(ideal.width(), 640);
  EXPECT_EQ(ideal.height(), 480);

  // At x = 1, y = 0 on the plane: x' = 1 + k1 + k2 + k3 + 3 p2, y' = p1.
  const cv::Mat five = (cv::Mat_<float>(5, 1) << 0.25f, 0.125f, 0.0625f, 0.03125f, 0.5f);
  const stillpoint::Vector2d pixel = orb_slam::camera(K, five, 640, 480).distort({ideal.cx() + ideal.fx(), ideal.cy()});
  EXPECT_NEAR(pixel.x(), ideal.cx() + ideal.fx() * (1 + 0.25 + 0.125 + 0.5 + 3 * 0.03125), 1e-9);
  EXPECT_NEAR(pixel.y(), ideal.cy() + ideal.fy() * 0.0625, 1e-9);
  const cv::Mat four = five.rowRange(0, 4);
  EXPECT_NEAR(orb_slam::camera(K, four, 640, 480).distort({ideal.cx() + ideal.fx(), ideal.cy()}).x(),
              ideal.cx() + ideal.fx() * (1 + 0.25 + 0.125 + 3 * 0.03125), 1e-9);

  cv::Mat doubles;
  K.convertTo(doubles, CV_64F);
  EXPECT_THROW(orb_slam::camera(doubles, cv::Mat(), 640, 480), stillpoint::Error);
  EXPECT_EQ(error_of([&] { orb_slam::camera(K, cv::Mat::zeros(3, 1, CV_32F), 640, 480); }),
            "orb_slam: mDistCoef has 3 values of type 5, expected 4 or 5 floats");
  EXPECT_THROW(orb_slam::camera(K, cv::Mat(), 0, 480), stillpoint::Error);
}

}  // namespace
