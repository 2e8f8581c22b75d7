// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Published networks on photographs whose people are known. Both are no part of this project: skipped where they are
// not.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "stillpoint/detectors/opencv_dnn.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = STILLPOINT_SHARED_MODELS;

struct Corners {
  float left, top, right, bottom;
};

/// People as drawn by hand round what is seen of them.
struct Photograph {
  const char* file;
  std::vector<Corners> people;
};
const std::vector<Photograph>& photographs() {
  static const std::vector<Photograph> all = {{"astronaut.jpg", {{8, 15, 366, 510}}},
                                              {"camera.png", {{1, 64, 330, 511}}},
                                              {"two_people.jpg", {{10, 127, 203, 390}, {335, 98, 544, 390}}}};
  return all;
}

float overlap(const Box& box, const Corners& truth) {
  const float width = std::min(box.x + box.width, truth.right) - std::max(box.x, truth.left);
  const float height = std::min(box.y + box.height, truth.bottom) - std::max(box.y, truth.top);
  if (!(width > 0 && height > 0)) return 0;
  const float both = width * height;
  return both / (box.width * box.height + (truth.right - truth.left) * (truth.bottom - truth.top) - both);
}

/// What a network's authors' own way of running it gives for a person.
struct Reference {
  float score;
  Corners box;
};

struct Model {
  const char* name;
  const char* file;
  DetectorLayout layout;
  std::vector<Reference> people;  ///< in the order of the photographs; none: not boxes but masks
  OpenCvDetector::Options options = {};
};

std::vector<Model> models() {
  const std::vector<Reference> yolox = {{0.93f, {11, 20, 369, 507}},
                                        {0.93f, {5, 64, 301, 502}},
                                        {0.92f, {9, 130, 186, 389}},
                                        {0.90f, {336, 92, 545, 390}}};
  const std::vector<Reference> nanodet = {{0.66f, {16, 9, 360, 513}},
                                          {0.85f, {1, 63, 302, 511}},
                                          {0.50f, {15, 126, 195, 391}},
                                          {0.70f, {334, 97, 541, 391}}};
  const std::vector<Reference> yolo_fastest = {{0.84f, {19, 67, 364, 502}},
                                               {1.00f, {12, 43, 327, 504}},
                                               {0.99f, {30, 124, 192, 392}},
                                               {0.95f, {364, 81, 555, 412}}};
  const std::vector<Reference> yolov8 = {{0.84f, {5, 13, 361, 510}},
                                         {0.83f, {1, 62, 297, 513}},
                                         {0.94f, {10, 127, 189, 387}},
                                         {0.84f, {337, 98, 544, 386}}};
  Model ssd{"Ssd", "yolox_nano_detection_output.onnx", DetectorLayout::ssd, yolox};
  ssd.options.classes = ClassList::coco();
  ssd.options.preprocess = usual_preprocess(DetectorLayout::yolox);  // what it was before its output was rewritten
  return {{"YoloX", "yolox_nano.onnx", DetectorLayout::yolox, yolox},
          {"YoloXDecoded", "yolox_nano_decoded.onnx", DetectorLayout::yolox_decoded, yolox},
          ssd,
          {"NanoDet", "nanodet_m_320.onnx", DetectorLayout::nanodet, nanodet},
          {"DarknetWeights", "yolo-fastest-1.1.weights", DetectorLayout::darknet, yolo_fastest},
          {"DarknetCfg", "yolo-fastest-1.1.cfg", DetectorLayout::darknet, yolo_fastest},
          {"YoloV8", "yolov8n_640.onnx", DetectorLayout::yolov8, yolov8},
          {"Segmentation", "selfie_segmentation.onnx", DetectorLayout::segmentation, {}}};
}

bool is_person(const OpenCvDetector& detector, const Detection& detection) {
  return detector.classes()[static_cast<std::size_t>(detection.class_index)] == "person";
}

class KnownModels : public testing::TestWithParam<Model> {
 protected:
  void SetUp() override {
    if (!fs::exists(kModels / GetParam().file)) GTEST_SKIP() << "no published networks in " << kModels;
  }
};

