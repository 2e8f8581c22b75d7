// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/onnxruntime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/detectors/opencv_dnn.hpp"
#include "unit/detectors/detector_contract.hpp"

namespace stillpoint {

INSTANTIATE_TYPED_TEST_SUITE_P(OnnxRuntime, DetectorContract, OnnxRuntimeDetector);

namespace {

const cv::Scalar kWhite(255, 255, 255), kBlack(0, 0, 0);

class OnnxRuntimeDetectorTest : public DetectorContract<OnnxRuntimeDetector> {};

TEST_F(OnnxRuntimeDetectorTest, IntegersAreRecognisedAsLabels) {
  OnnxRuntimeDetector::Options options;
  options.classes = ClassList::voc21();
  cv::Mat image(64, 96, CV_8UC3, cv::Scalar(255, 255, 0));
  image(cv::Rect(40, 10, 30, 40)).setTo(cv::Scalar(0, 0, 255));
  for (const char* name : {"label_map", "label_map_int32"}) {
    OnnxRuntimeDetector detector(network(name), options);
    EXPECT_EQ(detector.layout(), DetectorLayout::label_map);
    const auto found = detect(detector, image);
    EXPECT_EQ(said(detector, found), "person 100; ") << name;
    EXPECT_NEAR(found[0].box.x, 39.5f, kBoxTolerance);
  }
}

TEST_F(OnnxRuntimeDetectorTest, TheSizeIsToldToANetworkThatAsksForIt) {
  OnnxRuntimeDetector::Options options;
  options.classes = ClassList::coco();
  OnnxRuntimeDetector detector(network("labelled_boxes"), options);
  EXPECT_EQ(detector.layout(), DetectorLayout::labelled_boxes);
  // Red 204, green 153, blue 51: the scores are 0.8, 0.6, 0.2.
  const auto found = detect(detector, cv::Mat(128, 192, CV_8UC3, cv::Scalar(51, 153, 204)));
  EXPECT_EQ(said(detector, found), "person 80; car 60; ");
  // Shares 0.25 to 0.5 of the width, 0.5 to 1 of the height: of 192 and 128.
  EXPECT_NEAR(found[0].box.x, 47.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.y, 63.5f, kBoxTolerance);
  EXPECT_NEAR(found[0].box.width, 48, kBoxTolerance);
  EXPECT_NEAR(found[0].box.height, 64, kBoxTolerance);
}

TEST_F(OnnxRuntimeDetectorTest, ANetworkMayAnswerWithAsManyBoxesAsItFinds) {
  OnnxRuntimeDetector::Options options;
  options.classes = ClassList::coco();
  OnnxRuntimeDetector detector(network("as_many_as_found"), options);  // none in the first run
  EXPECT_EQ(detector.layout(), DetectorLayout::end2end);
  EXPECT_EQ(said(detector, detect(detector, cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 255, 255)))),
            "person 90; bicycle 80; ");
  EXPECT_TRUE(detect(detector, cv::Mat(64, 96, CV_8UC3, kBlack)).empty());
  EXPECT_EQ(detect(detector, cv::Mat(64, 96, CV_8UC3, kWhite)).size(), 3u);
}

TEST_F(OnnxRuntimeDetectorTest, AFreeBatchIsABatchOfOne) {
  OnnxRuntimeDetector detector(network("any_batch"));
  EXPECT_EQ(detector.input_size().width, 96);
  EXPECT_EQ(detect(detector, cv::Mat(64, 96, CV_8UC3, kWhite)).size(), 3u);
}

TEST_F(OnnxRuntimeDetectorTest, OtherInputsAndOutputsAreRefused) {
  expect_contains(error_of([] { OnnxRuntimeDetector(network("second_image")); }),
                  "second_image.onnx: found the input 'mask' (float 1x?x64x96), expected an image (float 1x3xHxW) and");
  expect_contains(error_of([] { OnnxRuntimeDetector(network("label_map_float16")); }),
                  "label_map_float16.onnx: found the output 'labels' of float16, expected float, int32 or int64");
}

TEST_F(OnnxRuntimeDetectorTest, AnInputSizeThatTheNetworkDoesNotTakeIsSaidAtConstruction) {
  OnnxRuntimeDetector::Options options;
  options.input_size = {64, 64};
  const std::string error = error_of([&] { OnnxRuntimeDetector(network("channel_means"), options); });
  expect_contains(error, "channel_means.onnx: ONNX Runtime 1.");
  expect_contains(error, " cannot run this network: ");
  EXPECT_EQ(error.find('\n'), error.npos);
}

TEST_F(OnnxRuntimeDetectorTest, AnyNumberOfThreadsGivesTheSameAnswer) {
  OnnxRuntimeDetector::Options options;
  cv::Mat image(64, 96, CV_8UC3, cv::Scalar(180, 170, 160));
  OnnxRuntimeDetector alone(network("channel_means"), options);
  const std::string expected = said(alone, detect(alone, image));
  for (const int threads : {0, 2}) {
    options.intra_op_threads = options.inter_op_threads = threads;
    OnnxRuntimeDetector detector(network("channel_means"), options);
    EXPECT_EQ(said(detector, detect(detector, image)), expected);
  }
  options.inter_op_threads = -1;
  expect_contains(error_of([&] { OnnxRuntimeDetector(network("channel_means"), options); }),
                  "channel_means.onnx: found -1 threads, expected 0");
}

