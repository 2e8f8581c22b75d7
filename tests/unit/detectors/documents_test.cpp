// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The code of docs/detectors.md at work. That each of its blocks compiles is tested by tests/documents.

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

// clang-format off
#include <stillpoint/detectors/opencv_dnn.hpp>
#include <stillpoint/stillpoint.hpp>
#ifdef STILLPOINT_TEST_ONNXRUNTIME
#include <stillpoint/detectors/onnxruntime.hpp>
#endif
// clang-format on

#include "unit/temporary_folder.hpp"

namespace {

TEST(Documents, ADetectorBeforeTheFilter) {
  const std::filesystem::path model = std::filesystem::path(STILLPOINT_TEST_NETWORKS) / "channel_means.onnx";
  if (!std::filesystem::exists(model)) GTEST_SKIP() << "no made networks: Python had no module onnx";
  const stillpoint::Camera camera(80, 80, 47.5, 31.5, 96, 64);
  const cv::Mat bgr(64, 96, CV_8UC3, cv::Scalar(0, 0, 255)), depth(64, 96, CV_16UC1, cv::Scalar(10000));
  const std::vector<cv::KeyPoint> keypoints;
  const double time = 1.0;
  // clang-format off
stillpoint::OpenCvDetector::Options options;
options.lowest_confidence = 0.5f;
options.mobility.set("chair", stillpoint::Mobility::dynamic);   // on wheels here
stillpoint::OpenCvDetector detector(model, options);            // .onnx, .weights, .pb, .caffemodel

stillpoint::FrameFilter<> filter(camera);
detector.detect(bgr, filter.prior.detections);
const auto& result = filter.filter_frame({bgr, stillpoint::DepthView::millimetres(depth), time}, keypoints);
  // clang-format on
  EXPECT_EQ(result.status(), stillpoint::Status::first_frame);
  ASSERT_EQ(filter.prior.detections.size(), 1u);
  EXPECT_EQ(filter.prior.detections[0].mobility, stillpoint::Mobility::dynamic);
}

#ifdef STILLPOINT_TEST_ONNXRUNTIME
TEST(Documents, ADetectorOnOnnxRuntime) {
  const std::filesystem::path model = std::filesystem::path(STILLPOINT_TEST_NETWORKS) / "channel_means.onnx";
  if (!std::filesystem::exists(model)) GTEST_SKIP() << "no made networks: Python had no module onnx";
  // clang-format off
stillpoint::OnnxRuntimeDetector::Options options;
options.intra_op_threads = 2;
stillpoint::OnnxRuntimeDetector detector(model, options);       // .onnx
  // clang-format on
  std::vector<stillpoint::Detection> found;
  detector.detect(cv::Mat(64, 96, CV_8UC3, cv::Scalar(0, 0, 255)), found);
  EXPECT_EQ(found.size(), 1u);
}
#endif

TEST(Documents, OptionsOfNetworksThatAreNotAsUsual) {
  const stillpoint::TemporaryFolder folder;
  const std::string names_file = folder.write("my.names", "person\nrobot\n").string();
  stillpoint::DetectorOptions tiny, ssd;
  // clang-format off
tiny.layout = stillpoint::DetectorLayout::yolov3;
tiny.coding = stillpoint::yolo_coding(tiny.layout);
tiny.coding->anchors = {{10, 14}, {23, 27}, {37, 58}, {81, 82}, {135, 169}, {344, 319}};
tiny.classes = stillpoint::ClassList::named(names_file);
ssd.classes = stillpoint::ClassList::voc21();
ssd.preprocess = stillpoint::Preprocess{stillpoint::ImageFit::stretch, false, {127.5f, 127.5f, 127.5f},
                                        {0.007843f, 0.007843f, 0.007843f}};
  // clang-format on
  EXPECT_FALSE(tiny.coding->squared);
  EXPECT_EQ(tiny.classes.size(), 2u);
  EXPECT_FLOAT_EQ(ssd.preprocess->mean[0], 127.5f);
}

}  // namespace