TEST_P(KnownModels, FindTheKnownPeople) {
  constexpr float kLowestOverlap = 0.65f;        // with what was drawn by hand; the furthest of them has 0.73
  constexpr float kLowestConfidence = 0.4f;      // the least sure has 0.50
  constexpr float kConfidenceTolerance = 0.01f;  // the references are rounded to this
  constexpr float kPixelTolerance = 2.5f;  // they are rounded to pixels and cut nowhere; images are resized otherwise
  OpenCvDetector detector(kModels / GetParam().file, GetParam().options);
  EXPECT_EQ(to_string(detector.layout()), to_string(GetParam().layout));
  std::size_t index = 0;
  for (const Photograph& photograph : photographs()) {
    const bool gray = std::string(photograph.file) == "camera.png";
    const cv::Mat image =
        cv::imread((kModels / photograph.file).string(), gray ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
    ASSERT_FALSE(image.empty()) << photograph.file;
    std::vector<Detection> found;
    detector.detect(image, found);
    std::size_t large_people = 0;
    for (const Detection& detection : found)
      large_people += is_person(detector, detection) && detection.box.width * detection.box.height > 20000.0f;
    EXPECT_EQ(large_people, photograph.people.size()) << photograph.file;
    for (const Corners& person : photograph.people) {
      const auto best = std::max_element(found.begin(), found.end(), [&](const Detection& a, const Detection& b) {
        return overlap(a.box, person) < overlap(b.box, person);
      });
      ASSERT_NE(best, found.end()) << photograph.file;
      EXPECT_TRUE(is_person(detector, *best));
      EXPECT_EQ(best->mobility, Mobility::dynamic);
      EXPECT_GE(overlap(best->box, person), kLowestOverlap) << photograph.file;
      EXPECT_GE(best->confidence, kLowestConfidence) << photograph.file;
      if (GetParam().people.empty()) continue;
      const Reference& reference = GetParam().people[index++];
      EXPECT_NEAR(best->confidence, reference.score, kConfidenceTolerance);
      EXPECT_NEAR(best->box.x, reference.box.left, kPixelTolerance);
      EXPECT_NEAR(best->box.y, reference.box.top, kPixelTolerance);
      EXPECT_NEAR(best->box.x + best->box.width, reference.box.right, kPixelTolerance);
      EXPECT_NEAR(best->box.y + best->box.height, reference.box.bottom, kPixelTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Published, KnownModels, testing::ValuesIn(models()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(KnownModel, SegmentationCoversTheKnownShare) {
  if (!fs::exists(kModels / "selfie_segmentation.onnx")) GTEST_SKIP() << "no published networks in " << kModels;
  OpenCvDetector detector(kModels / "selfie_segmentation.onnx");
  // Shares of pixels over one half as ONNX Runtime has them; parts too small to be kept and resizing cost little.
  constexpr double kTolerance = 0.01;
  for (const auto& [file, share] : {std::pair{"astronaut.jpg", 0.545}, std::pair{"camera.png", 0.325}}) {
    const cv::Mat image = cv::imread((kModels / file).string());
    std::vector<Detection> found;
    detector.detect(image, found);
    int inside = 0;
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u)
        inside += std::any_of(found.begin(), found.end(), [&](const Detection& detection) {
          return detection.holds({static_cast<float>(u), static_cast<float>(v)}, 0);
        });
    EXPECT_NEAR(inside / static_cast<double>(image.total()), share, kTolerance) << file;
  }
}

TEST(KnownModel, WhatOpenCvRefusesIsNamed) {
  const fs::path file = kModels / "deimv2_atto_320_int8.onnx";
  if (!fs::exists(file)) GTEST_SKIP() << "no published networks in " << kModels;
  try {
    OpenCvDetector detector(file);
    GTEST_SKIP() << "this OpenCV can read what 4.6 refused";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find(file.string() + ": OpenCV"), 0u) << error.what();
  }
}

}  // namespace
}  // namespace stillpoint
