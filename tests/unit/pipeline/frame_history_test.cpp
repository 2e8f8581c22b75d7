// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/pipeline/frame_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

#include "stillpoint/opencv.hpp"

namespace stillpoint::frame_history_test {
namespace {

TEST(FrameHistory, IsARingOfCopiesNewestFirst) {
  FrameHistory history(3);
  EXPECT_TRUE(history.empty());
  cv::Mat gray(2, 2, CV_8UC1), depth(1, 2, CV_16UC1);
  for (int i = 1; i <= 5; ++i) {
    gray.setTo(i);
    depth.setTo(100 * i);
    Pose pose = Pose::Identity();
    pose.translation().x() = i;
    history.push(FrameView(gray, DepthView(depth, 1000.0 * i), 0.1 * i), pose);
    ASSERT_EQ(history.size(), static_cast<std::size_t>(std::min(i, 3)));
    for (int age = 1; age <= std::min(i, 3); ++age) {
      const PastFrame& past = history.back(static_cast<std::size_t>(age));
      const int k = i + 1 - age;
      EXPECT_EQ(past.timestamp_s, 0.1 * k);
      EXPECT_EQ(past.filter_from_camera.translation().x(), k);
      const FrameView view = past.view();
      EXPECT_EQ(view.timestamp_s, 0.1 * k);
      EXPECT_NE(view.gray.data, gray.data) << "the host's image may die";
      EXPECT_EQ(view.gray.row<std::uint8_t>(1)[1], k);
      EXPECT_EQ(view.depth.metres(1, 0), 0.1f) << "100 k / (1000 k)";
    }
  }
  history.clear();
  EXPECT_TRUE(history.empty());
  EXPECT_EQ(FrameHistory(0).size(), 0u);
}

TEST(FrameHistory, ChainsMotionsAndForgetsWhatNoneLeadsTo) {
  FrameHistory history(3);
  const cv::Mat gray(2, 2, CV_8UC1, cv::Scalar(0));
  const auto push = [&](double time_s, Status status, double step_m) {
    Motion motion;
    motion.status = status;
    motion.current_from_reference.translation().x() = step_m;
    history.push(FrameView(gray, DepthView(), time_s), motion);
  };
  push(1.0, Status::first_frame, 9.0);
  EXPECT_EQ(history.back(1).filter_from_camera.translation().x(), 0.0) << "the first frame is the world";
  push(1.1, Status::ok, -0.25);
  push(1.2, Status::ok, -0.5);
  // Points that move by −x in the camera: the camera moves by +x.
  EXPECT_EQ(history.back(1).filter_from_camera.translation().x(), 0.75);
  EXPECT_EQ(history.back(2).filter_from_camera.translation().x(), 0.25);
  push(1.3, Status::no_consensus, -1.0);
  EXPECT_EQ(history.size(), 1u) << "the older frames are of another world";
  EXPECT_EQ(history.back(1).timestamp_s, 1.3);
}

TEST(FrameHistory, ForgetsADepthThatIsGone) {
  FrameHistory history(1);
  const cv::Mat gray(2, 2, CV_8UC1, cv::Scalar(0)), depth(2, 2, CV_16UC1, cv::Scalar(5000));
  history.push(FrameView(gray, DepthView::tum(depth), 1.0), Pose::Identity());
  EXPECT_FALSE(history.back(1).view().depth.empty());
  history.push(FrameView(gray, DepthView(), 1.1), Pose::Identity());
  EXPECT_TRUE(history.back(1).view().depth.empty());
}

}  // namespace
}  // namespace stillpoint::frame_history_test
