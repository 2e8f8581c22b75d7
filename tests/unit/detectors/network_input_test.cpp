// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/network_input.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint {
namespace {

float value(const NetworkInput& input, int channel, int v, int u) {
  const InputSize& size = input.size();
  return input.values().at(static_cast<std::size_t>((channel * size.height + v) * size.width + u));
}

TEST(NetworkInput, ChannelsMeanAndScaleInTheNetworksOrder) {
  const cv::Mat image(4, 8, CV_8UC3, cv::Scalar(10, 20, 30));  // blue, green, red
  NetworkInput rgb({8, 4}, {ImageFit::stretch, true, {1, 2, 3}, {2, 4, 8}});
  rgb.fill(image);
  EXPECT_FLOAT_EQ(value(rgb, 0, 0, 0), (30 - 1) * 2);
  EXPECT_FLOAT_EQ(value(rgb, 1, 3, 7), (20 - 2) * 4);
  EXPECT_FLOAT_EQ(value(rgb, 2, 2, 5), (10 - 3) * 8);
  NetworkInput bgr({8, 4}, {ImageFit::stretch, false, {1, 2, 3}, {2, 4, 8}});
  bgr.fill(image);
  EXPECT_FLOAT_EQ(value(bgr, 0, 0, 0), (10 - 1) * 2);
  EXPECT_FLOAT_EQ(value(bgr, 2, 2, 5), (30 - 3) * 8);
}

TEST(NetworkInput, GrayFillsAllChannels) {
  NetworkInput input({8, 4}, {});
  input.fill(cv::Mat(4, 8, CV_8UC1, cv::Scalar(77)));
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(value(input, c, 2, 3), 77);
}

TEST(NetworkInput, BarsHaveThePaddingAfterMeanAndScale) {
  const cv::Mat image(4, 8, CV_8UC1, cv::Scalar(200));
  NetworkInput centred({8, 8}, {ImageFit::letterbox_centred, true, {4, 4, 4}, {0.5f, 0.5f, 0.5f}, 114});
  const Letterbox letterbox = centred.fill(image);
  EXPECT_EQ(letterbox.top, 2);
  EXPECT_FLOAT_EQ(value(centred, 0, 1, 0), 55);
  EXPECT_FLOAT_EQ(value(centred, 1, 2, 0), 98);
  EXPECT_FLOAT_EQ(value(centred, 2, 5, 7), 98);
  EXPECT_FLOAT_EQ(value(centred, 2, 6, 7), 55);
  centred.fill(cv::Mat(8, 8, CV_8UC1, cv::Scalar(200)));  // the next image has none: nothing of the last is left
  EXPECT_FLOAT_EQ(value(centred, 0, 0, 0), 98);
}

TEST(NetworkInput, RowsOfAViewMayHaveGaps) {
  cv::Mat large(6, 12, CV_8UC3, cv::Scalar(0, 0, 0));
  large(cv::Rect(2, 1, 8, 4)).setTo(cv::Scalar(5, 6, 7));
  NetworkInput input({8, 4}, {});
  input.fill(cv::Mat(large(cv::Rect(2, 1, 8, 4))));
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 8; ++u) ASSERT_FLOAT_EQ(value(input, 0, v, u), 7);
}

TEST(NetworkInput, RefusesWhatIsNoPicture) {
  NetworkInput input({8, 4}, {});
  expect_contains(error_of([&] { input.fill(ImageView()); }),
                  "found no image, or one of another format, expected BGR or gray");
  expect_contains(error_of([&] { input.fill(cv::Mat(4, 8, CV_16UC1)); }), "found an image of another format");
  expect_contains(error_of([&] { input.fill(cv::Mat(4, 8, CV_8UC4)); }), "found an image of another format");
}

}  // namespace
}  // namespace stillpoint
