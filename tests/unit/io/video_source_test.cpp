// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/video_source.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

class VideoSourceTest : public testing::Test {
 protected:
  VideoSourceTest() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

  /// Frames of one grey level each, 10 per second, by the writer that every OpenCV has.
  std::filesystem::path video(int frames) {
    const std::filesystem::path file = folder.path() / "video.avi";
    cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0,
                           {64, 48});
    EXPECT_TRUE(writer.isOpened());
    for (int i = 0; i < frames; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 * i)));
    return file;
  }

  TemporaryFolder folder;
};

TEST_F(VideoSourceTest, HandsOutEachFrameAndItsTime) {
  VideoSource source(video(5));
  EXPECT_EQ(source.size(), cv::Size(64, 48));
  EXPECT_FALSE(source.is_live());
  std::vector<cv::Mat> images;
  cv::Mat image;
  double time_s = -1;
  for (int i = 0; source.read(image, time_s); ++i) {
    EXPECT_NEAR(time_s, 0.1 * i, 1e-3) << i;  // containers count milliseconds
    images.push_back(image);
  }
  ASSERT_EQ(images.size(), 5u);
  constexpr double kCompression = 3;  // grey levels
  for (int i = 0; i < 5; ++i) {       // all of them: an image is not written over by the next
    EXPECT_EQ(images[static_cast<std::size_t>(i)].type(), CV_8UC3);
    EXPECT_NEAR(cv::mean(images[static_cast<std::size_t>(i)])[1], 20 * i, kCompression) << i;
  }
  EXPECT_FALSE(source.read(image, time_s)) << "the end stays the end";
}

TEST_F(VideoSourceTest, ARateOfTheCallersGoesBeforeTheFiles) {
  VideoSource source(video(3), 4.0);
  cv::Mat image;
  double time_s = -1;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(source.read(image, time_s));
    EXPECT_EQ(time_s, 0.25 * i);
  }
  EXPECT_EQ(error_of([&] { VideoSource(folder.path() / "video.avi", -1.0); }),
            "frame rate: found -1, expected a positive number of images per second");
  EXPECT_EQ(error_of([&] { VideoSource(folder.path() / "video.avi", std::numeric_limits<double>::infinity()); }),
            "frame rate: found inf, expected a positive number of images per second");
}

TEST_F(VideoSourceTest, AVideoThatBreaksOffIsNamed) {
  const std::filesystem::path file = video(5);
  const auto size = std::filesystem::file_size(file);
  EXPECT_EQ(detail::missing_bytes(file), 0u);
  std::filesystem::resize_file(file, size - 200);
  EXPECT_EQ(detail::missing_bytes(file), 200u);
  EXPECT_EQ(error_of([&] { VideoSource{file}; }),
            file.string() + ": breaks off, 200 bytes before the end that it states, expected a whole video");
}

/// What other containers state, and how many bytes of it are missing.
TEST_F(VideoSourceTest, OtherContainersStateTheirSizeToo) {
  const auto missing = [&](const std::string& text) { return detail::missing_bytes(folder.write("video.bin", text)); };
  const std::string ftyp(
      "\0\0\0\x0c"
      "ftypisom",
      12),
      mdat(
          "\0\0\0\x10"
          "mdat12345678",
          16);
  EXPECT_EQ(missing(ftyp + mdat), 0u);
  EXPECT_EQ(missing(ftyp + mdat.substr(0, 11)), 5u);
  EXPECT_EQ(missing(ftyp + mdat + std::string(100, 'Z')), 0u) << "what a camera's maker has put behind is no box";
  EXPECT_EQ(missing(ftyp + std::string("\0\0\0\x01"
                                       "mdat\0\0\0\0\0\0\0\x14"
                                       "123",
                                       19)),
            1u);
  EXPECT_EQ(missing(ftyp +
                    std::string("\0\0\0\0"
                                "mdat",
                                8) +
                    "as long as it is"),
            0u);
  const std::string ebml(
      "\x1a\x45\xdf\xa3\x82"
      "ab\x18\x53\x80\x67",
      11);
  EXPECT_EQ(missing(ebml + std::string("\x40\x05"
                                       "12345",
                                       7)),
            0u);
  EXPECT_EQ(missing(ebml + std::string("\x40\x05"
                                       "12",
                                       4)),
            3u);
  EXPECT_EQ(missing(ebml + std::string("\x01\xff\xff\xff\xff\xff\xff\xff", 8)), 0u) << "not known";
  for (const std::string& none : {std::string(), std::string("RI"), std::string("RIFF\xff\xff\xff\xff"), ftyp, ebml})
    EXPECT_EQ(missing(none), 0u);
}

TEST_F(VideoSourceTest, WhatIsNoVideoIsNamed) {
  const std::string missing = (folder.path() / "none.avi").string();
  EXPECT_EQ(error_of([&] { VideoSource{std::filesystem::path(missing)}; }),
            missing + ": no such file, expected a video");
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "OpenCV then asks its readers of other devices, too, whose library (libusb) leaks";
#endif
  for (const char* content : {"", "this is no video"}) {
    const std::filesystem::path file = folder.write("broken.avi", content);
    EXPECT_EQ(error_of([&] { VideoSource{file}; }),
              file.string() + ": cannot be read, expected a video in a format that this OpenCV reads");
  }
}

TEST_F(VideoSourceTest, ACameraThatIsNotThereIsNamed) {
  constexpr int kNobodysCamera = 9731;
  EXPECT_EQ(error_of([&] { VideoSource{kNobodysCamera}; }),
            "camera 9731: cannot be read, expected the number of a camera that is connected and not in use");
}

}  // namespace
}  // namespace stillpoint
