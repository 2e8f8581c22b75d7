// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/opencv_dnn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

/// Networks of make_networks.py: input 96x64, answers that can be computed by hand.
class OpenCvDetectorTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(network("channel_means")))
      GTEST_SKIP() << "no made networks: Python had no module onnx when this was built (Debian: python3-onnx)";
  }
  static fs::path network(const std::string& name) { return fs::path(STILLPOINT_TEST_NETWORKS) / (name + ".onnx"); }

  static std::vector<Detection> detect(OpenCvDetector& detector, const cv::Mat& image) {
    std::vector<Detection> found(3);  // what was there before must go
    detector.detect(image, found);
    return found;
  }
  /// "person 0.50" for each.
  static std::string said(const OpenCvDetector& detector, const std::vector<Detection>& found) {
    std::string text;
    for (const Detection& detection : found) {
      const auto percent = std::lround(100 * static_cast<double>(detection.confidence));
      text +=
          detector.classes()[static_cast<std::size_t>(detection.class_index)] + " " + std::to_string(percent) + "; ";
    }
    return text;
  }
};
constexpr float kBoxTolerance = 0.01f;  // float arithmetic on pixels

TEST_F(OpenCvDetectorTest, ColourOrderAndScaleReachTheNetwork) {
  OpenCvDetector::Options options;
  options.lowest_confidence = 0.1f;
  OpenCvDetector detector(network("channel_means"), options);
  EXPECT_EQ(detector.layout(), DetectorLayout::yolov8);
  EXPECT_EQ(detector.classes().size(), 80u);
  EXPECT_EQ(detector.input_size().width, 96);
  EXPECT_EQ(detector.input_size().height, 64);
  // Red 204, green 102, blue 51 of 255: the means 0.8, 0.4, 0.2 are the scores of classes 0, 1, 2.
  const cv::Mat image(128, 192, CV_8UC3, cv::Scalar(51, 102, 204));
  const auto found = detect(detector, image);
  EXPECT_EQ(said(detector, found), "person 80; bicycle 40; car 20; ");
  // Box 1 is 40 to 56, 16 to 48 of the input, half as large as the image.
  EXPECT_NEAR(found[1].box.x, 79.5f, kBoxTolerance);
  EXPECT_NEAR(found[1].box.y, 31.5f, kBoxTolerance);
  EXPECT_NEAR(found[1].box.width, 32, kBoxTolerance);
  EXPECT_NEAR(found[1].box.height, 64, kBoxTolerance);
  EXPECT_EQ(found[1].mobility, Mobility::dynamic);

  options.preprocess = Preprocess{ImageFit::stretch, false, {51, 0, 0}, {0.01f, 0.002f, 0.004f}};
  OpenCvDetector blue_first(network("channel_means"), options);
  // (51 - 51)·0.01, 102·0.002 = 0.204, 204·0.004 = 0.816
  EXPECT_EQ(said(blue_first, detect(blue_first, image)), "car 82; bicycle 20; ");
}

TEST_F(OpenCvDetectorTest, BarsOfTheLetterboxReachTheNetwork) {
  OpenCvDetector detector(network("channel_means"));
  // 100x100 becomes 64x64 of 96x64: a third is padding, 114/255. (2·255 + 114)/(3·255) = 0.816.
  const auto found = detect(detector, cv::Mat(100, 100, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(said(detector, found), "person 82; ");
  // Box 0 is 8 to 24 of the input, of which 16 to 24 show the image: 0 to 8 of 64, times 100/64.
  EXPECT_NEAR(found[0].box.x, -0.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 12.5f, kBoxTolerance);
}

TEST_F(OpenCvDetectorTest, GrayIsTaken) {
  OpenCvDetector detector(network("channel_means"));
  const auto found = detect(detector, cv::Mat(64, 96, CV_8UC1, cv::Scalar(153)));
  EXPECT_EQ(said(detector, found), "person 60; bicycle 60; car 60; ");
}

TEST_F(OpenCvDetectorTest, NothingFoundIsNoDetection) {
  OpenCvDetector detector(network("channel_means"));
  EXPECT_TRUE(detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 0))).empty());
}

