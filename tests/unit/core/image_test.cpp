// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/core/image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "stillpoint/core/random.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint::image_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(ImageView, ReadsTheFormatsOfCvMat) {
  EXPECT_EQ(ImageView(cv::Mat(2, 3, CV_8UC1)).format, PixelFormat::gray8);
  EXPECT_EQ(ImageView(cv::Mat(2, 3, CV_8UC3)).format, PixelFormat::bgr8);
  EXPECT_EQ(ImageView(cv::Mat(2, 3, CV_16UC1)).format, PixelFormat::depth16);
  EXPECT_EQ(ImageView(cv::Mat(2, 3, CV_32FC1)).format, PixelFormat::depth32f);
  for (const int type : {CV_8SC1, CV_8UC2, CV_8UC4, CV_16SC1, CV_16SC3, CV_16UC3, CV_32SC1, CV_32FC3, CV_64FC1})
    EXPECT_EQ(ImageView(cv::Mat(2, 3, type)).format, PixelFormat::unsupported) << type;
  EXPECT_TRUE(ImageView(cv::Mat()).empty());
  const int sizes[] = {2, 3, 4};
  EXPECT_TRUE(ImageView(cv::Mat(3, sizes, CV_8UC1)).empty());
}

TEST(ImageView, RowsOfAPartOfAnImageUseItsStride) {
  cv::Mat whole(6, 8, CV_8UC1);
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 8; ++u) whole.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(10 * v + u);
  const ImageView part(whole(cv::Rect(2, 1, 3, 4)));
  EXPECT_EQ(part.width, 3);
  EXPECT_EQ(part.height, 4);
  EXPECT_EQ(part.row<std::uint8_t>(0)[0], 12);
  EXPECT_EQ(part.row<std::uint8_t>(3)[2], 44);
  ImageBuffer copy;
  copy.assign(part);
  EXPECT_EQ(copy.view().stride_bytes, 3u);
  EXPECT_EQ(copy.view().row<std::uint8_t>(3)[2], 44);
  const cv::Mat back = as_mat(part);
  EXPECT_EQ(back.at<std::uint8_t>(3, 2), 44);
  EXPECT_EQ(back.data, part.data);
}

TEST(ImageView, BorderDistanceIsToTheOutermostPixelCentre) {
  const cv::Mat mat(5, 10, CV_8UC1);
  const ImageView image(mat);
  EXPECT_FLOAT_EQ(image.border_distance_px(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(image.border_distance_px(9, 4), 0.0f);
  EXPECT_FLOAT_EQ(image.border_distance_px(1.5f, 2), 1.5f);  // left: 1.5, top and bottom: 2
  EXPECT_FLOAT_EQ(image.border_distance_px(7.75f, 2), 1.25f);
  EXPECT_FLOAT_EQ(image.border_distance_px(5, 3.25f), 0.75f);
  EXPECT_FLOAT_EQ(image.border_distance_px(-0.25f, 2), -0.25f);
  EXPECT_FLOAT_EQ(image.border_distance_px(5, 4.5f), -0.5f);
  EXPECT_TRUE(std::isnan(image.border_distance_px(kNaN, 2)));
  EXPECT_TRUE(std::isnan(image.border_distance_px(2, kNaN)));
  EXPECT_LT(image.border_distance_px(kInfinity, 2), 0);
  EXPECT_LT(image.border_distance_px(2, -kInfinity), 0);
}

TEST(ImageView, ItsLongerSideIsThatOfAnImageOnItsSide) {
  EXPECT_EQ(ImageView(nullptr, 640, 480, 640, PixelFormat::gray8).longer_side_px(), 640);
  EXPECT_EQ(ImageView(nullptr, 480, 640, 480, PixelFormat::gray8).longer_side_px(), 640);
}

TEST(ImageView, ContainsItsPixels) {
  const cv::Mat mat(5, 10, CV_8UC1);
  const ImageView image(mat);
  EXPECT_TRUE(image.contains(0, 0) && image.contains(9, 4));
  EXPECT_FALSE(image.contains(10, 4) || image.contains(9, 5) || image.contains(-1, 0) || image.contains(0, -1));
  EXPECT_FALSE(ImageView().contains(0, 0));
}

TEST(ImageBuffer, KeepsItsMemoryForImagesOfTheSameSize) {
  const cv::Mat first(5, 7, CV_16UC1, cv::Scalar(1)), second(5, 7, CV_16UC1, cv::Scalar(2));
  ImageBuffer buffer;
  EXPECT_TRUE(buffer.view().empty());
  buffer.assign(first);
  const std::uint8_t* const memory = buffer.view().data;
  EXPECT_NE(memory, first.data);
  buffer.assign(second);
  EXPECT_EQ(buffer.view().data, memory);
  EXPECT_EQ(buffer.view().row<std::uint16_t>(4)[6], 2);
  buffer.assign(ImageView());
  EXPECT_TRUE(buffer.view().empty());
  buffer.assign(first);
  EXPECT_EQ(buffer.view().data, memory);
  EXPECT_EQ(buffer.view().format, PixelFormat::depth16);
}

TEST(GrayFromBgr, EqualsOpenCVByteForByte) {
  // Every blue and green with a few reds, and random colours: no pixel differs.
  cv::Mat colour(256, 256, CV_8UC3);
  Random random(4);
  for (int red : {0, 1, 127, 128, 254, 255, -1}) {
    for (int v = 0; v < 256; ++v)
      for (int u = 0; u < 256; ++u)
        colour.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v),
                                      static_cast<std::uint8_t>(red < 0 ? random.index(256) : std::size_t(red))};
    cv::Mat expected;
    cv::cvtColor(colour, expected, cv::COLOR_BGR2GRAY);
    ImageBuffer gray;
    gray_from_bgr(colour, gray);
    EXPECT_EQ(cv::norm(as_mat(gray.view()), expected, cv::NORM_INF), 0.0) << "red " << red;
  }
}

TEST(GrayFromBgr, ReadsRowsWithGaps) {
  cv::Mat whole(20, 31, CV_8UC3, cv::Scalar(255, 255, 255));
  cv::Mat part = whole(cv::Rect(3, 2, 11, 9));
  part.setTo(cv::Scalar(100, 0, 0));  // 0.114 · 100 = 11.4
  ImageBuffer gray;
  gray_from_bgr(part, gray);
  EXPECT_EQ(gray.view().width, 11);
  EXPECT_EQ(gray.view().height, 9);
  for (int v = 0; v < 9; ++v)
    for (int u = 0; u < 11; ++u) ASSERT_EQ(gray.view().row<std::uint8_t>(v)[u], 11);
}

TEST(ImageView, OfOpenCVsTypedImages) {
  const cv::Mat1b gray(48, 64, std::uint8_t{100});
  const cv::Mat1w depth(48, 64, std::uint16_t{2000});
  EXPECT_EQ(ImageView(gray).format, PixelFormat::gray8);
  EXPECT_EQ(ImageView(gray).data, gray.data);
  EXPECT_EQ(ImageView(depth).format, PixelFormat::depth16);
  EXPECT_EQ(ImageView(cv::Mat3b(4, 4)).format, PixelFormat::bgr8);
  EXPECT_EQ(ImageView(cv::Mat1d(4, 4)).format, PixelFormat::unsupported);
}

}  // namespace
}  // namespace stillpoint::image_test