TEST_F(OnnxRuntimeDetectorTest, RunsWhatOpenCvCannotReadOrRun) {
  // Their outputs are of no layout: what is said of them shows that they were run.
  expect_contains(error_of([] { OnnxRuntimeDetector(network("cannot_read")); }), "outputs 1x3x64x3 ");
  expect_contains(error_of([] { OnnxRuntimeDetector(network("cannot_run")); }), "outputs 1x4x126 ");
}

TEST_F(OnnxRuntimeDetectorTest, SeveralLiveBesideEachOther) {
  OnnxRuntimeDetector first(network("channel_means"));
  const cv::Mat image(64, 96, CV_8UC3, kWhite);
  {
    OnnxRuntimeDetector second(network("duplicates"));
    EXPECT_EQ(detect(second, image).size(), 3u);
    EXPECT_EQ(detect(first, image).size(), 3u);
  }
  EXPECT_EQ(detect(first, image).size(), 3u);
}

/// Published networks on photographs, beside OpenCV's dnn; no part of this project.
class PublishedOnnxNetworks : public testing::TestWithParam<const char*> {
 protected:
  static fs::path file(const std::string& name) { return fs::path(STILLPOINT_SHARED_MODELS) / name; }
  void SetUp() override {
    if (!fs::exists(file(GetParam()))) GTEST_SKIP() << "no published networks in " << file("");
  }
};

TEST_P(PublishedOnnxNetworks, GiveTheSameAsWithOpenCv) {
  constexpr float kBoxDifference = 0.5f, kConfidenceDifference = 0.005f;  // sums in another order
  OnnxRuntimeDetector detector(file(GetParam()));
  OpenCvDetector reference(file(GetParam()));
  EXPECT_EQ(to_string(detector.layout()), to_string(reference.layout()));
  for (const char* photograph : {"astronaut.jpg", "camera.png", "two_people.jpg"}) {
    const cv::Mat image = cv::imread(file(photograph).string());
    ASSERT_FALSE(image.empty()) << photograph;
    std::vector<Detection> found, expected;
    detector.detect(image, found);
    reference.detect(image, expected);
    ASSERT_EQ(found.size(), expected.size()) << photograph;
    ASSERT_FALSE(found.empty()) << photograph;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].class_index, expected[i].class_index);
      EXPECT_NEAR(found[i].confidence, expected[i].confidence, kConfidenceDifference);
      EXPECT_NEAR(found[i].box.x, expected[i].box.x, kBoxDifference);
      EXPECT_NEAR(found[i].box.y, expected[i].box.y, kBoxDifference);
      EXPECT_NEAR(found[i].box.width, expected[i].box.width, kBoxDifference);
      EXPECT_NEAR(found[i].box.height, expected[i].box.height, kBoxDifference);
      EXPECT_EQ(found[i].mask != nullptr, expected[i].mask != nullptr);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Published, PublishedOnnxNetworks,
                         testing::Values("yolox_nano.onnx", "yolox_nano_decoded.onnx", "nanodet_m_320.onnx",
                                         "yolov8n_640.onnx", "selfie_segmentation.onnx"),
                         [](const auto& parameter) {
                           const std::string name = parameter.param;
                           return name.substr(0, name.find('.'));
                         });

TEST(PublishedOnnxNetwork, DetrRunsThatOpenCvRefuses) {
  const fs::path folder = STILLPOINT_SHARED_MODELS, file = folder / "deimv2_atto_320_int8.onnx";
  if (!fs::exists(file)) GTEST_SKIP() << "no published networks in " << folder;
  OnnxRuntimeDetector::Options options;
  options.preprocess = usual_preprocess(DetectorLayout::detr);
  options.preprocess->fit = ImageFit::letterbox_centred;
  options.preprocess->padding = 0;
  OnnxRuntimeDetector detector(file, options);
  EXPECT_EQ(detector.layout(), DetectorLayout::detr);
  // A weak network: of the four people of the photographs it finds one, with 0.48 (its own authors' way of running it).
  for (const auto& [photograph, people] :
       {std::pair{"astronaut.jpg", 0}, std::pair{"camera.png", 0}, std::pair{"two_people.jpg", 1}}) {
    std::vector<Detection> found;
    detector.detect(cv::imread((folder / photograph).string()), found);
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const Detection& detection) {
                                 return detector.classes()[static_cast<std::size_t>(detection.class_index)] != "person";
                               }),
                found.end());
    ASSERT_EQ(found.size(), static_cast<std::size_t>(people)) << photograph;
    if (people == 0) continue;
    EXPECT_NEAR(found[0].confidence, 0.48f, 0.02f);  // the reference is rounded
    const Box& box = found[0].box;
    const RawDetection drawn_by_hand = {10, 127, 203, 390};  // the left of the two
    EXPECT_GE(box_overlap({box.x, box.y, box.x + box.width, box.y + box.height}, drawn_by_hand), 0.65f);
  }
}

TEST(PublishedOnnxNetwork, WhatOnnxRuntimeRefusesIsNamed) {
  const fs::path file = fs::path(STILLPOINT_SHARED_MODELS) / "yolox_nano_detection_output.onnx";
  if (!fs::exists(file)) GTEST_SKIP() << "no published networks";
  const std::string error = error_of([&] { OnnxRuntimeDetector detector(file); });
  expect_contains(error, file.string() + ": ONNX Runtime 1.");
  expect_contains(error, "cannot read this network: ");
  expect_contains(error, "DetectionOutput");  // an operation that only OpenCV knows
}

}  // namespace
}  // namespace stillpoint
