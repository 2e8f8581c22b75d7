// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#pragma once

// What each detector that runs networks must do, whichever library runs them: one suite, instantiated for each.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/detector_options.hpp"
#include "stillpoint/opencv.hpp"
#include "unit/detectors/made_tensor.hpp"
#include "unit/temporary_folder.hpp"

namespace stillpoint {

namespace fs = std::filesystem;

constexpr float kBoxTolerance = 0.01f;  // float arithmetic on pixels

/// Networks of make_networks.py: input 96x64, answers that can be computed by hand.
template <class Detector>
class DetectorContract : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(network("channel_means")))
      GTEST_SKIP() << "no made networks: Python had no module onnx when this was built (Debian: python3-onnx)";
  }
  static fs::path network(const std::string& name) { return fs::path(STILLPOINT_TEST_NETWORKS) / (name + ".onnx"); }

  static std::vector<Detection> detect(Detector& detector, const cv::Mat& image) {
    std::vector<Detection> found(3);  // what was there before must go
    detector.detect(image, found);
    return found;
  }
  /// "person 50; " for each that was found with a confidence of one half.
  static std::string said(const Detector& detector, const std::vector<Detection>& found) {
    std::string text;
    for (const Detection& detection : found) {
      const auto percent = std::lround(100 * static_cast<double>(detection.confidence));
      text +=
          detector.classes()[static_cast<std::size_t>(detection.class_index)] + " " + std::to_string(percent) + "; ";
    }
    return text;
  }
};
TYPED_TEST_SUITE_P(DetectorContract);

TYPED_TEST_P(DetectorContract, ColourOrderAndScaleReachTheNetwork) {
  typename TypeParam::Options options;
  options.lowest_confidence = 0.1f;
  TypeParam detector(this->network("channel_means"), options);
  EXPECT_EQ(detector.layout(), DetectorLayout::yolov8);
  EXPECT_EQ(detector.classes().size(), 80u);
  EXPECT_EQ(detector.input_size().width, 96);
  EXPECT_EQ(detector.input_size().height, 64);
  // Red 204, green 102, blue 51 of 255: the means 0.8, 0.4, 0.2 are the scores of classes 0, 1, 2.
  const cv::Mat image(128, 192, CV_8UC3, cv::Scalar(51, 102, 204));
  const auto found = this->detect(detector, image);
  EXPECT_EQ(this->said(detector, found), "person 80; bicycle 40; car 20; ");
  // Box 1 is 40 to 56, 16 to 48 of the input, half as large as the image.
  EXPECT_NEAR(found[1].box.x, 79.5f, kBoxTolerance);
  EXPECT_NEAR(found[1].box.y, 31.5f, kBoxTolerance);
  EXPECT_NEAR(found[1].box.width, 32, kBoxTolerance);
  EXPECT_NEAR(found[1].box.height, 64, kBoxTolerance);
  EXPECT_EQ(found[1].mobility, Mobility::dynamic);

  options.preprocess = Preprocess{ImageFit::stretch, false, {51, 0, 0}, {0.01f, 0.002f, 0.004f}};
  TypeParam blue_first(this->network("channel_means"), options);
  // (51 - 51)·0.01, 102·0.002 = 0.204, 204·0.004 = 0.816
  EXPECT_EQ(this->said(blue_first, this->detect(blue_first, image)), "car 82; bicycle 20; ");
}

TYPED_TEST_P(DetectorContract, BarsOfTheLetterboxReachTheNetwork) {
  TypeParam detector(this->network("channel_means"));
  // 100x100 becomes 64x64 of 96x64: a third is padding, 114/255. (2·255 + 114)/(3·255) = 0.816.
  const auto found = this->detect(detector, cv::Mat(100, 100, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(this->said(detector, found), "person 82; ");
  // Box 0 is 8 to 24 of the input, of which 16 to 24 show the image: 0 to 8 of 64, times 100/64.
  EXPECT_NEAR(found[0].box.x, -0.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 12.5f, kBoxTolerance);
}

TYPED_TEST_P(DetectorContract, GrayIsTaken) {
  TypeParam detector(this->network("channel_means"));
  const auto found = this->detect(detector, cv::Mat(64, 96, CV_8UC1, cv::Scalar(153)));
  EXPECT_EQ(this->said(detector, found), "person 60; bicycle 60; car 60; ");
}

TYPED_TEST_P(DetectorContract, NothingFoundIsNoDetection) {
  TypeParam detector(this->network("channel_means"));
  EXPECT_TRUE(this->detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 0))).empty());
}

