// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/opencv_dnn.hpp"

#include <gtest/gtest.h>

#include <string>

#include "unit/detectors/detector_contract.hpp"

namespace stillpoint {

INSTANTIATE_TYPED_TEST_SUITE_P(OpenCv, DetectorContract, OpenCvDetector);

namespace {

class OpenCvDetectorTest : public DetectorContract<OpenCvDetector> {};

TEST_F(OpenCvDetectorTest, WhatOpenCvCannotReadIsSaidAtConstruction) {
  const std::string refused = error_of([] { OpenCvDetector(network("cannot_read")); });
  expect_contains(refused, "cannot_read.onnx: OpenCV " CV_VERSION " cannot read this network");
  EXPECT_EQ(refused.find('\n'), refused.npos);
}

TEST_F(OpenCvDetectorTest, AFirstRunThatFailsIsSaidAtConstruction) {
  // OpenCV 4.6 reads this network, and throws when it shall run it; a later one may do both.
  const std::string error = error_of([] { OpenCvDetector(network("cannot_run")); });
  if (error.find("cannot run this network") == error.npos) expect_contains(error, "fit no layout");
  expect_contains(error, "cannot_run.onnx: ");
}

TEST_F(OpenCvDetectorTest, ABackendThatIsNotThereIsSaidAtConstruction) {
  OpenCvDetector::Options options;
  options.backend = cv::dnn::DNN_BACKEND_VKCOM;
  options.target = cv::dnn::DNN_TARGET_MYRIAD;
  expect_contains(error_of([&] { OpenCvDetector(network("channel_means"), options); }), "was built without backend");
}

}  // namespace
}  // namespace stillpoint
