// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What a user reads who has mixed up topics, clocks or sizes.

#include "stillpoint_ros/input_watch.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stillpoint_ros::input_watch_test {

using Sentences = std::vector<std::string>;

RawImage image_at(double stamp_s) {
  RawImage image;
  image.stamp_s = stamp_s;
  image.width = 640;
  image.height = 480;
  return image;
}

class InputWatchTest : public testing::Test {
 protected:
  void see_all(double now_s) {
    for (const Input input : {Input::image, Input::depth, Input::camera_info}) watch.seen(input, now_s);
  }

  InputWatch watch{{"/rgb", "/depth", "/info"}};
  FramePairing pairing;
};

TEST_F(InputWatchTest, NamesEachTopicOnWhichNothingCame) {
  EXPECT_EQ(watch.missing(5, pairing),
            (Sentences{"no image on /rgb yet", "no depth on /depth yet", "no camera_info on /info yet"}));
  watch.seen(Input::image, 5);
  EXPECT_EQ(watch.missing(5.5, pairing), (Sentences{"no depth on /depth yet", "no camera_info on /info yet"}));
}

TEST_F(InputWatchTest, SaysNothingWhereFramesCome) {
  see_all(5);
  watch.paired(5);
  EXPECT_EQ(watch.missing(5.9, pairing), Sentences());
}

TEST_F(InputWatchTest, SaysSinceWhenNothingComes) {
  see_all(5);
  watch.paired(5);
  watch.seen(Input::image, 7);
  EXPECT_EQ(watch.missing(7.5, pairing), (Sentences{"no depth on /depth for 2.500 s"}))
      << "a camera_info may come once for ever";
}

TEST_F(InputWatchTest, ACameraOfHalfAHertzIsNotSilentBetweenItsFrames) {
  for (const double now_s : {5.0, 7.0}) {
    see_all(now_s);
    watch.paired(now_s);
  }
  EXPECT_EQ(watch.missing(11.9, pairing), Sentences());
  EXPECT_EQ(watch.missing(12.1, pairing),
            (Sentences{"no image on /rgb for 5.100 s", "no depth on /depth for 5.100 s"}));
}

TEST_F(InputWatchTest, SaysThatClocksDiffer) {
  see_all(5);
  pairing.add_image(image_at(100.0));
  pairing.add_depth(image_at(99.5));
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  pairing.add_camera_info(info);
  EXPECT_EQ(watch.missing(5.5, pairing),
            (Sentences{"image and depth are 0.500 s apart, expected at most sync_tolerance_s, 0.010 s"}));
}

TEST_F(InputWatchTest, SaysThatTheCameraIsOfAnotherSize) {
  see_all(5);
  pairing.add_image(image_at(1));
  pairing.add_depth(image_at(1));
  EXPECT_EQ(watch.missing(5.5, pairing),
            (Sentences{"the image has 640x480 pixels, expected the size that camera_info on /info says"}));
}

TEST_F(InputWatchTest, SaysThatStampsDoNotGrow) {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  pairing.add_camera_info(info);
  for (int i = 0; i < 4; ++i) {
    pairing.add_image(image_at(0));
    pairing.add_depth(image_at(0));
    while (pairing.take()) watch.paired(5);
  }
  see_all(7);
  EXPECT_EQ(watch.missing(7, pairing),
            (Sentences{"stamps of image on /rgb do not grow: the last is 0.000 s, not later than the last frame's, "
                       "expected the time of each image in its header.stamp"}));
  pairing.add_image(image_at(0.1));
  EXPECT_EQ(watch.missing(7, pairing),
            (Sentences{"stamps of depth on /depth do not grow: the last is 0.000 s, not later than the last frame's, "
                       "expected the time of each image in its header.stamp"}));
  pairing.add_depth(image_at(0.15));
  EXPECT_EQ(watch.missing(7, pairing),
            (Sentences{"image and depth are 0.050 s apart, expected at most sync_tolerance_s, 0.010 s"}));
}

TEST_F(InputWatchTest, SaysForASecondWhyAMessageWasRefused) {
  see_all(5);
  watch.paired(5);
  watch.rejected(5, "depth: encoding is 'rgb8'");
  EXPECT_EQ(watch.missing(5.5, pairing), (Sentences{"depth: encoding is 'rgb8'"}));
  see_all(6.5);
  watch.paired(6.5);
  EXPECT_EQ(watch.missing(6.6, pairing), Sentences());
}

}  // namespace stillpoint_ros::input_watch_test
