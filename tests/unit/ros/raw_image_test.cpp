// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every encoding by pixels written by hand; messages that say more than they hold.

#include "stillpoint_ros/raw_image.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "unit/error_of.hpp"

namespace stillpoint_ros::raw_image_test {

using stillpoint::error_of;

/// A message of 2 x 2 pixels whose rows are `step` bytes apart.
struct Message {
  std::vector<std::uint8_t> data;
  RawImage image;

  Message(const std::string& encoding, std::size_t step, std::vector<std::uint8_t> bytes) : data(std::move(bytes)) {
    image.width = image.height = 2;
    image.step_bytes = step;
    image.encoding = encoding;
    image.data = data.data();
    image.size_bytes = data.size();
  }
};

TEST(RawImage, GrayIsTheMessagesOwnPixelsWhateverItsRowsAreApart) {
  for (const char* encoding : {"mono8", "8UC1"}) {
    const Message message(encoding, 3, {1, 2, 99, 3, 4});  // the last row ends with its pixels
    const cv::Mat gray = image_of(message.image);
    ASSERT_EQ(gray.type(), CV_8UC1);
    EXPECT_EQ(gray.data, message.data.data());
    EXPECT_EQ(gray.at<std::uint8_t>(0, 1), 2);
    EXPECT_EQ(gray.at<std::uint8_t>(1, 0), 3);
    EXPECT_EQ(gray.at<std::uint8_t>(1, 1), 4);
  }
}

TEST(RawImage, ColoursBecomeBlueGreenRed) {
  const cv::Vec3b blue_first(1, 2, 3), last(10, 11, 12);
  const struct {
    const char* encoding;
    std::vector<std::uint8_t> bytes;
  } cases[] = {{"bgr8", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
               {"8UC3", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
               {"rgb8", {3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}},
               {"bgra8", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 0}},
               {"rgba8", {3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7, 0, 12, 11, 10, 0}}};
  for (const auto& c : cases) {
    const Message message(c.encoding, c.bytes.size() / 2, c.bytes);
    const cv::Mat bgr = image_of(message.image);
    ASSERT_EQ(bgr.type(), CV_8UC3) << c.encoding;
    EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), blue_first) << c.encoding;
    EXPECT_EQ(bgr.at<cv::Vec3b>(1, 1), last) << c.encoding;
  }
}

TEST(RawImage, DepthIsOfSixteenBitsOrFloat) {
  for (const char* encoding : {"16UC1", "mono16"}) {
    const Message message(encoding, 4, {1, 0, 0, 1, 255, 255, 0, 0});
    const cv::Mat depth = depth_of(message.image);
    ASSERT_EQ(depth.type(), CV_16UC1);
    EXPECT_EQ(depth.at<std::uint16_t>(0, 0), 1);
    EXPECT_EQ(depth.at<std::uint16_t>(0, 1), 256);  // the lower byte first
    EXPECT_EQ(depth.at<std::uint16_t>(1, 0), 65535);
  }
  const float metres[] = {0.5f, std::numeric_limits<float>::quiet_NaN(), 2.0f, 3.0f};
  std::vector<std::uint8_t> bytes(sizeof metres);
  std::memcpy(bytes.data(), metres, sizeof metres);
  const Message message("32FC1", 8, bytes);
  const cv::Mat depth = depth_of(message.image);
  ASSERT_EQ(depth.type(), CV_32FC1);
  EXPECT_EQ(depth.at<float>(0, 0), 0.5f);
  EXPECT_EQ(depth.at<float>(1, 1), 3.0f);
}

TEST(RawImage, WhatIsWrongIsNamed) {
  const Message bayer("bayer_rggb8", 2, {1, 2, 3, 4});
  EXPECT_EQ(error_of([&] { image_of(bayer.image); }),
            "encoding is 'bayer_rggb8', expected mono8, rgb8, bgr8, rgba8 or bgra8 (image_proc makes them of a Bayer "
            "image)");
  EXPECT_EQ(error_of([&] { depth_of(bayer.image); }),
            "encoding is 'bayer_rggb8', expected 16UC1 (millimetres) or 32FC1 (metres)");
  const Message narrow("bgr8", 5, std::vector<std::uint8_t>(12));
  EXPECT_EQ(error_of([&] { image_of(narrow.image); }), "step is 5 bytes, expected at least 6 for 2 pixels of bgr8");
  const Message odd("16UC1", 5, std::vector<std::uint8_t>(10));
  EXPECT_EQ(error_of([&] { depth_of(odd.image); }), "step is 5 bytes, expected a multiple of 2 for 16UC1");
  const Message broken("mono8", 3, {1, 2, 99, 3});
  EXPECT_EQ(error_of([&] { image_of(broken.image); }), "data has 4 bytes, expected at least 5");
  Message empty("mono8", 2, {1, 2, 3, 4});
  empty.image.height = 0;
  EXPECT_EQ(error_of([&] { image_of(empty.image); }), "size is 2x0, expected at least one pixel");
  Message swapped("16UC1", 4, std::vector<std::uint8_t>(8));
  swapped.image.is_bigendian = true;
  EXPECT_EQ(error_of([&] { depth_of(swapped.image); }), "is_bigendian is set, expected little-endian depth");
}

}  // namespace stillpoint_ros::raw_image_test