TEST_F(OpenCvDetectorTest, EqualImagesGiveEqualAnswers) {
  OpenCvDetector detector(network("channel_means"));
  cv::Mat image(70, 90, CV_8UC3);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols * 3; ++u) image.ptr(v)[u] = static_cast<unsigned char>((u * 7 + v * 13) | 128);
  const auto first = detect(detector, image);
  detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 0)));
  const auto second = detect(detector, image);
  ASSERT_EQ(first.size(), second.size());
  ASSERT_FALSE(first.empty());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].confidence, second[i].confidence);
}

TEST_F(OpenCvDetectorTest, OfBoxesOfAClassThatOverlapTheBestIsLeft) {
  OpenCvDetector::Options options;
  const cv::Mat image(64, 96, CV_8UC3, cv::Scalar(0, 0, 0));
  OpenCvDetector detector(network("duplicates"), options);
  const auto found = detect(detector, image);
  EXPECT_EQ(said(detector, found), "person 90; car 80; person 60; ");
  EXPECT_NEAR(found[0].box.x, 10.5f, kBoxTolerance);
  options.highest_overlap = 0.95f;  // theirs is 19/21 = 0.905
  OpenCvDetector lenient(network("duplicates"), options);
  EXPECT_EQ(said(lenient, detect(lenient, image)), "person 90; car 80; person 70; person 60; ");
}

TEST_F(OpenCvDetectorTest, ARedPatchIsFoundWhereItIs) {
  OpenCvDetector::Options options;
  options.outputs = {"person"};
  cv::Mat image(100, 200, CV_8UC3, cv::Scalar(255, 255, 0));
  image(cv::Rect(100, 20, 40, 50)).setTo(cv::Scalar(0, 0, 255));
  for (const ImageFit fit : {ImageFit::stretch, ImageFit::letterbox_centred, ImageFit::letterbox_top_left}) {
    options.preprocess = Preprocess{fit, true, {0, 0, 0}, {1 / 255.0f, 1 / 255.0f, 1 / 255.0f}, 0};
    OpenCvDetector detector(network("first_channel"), options);
    EXPECT_EQ(detector.layout(), DetectorLayout::segmentation);
    const auto found = detect(detector, image);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(detector.classes()[0], "person");
    // A pixel of the input is 2.1 (stretched: 1.6 by height) pixels of the image.
    EXPECT_NEAR(found[0].box.x, 99.5f, 2.1f);
    EXPECT_NEAR(found[0].box.y, 19.5f, 2.1f);
    EXPECT_NEAR(found[0].box.width, 40, 4.2f);
    EXPECT_NEAR(found[0].box.height, 50, 4.2f);
    ASSERT_TRUE(found[0].mask);
    EXPECT_TRUE(found[0].holds({120, 45}, 0));
    options.preprocess->rgb = false;  // now blue is a person: all but the patch, in one part with a hole
    OpenCvDetector blue(network("first_channel"), options);
    const auto rest = detect(blue, image);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_FALSE(rest[0].holds({120, 45}, 0));
    EXPECT_TRUE(rest[0].holds({50, 45}, 0));
  }
}

TEST_F(OpenCvDetectorTest, ALabelMapOfIntegersIsRead) {
  OpenCvDetector::Options options;
  options.layout = DetectorLayout::label_map;
  options.classes = ClassList::voc21();
  OpenCvDetector detector(network("label_map"), options);
  cv::Mat image(64, 96, CV_8UC3, cv::Scalar(255, 255, 0));
  image(cv::Rect(40, 10, 30, 40)).setTo(cv::Scalar(0, 0, 255));
  const auto found = detect(detector, image);
  EXPECT_EQ(said(detector, found), "person 100; ");
  EXPECT_NEAR(found[0].box.x, 39.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.y, 9.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 30, kBoxTolerance);
}

