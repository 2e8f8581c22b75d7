// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The C++11 helpers for ORB-SLAM against the adapter of the headers: the same answers.

#include "stillpoint_shim/orb_slam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stillpoint/adapters/orb_slam.hpp"
#include "stillpoint/core/random.hpp"
#include "unit/adapters/finished_orb_frame.hpp"

namespace stillpoint_shim_orb_slam_test {
namespace {

namespace shim = stillpoint_shim::orb_slam;
namespace header = stillpoint::orb_slam;
using look_alikes::FinishedOrbFrame;
using Flags = std::vector<unsigned char>;

TEST(ShimOrbSlam, AFinishedFrameIsCompactedAsTheHeaderDoes) {
  stillpoint::Random random(7);
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    FinishedOrbFrame found(200), expected(200);
    Flags keep(200);
    for (unsigned char& flag : keep) flag = random.uniform() < share;
    EXPECT_EQ(shim::compact_frame(keep, found), header::compact_frame(keep, expected)) << share;
    EXPECT_TRUE(found == expected) << share;
    EXPECT_TRUE(found.is_consistent()) << share;
  }
  FinishedOrbFrame frame(4);
  frame.mvDepth.pop_back();
  EXPECT_THROW(shim::compact_frame(Flags{1, 0, 1, 1}, frame), std::invalid_argument);
  EXPECT_EQ(frame.mvKeys.size(), 4u);
}

TEST(ShimOrbSlam, MaskedCandidatesAreThoseOfTheHeader) {
  stillpoint::Random random(8);
  cv::Mat mask(48, 64, CV_8UC1);
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u) mask.at<unsigned char>(v, u) = random.uniform() < 0.5 ? 0 : 255;
  for (const float scale : {1.0f, 1.2f, 2.0f}) {
    std::vector<cv::KeyPoint> found;
    for (int i = 0; i < 1000; ++i)
      found.push_back(cv::KeyPoint(static_cast<float>(80 * random.uniform() - 24),
                                   static_cast<float>(60 * random.uniform() - 20), 7, -1, 0, 0, i));
    found.push_back(cv::KeyPoint(std::numeric_limits<float>::quiet_NaN(), 3, 7, -1, 0, 0, 1000));
    std::vector<cv::KeyPoint> expected = found;
    shim::erase_masked_candidates(mask, found, 16, scale);
    header::erase_masked_candidates(mask, expected, 16, static_cast<double>(scale));
    ASSERT_EQ(found.size(), expected.size()) << scale;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].class_id, expected[i].class_id);
    EXPECT_LT(found.size(), 1000u);
    shim::erase_masked_candidates(cv::Mat(), found, 16, scale);
    EXPECT_EQ(found.size(), expected.size()) << "no mask drops nothing";
    EXPECT_THROW(shim::erase_masked_candidates(cv::Mat(4, 4, CV_32FC1), found, 16, scale), std::invalid_argument);
  }
}

TEST(ShimOrbSlam, TheCameraHasTheNumbersOfKAndMDistCoef) {
  const cv::Mat K = (cv::Mat_<float>(3, 3) << 535.4f, 0, 320.1f, 0, 539.2f, 247.6f, 0, 0, 1);
  const cv::Mat distortion = (cv::Mat_<float>(5, 1) << 0.25f, 0.125f, 0.0625f, 0.03125f, 0.5f);
  const stillpoint_shim::Camera camera = shim::camera(K, distortion, 640, 480);
  EXPECT_EQ(camera.fx, 535.4f);
  EXPECT_EQ(camera.fy, 539.2f);
  EXPECT_EQ(camera.cx, 320.1f);
  EXPECT_EQ(camera.cy, 247.6f);
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.lens, stillpoint_shim::Lens::brown_conrady);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(camera.distortion[i], distortion.at<float>(i));
  EXPECT_EQ(shim::camera(K, distortion.rowRange(0, 4), 640, 480).distortion[4], 0);
  EXPECT_EQ(shim::camera(K, cv::Mat(), 640, 480).lens, stillpoint_shim::Lens::pinhole);
  EXPECT_THROW(shim::camera(cv::Mat::eye(3, 3, CV_64F), cv::Mat(), 640, 480), std::invalid_argument);
  EXPECT_THROW(shim::camera(K, cv::Mat::zeros(3, 1, CV_32F), 640, 480), std::invalid_argument);
}

TEST(ShimOrbSlam, TheFloorIsThatOfTheHeader) {
  for (const bool is_initialised : {false, true})
    EXPECT_EQ(static_cast<std::size_t>(shim::fewest_features(is_initialised)),
              header::keep_floor(is_initialised).fewest_features);
}

/// What a Filter was told last.
struct Listener {
  Eigen::Matrix4d told;
  bool feedback(const double (&rows)[16]) {
    told = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows);
    return true;
  }
};

TEST(ShimOrbSlam, FeedbackHandsOverTheInverseOfTcw) {
  Eigen::Isometry3d camera_from_world(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  camera_from_world.pretranslate(Eigen::Vector3d(4, -5, 6));
  Listener listener;
  EXPECT_TRUE(shim::feedback(listener, camera_from_world.matrix()));
  EXPECT_TRUE(listener.told.isApprox(camera_from_world.inverse().matrix(), 1e-12));
  EXPECT_TRUE(shim::feedback(listener, Eigen::Matrix4f(camera_from_world.matrix().cast<float>())));
  EXPECT_TRUE(listener.told.isApprox(camera_from_world.inverse().matrix(), 1e-6));
}

}  // namespace
}  // namespace stillpoint_shim_orb_slam_test
