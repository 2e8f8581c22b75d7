// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Which messages make a frame, in whatever order they come.

#include "stillpoint_ros/frame_pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stillpoint/core/random.hpp"

namespace stillpoint_ros::frame_pairing_test {

RawImage at(double stamp_s, int width = 640) {
  RawImage image;
  image.stamp_s = stamp_s;
  image.width = width;
  image.height = width * 3 / 4;
  return image;
}
CameraInfo camera_at(double stamp_s, int width = 640, double fx = 500) {
  CameraInfo info;
  info.stamp_s = stamp_s;
  info.width = width;
  info.height = width * 3 / 4;
  info.k[0] = fx;
  return info;
}

TEST(FramePairing, NeedsAllThreeInAnyOrder) {
  std::vector<int> order = {0, 1, 2};
  do {
    FramePairing pairing;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_FALSE(pairing.take());
      if (order[i] == 0) pairing.add_image(at(1.0));
      if (order[i] == 1) pairing.add_depth(at(1.004));
      if (order[i] == 2) pairing.add_camera_info(camera_at(1.0));
    }
    const auto frame = pairing.take();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->image.stamp_s, 1.0);
    EXPECT_EQ(frame->depth.stamp_s, 1.004);
    EXPECT_EQ(frame->camera.k[0], 500);
    EXPECT_FALSE(pairing.take()) << "each only once";
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(FramePairing, TakesTheNearestDepthWithinTheTolerance) {
  FramePairing pairing;
  pairing.options.tolerance_s = 0.01;
  pairing.add_camera_info(camera_at(0));
  pairing.add_depth(at(0.9921));
  pairing.add_depth(at(1.003));
  pairing.add_depth(at(1.009));
  pairing.add_image(at(1.0));
  EXPECT_EQ(pairing.take()->depth.stamp_s, 1.003);
  pairing.add_image(at(1.02));
  EXPECT_FALSE(pairing.take()) << "0.011 s is beyond the tolerance";
  EXPECT_NEAR(pairing.nearest_difference_s(), 0.011, 1e-9);
}

TEST(FramePairing, LeavesOutImagesWhoseDepthWasLostAndCountsThem) {
  FramePairing pairing;
  pairing.add_camera_info(camera_at(0));
  for (const double time_s : {1.0, 1.033, 1.067}) pairing.add_image(at(time_s));
  pairing.add_depth(at(1.067));
  EXPECT_EQ(pairing.take()->image.stamp_s, 1.067);
  EXPECT_EQ(pairing.unpaired_images(), 2u);
  pairing.add_depth(at(1.0));
  EXPECT_FALSE(pairing.take()) << "time does not run backwards";
}

TEST(FramePairing, FramesComeInTheOrderOfTimeWhateverComesLate) {
  stillpoint::Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    FramePairing pairing;
    pairing.options.tolerance_s = 0.01;
    pairing.add_camera_info(camera_at(0));
    // Each message is up to three frames late.
    struct Message {
      double arrives_s, stamp_s;
      bool is_depth;
    };
    std::vector<Message> messages;
    for (int i = 0; i < 30; ++i)
      for (const bool is_depth : {false, true}) {
        const double stamp_s = 100 + i / 30.0 + (is_depth ? 0.005 : 0.0);
        messages.push_back({stamp_s + 0.1 * random.uniform(), stamp_s, is_depth});
      }
    std::sort(messages.begin(), messages.end(), [](const auto& a, const auto& b) { return a.arrives_s < b.arrives_s; });
    double last_s = 0;
    int frames = 0;
    for (const Message& message : messages) {
      message.is_depth ? pairing.add_depth(at(message.stamp_s)) : pairing.add_image(at(message.stamp_s));
      while (const auto frame = pairing.take()) {
        ++frames;
        EXPECT_GT(frame->image.stamp_s, last_s);
        EXPECT_NEAR(frame->depth.stamp_s - frame->image.stamp_s, 0.005, 1e-6);
        last_s = frame->image.stamp_s;
      }
    }
    EXPECT_GT(frames, 8) << "of 30, " << trial;
  }
}

TEST(FramePairing, QueuesAreShort) {
  FramePairing pairing;
  pairing.options.longest_queue = 3;
  pairing.add_camera_info(camera_at(0));
  for (int i = 0; i < 10; ++i) pairing.add_image(at(i));
  pairing.add_depth(at(6));
  EXPECT_FALSE(pairing.take()) << "that image is gone";
  pairing.add_depth(at(7));
  EXPECT_EQ(pairing.take()->image.stamp_s, 7);
  EXPECT_EQ(pairing.unpaired_images(), 7u) << "0 to 6, which the queue of 3 could not keep";
}

TEST(FramePairing, CountsTheImagesBeforeARecordingThatBeginsAnew) {
  FramePairing pairing;
  pairing.add_camera_info(camera_at(0));
  pairing.add_image(at(50));
  pairing.add_image(at(51));
  pairing.add_image(at(10));
  EXPECT_EQ(pairing.unpaired_images(), 2u);
  EXPECT_EQ(pairing.waiting_images(), 1u);
}

TEST(FramePairing, TheCameraIsOfTheImagesSizeAndNearestInTime) {
  FramePairing pairing;
  pairing.add_camera_info(camera_at(1, 320));
  pairing.add_image(at(1));
  pairing.add_depth(at(1, 320));
  EXPECT_FALSE(pairing.take());
  ASSERT_NE(pairing.image_without_camera(), nullptr);
  EXPECT_EQ(pairing.image_without_camera()->width, 640);
  pairing.add_camera_info(camera_at(0.5, 640, 501));
  pairing.add_camera_info(camera_at(9.0, 640, 502));
  EXPECT_EQ(pairing.image_without_camera(), nullptr);
  EXPECT_EQ(pairing.take()->camera.k[0], 501) << "depth may be of another size";
  pairing.add_camera_info(camera_at(2.0, 640, 502));
  pairing.add_image(at(2));
  pairing.add_depth(at(2));
  EXPECT_EQ(pairing.take()->camera.k[0], 502);
}

TEST(FramePairing, ARecordingThatBeginsAnewIsPairedAnew) {
  FramePairing pairing;
  pairing.add_camera_info(camera_at(0));
  for (const double time_s : {50.0, 60.0, 10.0, 10.033}) {
    pairing.add_image(at(time_s));
    pairing.add_depth(at(time_s));
    const auto frame = pairing.take();
    ASSERT_TRUE(frame) << time_s;
    EXPECT_EQ(frame->image.stamp_s, time_s);
  }
}

TEST(FramePairing, SaysHowFarApartTwoClocksAre) {
  FramePairing pairing;
  EXPECT_TRUE(std::isinf(pairing.nearest_difference_s()));
  pairing.add_image(at(100));
  EXPECT_TRUE(std::isinf(pairing.nearest_difference_s()));
  pairing.add_depth(at(50));
  EXPECT_NEAR(pairing.nearest_difference_s(), 50, 1e-9);
}

}  // namespace stillpoint_ros::frame_pairing_test