TEST_F(OpenCvDetectorTest, HeadsNeedTheirFamilyAndAnchors) {
  expect_contains(error_of([] { OpenCvDetector(network("heads")); }),
                  "heads.onnx: outputs 1x255x4x6, 1x255x8x12 fit more than one layout; set one of yolov3");
  OpenCvDetector::Options options;
  options.layout = DetectorLayout::yolov5;
  expect_contains(error_of([&] { OpenCvDetector(network("heads"), options); }), "anchors: found 9, expected 6");
  options.coding = yolo_coding(DetectorLayout::yolov5);
  options.coding->anchors = {{4, 4}, {16, 24}, {30, 30}, {40, 40}, {50, 50}, {60, 60}};
  OpenCvDetector detector(network("heads"), options);
  const auto found = detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(said(detector, found), "person 100; ");
  // Row 3, column 5, stride 8, second anchor: middle (44, 28), size 16x24.
  EXPECT_NEAR(found[0].box.x, 35.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.y, 15.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 16, kBoxTolerance);
  EXPECT_NEAR(found[0].box.height, 24, kBoxTolerance);
  EXPECT_TRUE(detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 0))).empty());
}

TEST_F(OpenCvDetectorTest, AnInputOfAnySizeMustBeTold) {
  const std::string error = error_of([] { OpenCvDetector(network("any_size")); });
  expect_contains(error, "any_size.onnx: the file does not say how large an input the network wants");
  OpenCvDetector::Options options;
  options.input_size = {96, 64};
  OpenCvDetector detector(network("any_size"), options);
  EXPECT_EQ(detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 255))).size(), 3u);
  options.input_size = {96, -1};
  expect_contains(error_of([&] { OpenCvDetector(network("any_size"), options); }), "found the input size 96x-1");
}

TEST_F(OpenCvDetectorTest, WhatCannotBeReadIsSaidAtConstruction) {
  expect_contains(error_of([] { OpenCvDetector("/no/such.onnx"); }), "/no/such.onnx: no such file");
  const std::string refused = error_of([] { OpenCvDetector(network("cannot_read")); });
  expect_contains(refused, "cannot_read.onnx: OpenCV " CV_VERSION " cannot read this network");
  EXPECT_EQ(refused.find('\n'), refused.npos);
  const fs::path broken = fs::path(testing::TempDir()) / "stillpoint_broken.onnx";
  std::ofstream(broken, std::ios::binary) << "this is no network";
  expect_contains(error_of([&] { OpenCvDetector detector(broken); }), "stillpoint_broken.onnx: OpenCV");
}

TEST_F(OpenCvDetectorTest, AFirstRunThatFailsIsSaidAtConstruction) {
  // OpenCV 4.6 reads this network, and throws when it shall run it; a later one may do both.
  const std::string error = error_of([] { OpenCvDetector(network("cannot_run")); });
  if (error.find("cannot run this network") == error.npos) expect_contains(error, "fit no layout");
  expect_contains(error, "cannot_run.onnx: ");
}

TEST_F(OpenCvDetectorTest, WrongOptionsAreSaidAtConstruction) {
  expect_contains(error_of([] { OpenCvDetector(network("no_layout")); }),
                  "no_layout.onnx: outputs 1x1000 with an input of 96x64");
  OpenCvDetector::Options options;
  options.layout = DetectorLayout::yolox;
  expect_contains(error_of([&] { OpenCvDetector(network("channel_means"), options); }), "channel_means.onnx: ");
  options = {};
  options.outputs = {"nothing"};
  expect_contains(error_of([&] { OpenCvDetector(network("channel_means"), options); }),
                  "found no output 'nothing', expected one of boxes");
  options = {};
  options.backend = cv::dnn::DNN_BACKEND_VKCOM;
  options.target = cv::dnn::DNN_TARGET_MYRIAD;
  expect_contains(error_of([&] { OpenCvDetector(network("channel_means"), options); }), "was built without backend");
}

TEST_F(OpenCvDetectorTest, BadImagesAreErrorsAndLeaveNothing) {
  OpenCvDetector detector(network("channel_means"));
  std::vector<Detection> found(2);
  EXPECT_THROW(detector.detect(ImageView(), found), Error);
  EXPECT_TRUE(found.empty());
  EXPECT_THROW(detector.detect(cv::Mat(64, 96, CV_32FC1), found), Error);
}

TEST_F(OpenCvDetectorTest, CanBeMoved) {
  OpenCvDetector first(network("channel_means"));
  OpenCvDetector second = std::move(first);
  EXPECT_EQ(detect(second, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 255))).size(), 3u);
}

}  // namespace
}  // namespace stillpoint
