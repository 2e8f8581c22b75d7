// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/opencv_dnn.hpp"

#include <gtest/gtest.h>

#include <string>

#include "unit/detectors/detector_contract.hpp"
#include "unit/temporary_folder.hpp"

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

TEST(OpenCvDetectorOutputs, AShapeThatIsNotTakenIsSaidWithTheFile) {
  const TemporaryFolder folder;
  folder.write("net.prototxt",  // Caffe's, without weights: the image in another shape
               "input: 'image' input_shape { dim: 1 dim: 3 dim: 64 dim: 96 } layer { name: 'other' type: 'Reshape' "
               "bottom: 'image' top: 'other' "
               "reshape_param { shape { dim: 1 dim: 1 dim: 1 dim: 1 dim: 3 dim: 64 dim: 96 } } }");
  const auto model = folder.write("net.caffemodel", "");
  OpenCvDetector::Options options;
  options.input_size = {96, 64};
  EXPECT_EQ(error_of([&] { OpenCvDetector(model, options); }),
            model.string() + ": an output of the network has 7 dimensions, expected at most 6");
}

}  // namespace
}  // namespace stillpoint
