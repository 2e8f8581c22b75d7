// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/image_file.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

/// An encoded image of noise, 48 x 32: it does not compress, so half of the bytes are half of the picture.
std::string encoded(const char* extension, int type) {
  Random random(1);
  cv::Mat image(32, 48, type);
  for (int v = 0; v < image.rows; ++v)
    for (std::size_t i = 0; i < 48 * image.elemSize(); ++i) image.ptr(v)[i] = static_cast<uchar>(random.bits());
  std::vector<uchar> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(ReadImage, TakesPngAndJpeg) {
  const TemporaryFolder folder;
  const cv::Mat jpeg = read_image(folder.write("a.jpg", encoded(".jpg", CV_8UC3)), cv::IMREAD_COLOR);
  EXPECT_EQ(jpeg.size(), cv::Size(48, 32));
  EXPECT_EQ(jpeg.type(), CV_8UC3);
  EXPECT_EQ(read_image(folder.write("a.png", encoded(".png", CV_16UC1)), cv::IMREAD_UNCHANGED).type(), CV_16UC1);
  EXPECT_EQ(read_image(folder.write("g.png", encoded(".png", CV_8UC1)), cv::IMREAD_COLOR).type(), CV_8UC3);
}

// An infrared image of 10 bit in 16: its upper 8 bit are 0 to 3.
TEST(ReadImage, MoreThanEightBitIsAnErrorUnlessAllOfItIsAskedFor) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.png", encoded(".png", CV_16UC1));
  EXPECT_EQ(error_of([&] { read_image(file, cv::IMREAD_COLOR); }),
            file.string() + ": found an image of more than 8 bit, expected 8");
  EXPECT_EQ(error_of([&] { read_image(file, cv::IMREAD_GRAYSCALE); }),
            file.string() + ": found an image of more than 8 bit, expected 8");
}

TEST(ReadImage, BytesAfterTheEndOfAJpegDoNoHarm) {
  const TemporaryFolder folder;
  // Markers of a scan among them, and no end: the video behind a phone's picture.
  for (const std::string& behind : {std::string(5000, '\0'), std::string("\xff\xda and more"), std::string("\xff")}) {
    const auto file = folder.write("a.jpg", encoded(".jpg", CV_8UC3) + behind);
    EXPECT_FALSE(read_image(file, cv::IMREAD_COLOR).empty());
  }
}

TEST(ReadImage, FileThatBreaksOffIsNamedWhereverItBreaks) {
  const TemporaryFolder folder;
  for (const std::string& whole : {encoded(".jpg", CV_8UC3), encoded(".png", CV_16UC1)})
    for (const double part : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.99}) {
      const auto kept = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      const auto file = folder.write("broken", whole.substr(0, kept));
      EXPECT_EQ(error_of([&] { read_image(file, cv::IMREAD_UNCHANGED); }),
                file.string() + ": cannot be read, expected a whole PNG or JPEG image")
          << kept << " of " << whole.size();
    }
}

TEST(ReadImage, WhatIsNoImageIsNamed) {
  const TemporaryFolder folder;
  const auto text = folder.write("a.png", "no image");
  EXPECT_EQ(error_of([&] { read_image(text, cv::IMREAD_COLOR); }),
            text.string() + ": cannot be read, expected a whole PNG or JPEG image");
  const auto missing = folder.path() / "none.png";
  EXPECT_EQ(error_of([&] { read_image(missing, cv::IMREAD_COLOR); }), missing.string() + ": no such file");
  EXPECT_EQ(error_of([&] { read_image(folder.path(), cv::IMREAD_COLOR); }), folder.path().string() + ": no such file");
}

}  // namespace
}  // namespace stillpoint
