// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#include "stillpoint/io/tum_sequence.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "unit/error_of.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {
namespace {

const std::string kCamera =
    "%YAML:1.0\n---\nfx: 50.0\nfy: 50.0\ncx: 32.0\ncy: 24.0\nwidth: 64\nheight: 48\ndepth_factor: 1000.0\n";

/// A sequence of two frames of 64 x 48 pixels; colour and depth can be told by their values.
class TumSequenceTest : public testing::Test {
 protected:
  TumSequenceTest() {
    folder.write("camera.yaml", kCamera);
    folder.write("associations.txt", "1.0 rgb/1.0.jpg 1.0 depth/1.0.png\n1.1 rgb/1.1.png 1.1 depth/1.1.png\n");
    for (const char* name : {"rgb", "depth", "labels"}) std::filesystem::create_directory(folder.path() / name);
    image("rgb/1.0.jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 120, 230)));
    image("rgb/1.1.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(77)));
    image("depth/1.0.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(1500)));
    image("depth/1.1.png", cv::Mat(24, 32, CV_16UC1, cv::Scalar(65535)));
    image("labels/1.0.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(255)));
  }

  void image(const std::string& name, const cv::Mat& pixels) {
    ASSERT_TRUE(cv::imwrite((folder.path() / name).string(), pixels));
  }

  std::string message_of_load(std::size_t index) {
    return error_of([&] { TumSequence(folder.path()).load(index); });
  }
  std::string path(const std::string& name) { return (folder.path() / name).string(); }

  TemporaryFolder folder;
};

TEST_F(TumSequenceTest, KnowsItsFramesAndCamera) {
  const TumSequence sequence(folder.path());
  EXPECT_EQ(sequence.folder(), folder.path());
  ASSERT_EQ(sequence.frames().size(), 2u);
  EXPECT_EQ(sequence.frames()[1].timestamp_s, 1.1);
  EXPECT_EQ(sequence.camera().width(), 64);
  EXPECT_EQ(sequence.depth_factor(), 1000.0);
  EXPECT_FALSE(sequence.ground_truth());
}

TEST_F(TumSequenceTest, LoadsColourAndGrayJpegAndPng) {
  const TumSequence sequence(folder.path());
  const RgbdImages first = sequence.load(0);
  ASSERT_EQ(first.colour.type(), CV_8UC3);
  constexpr double kJpegLoss = 4.0;
  EXPECT_LT(cv::norm(first.colour.at<cv::Vec3b>(20, 30), cv::Vec3b(10, 120, 230), cv::NORM_INF), kJpegLoss);
  ASSERT_EQ(first.depth.type(), CV_16UC1);
  EXPECT_EQ(first.depth.at<std::uint16_t>(20, 30), 1500);

  const RgbdImages second = sequence.load(1);
  EXPECT_EQ(second.colour.at<cv::Vec3b>(20, 30), cv::Vec3b(77, 77, 77));
  EXPECT_EQ(second.depth.size(), cv::Size(32, 24));
  EXPECT_EQ(second.depth.at<std::uint16_t>(20, 30), 65535);
}

TEST_F(TumSequenceTest, ReadsGroundTruthIfItIsThere) {
  folder.write("groundtruth.txt", "1.0 1 2 3 0 0 0 1\n");
  const TumSequence sequence(folder.path());
  ASSERT_TRUE(sequence.ground_truth());
  EXPECT_EQ(sequence.ground_truth()->size(), 1u);

  folder.write("groundtruth.txt", "1.0 1 2 3 0 0 0 0\n");
  EXPECT_EQ(error_of([&] { TumSequence{folder.path()}; }),
            path("groundtruth.txt") + ":1: found a quaternion of length zero, expected qx qy qz qw of length one");
}

TEST_F(TumSequenceTest, CameraOfTheCallerGoesFirst) {
  folder.write("camera.yaml", "broken");
  const TumSequence sequence(folder.path(), RgbdCamera{Camera(40, 40, 32, 24, 64, 48), 5000.0});
  EXPECT_EQ(sequence.camera().fx(), 40.0);
  EXPECT_NE(error_of([&] { TumSequence{folder.path()}; }).find("camera.yaml"), std::string::npos);
}

TEST_F(TumSequenceTest, NameOfAnOriginalFolderTellsTheCamera) {
  const auto renamed = folder.path() / "rgbd_dataset_freiburg3_sitting";
  std::filesystem::create_directory(renamed);
  for (const char* name : {"associations.txt", "rgb", "depth"})
    std::filesystem::rename(folder.path() / name, renamed / name);
  EXPECT_EQ(TumSequence(renamed).camera().fx(), 535.4);
}

TEST_F(TumSequenceTest, FolderWithoutACameraSaysHowToGiveOne) {
  std::filesystem::remove(folder.path() / "camera.yaml");
  EXPECT_EQ(error_of([&] { TumSequence{folder.path()}; }),
            folder.path().string() +
                ": found no camera, expected camera.yaml with fx fy cx cy width height depth_factor in it, freiburg1, "
                "freiburg2 or freiburg3 in its name, or a camera file given beside it");
}

TEST_F(TumSequenceTest, ImageThatCannotBeReadIsNamed) {
  folder.write("rgb/1.0.jpg", "no image");
  EXPECT_EQ(message_of_load(0), path("rgb/1.0.jpg") + ": cannot be read, expected a whole PNG or JPEG image");
  folder.write("rgb/1.1.png", "");
  EXPECT_EQ(message_of_load(1), path("rgb/1.1.png") + ": cannot be read, expected a whole PNG or JPEG image");
}

TEST_F(TumSequenceTest, ColourOfAnotherSizeThanTheCameraIsNamed) {
  image("rgb/1.0.jpg", cv::Mat(96, 128, CV_8UC3, cv::Scalar::all(0)));
  EXPECT_EQ(message_of_load(0), path("rgb/1.0.jpg") + ": found 128 x 96 pixels, expected the camera's 64 x 48");
}

TEST_F(TumSequenceTest, DepthOfAnotherTypeOrShapeIsNamed) {
  image("depth/1.0.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(1)));
  EXPECT_EQ(message_of_load(0),
            path("depth/1.0.png") + ": found 1 channel(s) of 8 bit, expected 1 channel(s) of 16 bit");
  image("depth/1.0.png", cv::Mat(48, 64, CV_16UC3, cv::Scalar::all(1)));
  EXPECT_EQ(message_of_load(0),
            path("depth/1.0.png") + ": found 3 channel(s) of 16 bit, expected 1 channel(s) of 16 bit");
  image("depth/1.0.png", cv::Mat(48, 48, CV_16UC1, cv::Scalar(1)));
  EXPECT_EQ(message_of_load(0),
            path("depth/1.0.png") + ": found 48 x 48 pixels, expected the shape of the colour image, 64 x 48");
}

TEST_F(TumSequenceTest, ShapeOfTheDepthMayDifferByOnePercent) {
  // 64/48 = 1.3333: 129/96 = 1.34375 is 0.8 % off, 130/96 is 1.6 % off.
  image("depth/1.0.png", cv::Mat(96, 129, CV_16UC1, cv::Scalar(1)));
  EXPECT_EQ(message_of_load(0), "no error");
  image("depth/1.0.png", cv::Mat(96, 130, CV_16UC1, cv::Scalar(1)));
  EXPECT_NE(message_of_load(0).find("found 130 x 96 pixels"), std::string::npos);
}

TEST_F(TumSequenceTest, FrameThatIsNotThereIsAnError) {
  EXPECT_EQ(message_of_load(2), folder.path().string() + ": frame 2 is asked for, expected one below 2");
}

TEST_F(TumSequenceTest, LabelsAreFoundByTheColoursName) {
  const TumSequence sequence(folder.path());
  EXPECT_TRUE(sequence.has_labels());
  const cv::Mat labels = sequence.load_labels(0);
  ASSERT_EQ(labels.type(), CV_8UC1);
  EXPECT_EQ(labels.at<std::uint8_t>(3, 4), 255);
  EXPECT_EQ(error_of([&] { sequence.load_labels(1); }), path("labels/1.1.png") + ": no such file");
}

TEST_F(TumSequenceTest, LabelsOfAnotherTypeOrSizeAreNamed) {
  const TumSequence sequence(folder.path());
  image("labels/1.0.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(255)));
  EXPECT_EQ(error_of([&] { sequence.load_labels(0); }),
            path("labels/1.0.png") + ": found 1 channel(s) of 16 bit, expected 1 channel(s) of 8 bit");
  image("labels/1.0.png", cv::Mat(24, 32, CV_8UC1, cv::Scalar(255)));
  EXPECT_EQ(error_of([&] { sequence.load_labels(0); }),
            path("labels/1.0.png") + ": found 32 x 24 pixels, expected the camera's 64 x 48");
  std::filesystem::remove_all(folder.path() / "labels");
  EXPECT_FALSE(sequence.has_labels());
}

TEST(TumSequenceOnSharedData, OpensTheKitchen) {
#ifdef STILLPOINT_SHARED_DATA
  const std::filesystem::path folder = std::filesystem::path(STILLPOINT_SHARED_DATA) / "kitchen_walk";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared sequences are not here";
  const TumSequence sequence(folder);
  ASSERT_EQ(sequence.frames().size(), 222u);
  EXPECT_EQ(sequence.camera().fx(), 525.0);
  EXPECT_EQ(sequence.depth_factor(), 5000.0);
  ASSERT_TRUE(sequence.ground_truth());
  EXPECT_EQ(sequence.ground_truth()->size(), 222u);
  EXPECT_TRUE(sequence.has_labels());
  const RgbdImages images = sequence.load(221);
  EXPECT_EQ(images.colour.size(), cv::Size(640, 480));
  EXPECT_EQ(images.depth.size(), cv::Size(640, 480));
  EXPECT_GT(cv::countNonZero(sequence.load_labels(221)), 0);
#else
  GTEST_SKIP() << "the shared sequences are not here";
#endif
}

}  // namespace
}  // namespace stillpoint