TYPED_TEST_P(DetectorContract, EqualImagesGiveEqualAnswers) {
  TypeParam detector(this->network("channel_means"));
  cv::Mat image(70, 90, CV_8UC3);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols * 3; ++u) image.ptr(v)[u] = static_cast<unsigned char>((u * 7 + v * 13) | 128);
  const auto first = this->detect(detector, image);
  this->detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 0)));
  const auto second = this->detect(detector, image);
  ASSERT_EQ(first.size(), second.size());
  ASSERT_FALSE(first.empty());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].confidence, second[i].confidence);
}

TYPED_TEST_P(DetectorContract, OfBoxesOfAClassThatOverlapTheBestIsLeft) {
  typename TypeParam::Options options;
  const cv::Mat image(64, 96, CV_8UC3, cv::Scalar(0, 0, 0));
  TypeParam detector(this->network("duplicates"), options);
  const auto found = this->detect(detector, image);
  EXPECT_EQ(this->said(detector, found), "person 90; car 80; person 60; ");
  EXPECT_NEAR(found[0].box.x, 10.5f, kBoxTolerance);
  options.highest_overlap = 0.95f;  // theirs is 19/21 = 0.905
  TypeParam lenient(this->network("duplicates"), options);
  EXPECT_EQ(this->said(lenient, this->detect(lenient, image)), "person 90; car 80; person 70; person 60; ");
}

TYPED_TEST_P(DetectorContract, ARedPatchIsFoundWhereItIs) {
  typename TypeParam::Options options;
  options.outputs = {"person"};
  cv::Mat image(100, 200, CV_8UC3, cv::Scalar(255, 255, 0));
  image(cv::Rect(100, 20, 40, 50)).setTo(cv::Scalar(0, 0, 255));
  for (const ImageFit fit : {ImageFit::stretch, ImageFit::letterbox_centred, ImageFit::letterbox_top_left}) {
    options.preprocess = Preprocess{fit, true, {0, 0, 0}, {1 / 255.0f, 1 / 255.0f, 1 / 255.0f}, 0};
    TypeParam detector(this->network("first_channel"), options);
    EXPECT_EQ(detector.layout(), DetectorLayout::segmentation);
    const auto found = this->detect(detector, image);
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
    TypeParam blue(this->network("first_channel"), options);
    const auto rest = this->detect(blue, image);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_FALSE(rest[0].holds({120, 45}, 0));
    EXPECT_TRUE(rest[0].holds({50, 45}, 0));
  }
}

TYPED_TEST_P(DetectorContract, ALabelMapOfIntegersIsRead) {
  typename TypeParam::Options options;
  options.layout = DetectorLayout::label_map;
  options.classes = ClassList::voc21();
  TypeParam detector(this->network("label_map"), options);
  cv::Mat image(64, 96, CV_8UC3, cv::Scalar(255, 255, 0));
  image(cv::Rect(40, 10, 30, 40)).setTo(cv::Scalar(0, 0, 255));
  const auto found = this->detect(detector, image);
  EXPECT_EQ(this->said(detector, found), "person 100; ");
  EXPECT_NEAR(found[0].box.x, 39.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.y, 9.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 30, kBoxTolerance);
}

TYPED_TEST_P(DetectorContract, HeadsNeedTheirFamilyAndAnchors) {
  expect_contains(error_of([&] { TypeParam(this->network("heads")); }),
                  "heads.onnx: outputs 1x255x4x6, 1x255x8x12 fit more than one layout; set one of yolov3");
  typename TypeParam::Options options;
  options.layout = DetectorLayout::yolov5;
  expect_contains(error_of([&] { TypeParam(this->network("heads"), options); }), "anchors: found 9, expected 6");
  options.coding = yolo_coding(DetectorLayout::yolov5);
  options.coding->anchors = {{4, 4}, {16, 24}, {30, 30}, {40, 40}, {50, 50}, {60, 60}};
  TypeParam detector(this->network("heads"), options);
  const auto found = this->detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 255)));
  EXPECT_EQ(this->said(detector, found), "person 100; ");
  // Row 3, column 5, stride 8, second anchor: middle (44, 28), size 16x24.
  EXPECT_NEAR(found[0].box.x, 35.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.y, 15.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 16, kBoxTolerance);
  EXPECT_NEAR(found[0].box.height, 24, kBoxTolerance);
  EXPECT_TRUE(this->detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 0))).empty());
}

TYPED_TEST_P(DetectorContract, AnInputOfAnySizeMustBeTold) {
  const std::string error = error_of([&] { TypeParam(this->network("any_size")); });
  expect_contains(error, "any_size.onnx: the file does not say how large an input the network wants");
  typename TypeParam::Options options;
  options.input_size = {96, 64};
  TypeParam detector(this->network("any_size"), options);
  EXPECT_EQ(this->detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 255))).size(), 3u);
  options.input_size = {96, -1};
  expect_contains(error_of([&] { TypeParam(this->network("any_size"), options); }), "found the input size 96x-1");
}

TYPED_TEST_P(DetectorContract, BadImagesAreErrorsAndLeaveNothing) {
  TypeParam detector(this->network("channel_means"));
  std::vector<Detection> found(2);
  EXPECT_THROW(detector.detect(ImageView(), found), Error);
  EXPECT_TRUE(found.empty());
  EXPECT_THROW(detector.detect(cv::Mat(64, 96, CV_32FC1), found), Error);
}

TYPED_TEST_P(DetectorContract, CanBeMoved) {
  TypeParam first(this->network("channel_means"));
  TypeParam second = std::move(first);
  EXPECT_EQ(this->detect(second, cv::Mat(64, 96, CV_8UC3, cv::Scalar(255, 255, 255))).size(), 3u);
  second = TypeParam(this->network("duplicates"));
  EXPECT_EQ(this->said(second, this->detect(second, cv::Mat(64, 96, CV_8UC3))), "person 90; car 80; person 60; ");
}

TYPED_TEST_P(DetectorContract, WrongOptionsAreSaidAtConstruction) {
  expect_contains(error_of([&] { TypeParam(this->network("no_layout")); }),
                  "no_layout.onnx: outputs 1x1000 with an input of 96x64");
  typename TypeParam::Options options;
  options.layout = DetectorLayout::yolox;
  expect_contains(error_of([&] { TypeParam(this->network("channel_means"), options); }), "channel_means.onnx: ");
  options = {};
  options.outputs = {"nothing"};
  expect_contains(error_of([&] { TypeParam(this->network("channel_means"), options); }),
                  "found no output 'nothing', expected one of boxes");
}

TYPED_TEST_P(DetectorContract, WhatIsNoNetworkIsSaidAtConstruction) {
  expect_contains(error_of([&] { TypeParam("/no/such.onnx"); }), "/no/such.onnx: no such file");
  const TemporaryFolder folder;
  const fs::path broken = folder.write("broken.onnx", "this is no network");
  expect_contains(error_of([&] { TypeParam detector(folder.path()); }), "found a folder, expected a model");
  const std::string refused = error_of([&] { TypeParam detector(broken); });
  expect_contains(refused, broken.string() + ": O");  // OpenCV, ONNX Runtime
  expect_contains(refused, " cannot read this network");
  EXPECT_EQ(refused.find('\n'), refused.npos);
}

REGISTER_TYPED_TEST_SUITE_P(DetectorContract, ColourOrderAndScaleReachTheNetwork, BarsOfTheLetterboxReachTheNetwork,
                            GrayIsTaken, NothingFoundIsNoDetection, EqualImagesGiveEqualAnswers,
                            OfBoxesOfAClassThatOverlapTheBestIsLeft, ARedPatchIsFoundWhereItIs,
                            ALabelMapOfIntegersIsRead, HeadsNeedTheirFamilyAndAnchors, AnInputOfAnySizeMustBeTold,
                            BadImagesAreErrorsAndLeaveNothing, CanBeMoved, WrongOptionsAreSaidAtConstruction,
                            WhatIsNoNetworkIsSaidAtConstruction);

}  // namespace stillpoint
