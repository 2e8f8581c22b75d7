// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/network_decoder.hpp"

#include <limits>
#include <string>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint {
namespace {

/// What is left when an image of the input's size is decoded.
std::vector<Detection> detections(const NetworkDecoder& decoder, const InputSize& input,
                                  const std::vector<Tensor>& outputs) {
  std::vector<RawDetection> raw;
  std::vector<Detection> found;
  decoder.decode(outputs, raw);
  decoder.finish(outputs, Letterbox(input, input, ImageFit::stretch), raw, found);
  return found;
}

std::string error_with(const DetectorOptions& options, const InputSize& input, const std::vector<Tensor>& outputs) {
  return error_of([&] { NetworkDecoder(options, input, outputs); });
}

TEST(NetworkDecoder, TheLibrarysListsAreFoundByTheirLength) {
  const auto classes = [](const MadeTensor& output, const InputSize& input) {
    return NetworkDecoder({}, input, views(output)).classes().size();
  };
  EXPECT_EQ(classes(MadeTensor({1, 84, 8400}), {640, 640}), 80u);
  EXPECT_EQ(classes(MadeTensor({1, 24, 8400}), {640, 640}), 20u);
  EXPECT_EQ(classes(MadeTensor({1, 8400, 84}), {640, 640}), 80u);
  EXPECT_EQ(classes(MadeTensor({1, 8400, 25}), {640, 640}), 20u);  // YOLOX; no YOLOv8 with VOC's background
  EXPECT_EQ(classes(MadeTensor({1, 21, 64, 64}), {513, 513}), 21u);
  EXPECT_EQ(classes(MadeTensor({1, 19, 64, 64}), {513, 513}), 19u);
  EXPECT_EQ(classes(MadeTensor({1, 1, 64, 64}), {64, 64}), 1u);
  const MadeTensor logits({1, 100, 92}), boxes({1, 100, 4});
  EXPECT_EQ(NetworkDecoder({}, {800, 800}, views(logits, boxes)).classes().size(), 91u);
}

TEST(NetworkDecoder, SharesAndProbabilitiesAreZeroToOne) {
  const MadeTensor output({1, 84, 8400});
  DetectorOptions options;
  options.lowest_confidence = 40;  // percent
  EXPECT_EQ(error_with(options, {640, 640}, views(output)), "lowest_confidence is 40, expected 0 to 1");
  options = {};
  options.highest_overlap = std::numeric_limits<float>::quiet_NaN();
  expect_contains(error_with(options, {640, 640}, views(output)), "highest_overlap is ");
  options = {};
  options.smallest_part = -0.1f;
  expect_contains(error_with(options, {640, 640}, views(output)), "smallest_part is -0.1");
}

TEST(NetworkDecoder, WhatTheShapesDoNotTellMustBeSet) {
  const MadeTensor ssd({1, 1, 100, 7}), odd({1, 8400, 47}), wrong({1, 84, 8400});
  expect_contains(error_with({}, {300, 300}, views(ssd)),
                  "outputs 1x1x100x7 are those of ssd, which do not tell the classes: set the class list");
  expect_contains(error_with({}, {640, 640}, views(odd)), "1x8400x47 with an input of 640x640 and the classes of COCO");
  DetectorOptions options;
  options.layout = DetectorLayout::yolov8;
  expect_contains(error_with(options, {640, 640}, views(odd)), "fit not yolov8; set the class list or another layout");
  options.classes = ClassList({"person", "car"});
  expect_contains(error_with(options, {640, 640}, views(wrong)), "layout yolov8: found outputs 1x84x8400, expected");
}

TEST(NetworkDecoder, ALayoutThatIsSetOverridesTheGuess) {
  MadeTensor output({1, 84, 84});
  DetectorOptions options;
  expect_contains(error_with(options, {64, 64}, views(output)), "set one of yolov8, yolov8-transposed");
  options.layout = DetectorLayout::yolov8_transposed;
  output.write({0, 7, 0}, {30, 20, 20, 10, 0, 0, 0.9f});
  const NetworkDecoder decoder(options, {64, 64}, views(output));
  EXPECT_EQ(decoder.layout(), DetectorLayout::yolov8_transposed);
  const auto found = detections(decoder, {64, 64}, views(output));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].class_index, 2);
  EXPECT_EQ(found[0].mobility, Mobility::dynamic);
  EXPECT_NEAR(found[0].box.x, 19.5f, kPixelTolerance);
  EXPECT_NEAR(found[0].box.width, 20, kPixelTolerance);
}

TEST(NetworkDecoder, SsdCountsFromABackground) {
  MadeTensor output({1, 1, 3, 7});
  output.write({0, 0, 0, 0}, {0, 1, 0.9f, 0, 0, 0.5f, 0.5f});
  output.write({0, 0, 1, 0}, {0, 0, 0.8f, 0, 0, 0.5f, 0.5f});  // the background itself
  output.write({0, 0, 2, 0}, {0, 95, 0.7f, 0, 0, 0.5f, 0.5f});
  DetectorOptions options;
  for (const ClassList& list : {ClassList::coco(), ClassList::coco91()}) {
    options.classes = list;
    const NetworkDecoder decoder(options, {300, 300}, views(output));
    const auto found = detections(decoder, {300, 300}, views(output));
    ASSERT_EQ(found.size(), 1u) << list.size();
    EXPECT_EQ(list[static_cast<std::size_t>(found[0].class_index)], "person");
  }
  options.classes = ClassList::coco();
  options.first_class_number = 0;
  const NetworkDecoder decoder(options, {300, 300}, views(output));
  const auto found = detections(decoder, {300, 300}, views(output));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].class_index, 1);
}

TEST(NetworkDecoder, MaskRcnnOfOpenCvCountsFromTheFirstClass) {
  MadeTensor boxes({1, 1, 1, 7}), masks({1, 90, 15, 15});
  boxes.write({0, 0, 0, 0}, {0, 0, 0.9f, 0.25f, 0.25f, 0.75f, 0.75f});
  for (int v = 0; v < 15; ++v)
    for (int u = 0; u < 15; ++u) masks.at({0, 0, v, u}) = v < 7 ? 1.0f : 0.0f;
  const NetworkDecoder decoder({}, {400, 400}, views(boxes, masks));
  EXPECT_EQ(decoder.layout(), DetectorLayout::mask_rcnn);
  const auto found = detections(decoder, {400, 400}, views(boxes, masks));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(decoder.classes()[static_cast<std::size_t>(found[0].class_index)], "person");
  ASSERT_TRUE(found[0].mask);
  EXPECT_TRUE(found[0].holds({200, 110}, 0));
  EXPECT_FALSE(found[0].holds({200, 290}, 0));
  EXPECT_FALSE(found[0].holds({50, 110}, 0));
}

TEST(NetworkDecoder, YoloMasksAreMadeForBoxesCutAtTheBorder) {
  MadeTensor boxes({1, 84 + 2, 126}), prototypes({1, 2, 16, 24}, 1.0f);
  const int column = 9;
  for (const auto& [field, value] : {std::pair{0, 0.0f}, {1, 32.0f}, {2, 40.0f}, {3, 40.0f}, {4, 0.9f}, {84, 1.0f}})
    boxes.at({0, field, column}) = value;
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 24; ++u) prototypes.at({0, 0, v, u}) = u < 3 ? 1.0f : -1.0f;  // inside left of 12 pixels
  const NetworkDecoder decoder({}, {96, 64}, views(prototypes, boxes));
  EXPECT_EQ(decoder.layout(), DetectorLayout::yolov8_segmentation);
  const auto found = detections(decoder, {96, 64}, views(prototypes, boxes));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].box.x, -0.5f, kPixelTolerance);
  EXPECT_NEAR(found[0].box.width, 20, kPixelTolerance);
  EXPECT_TRUE(found[0].holds({11, 32}, 0));
  EXPECT_FALSE(found[0].holds({12, 32}, 0));
}

TEST(NetworkDecoder, DeepLabsBackgroundIsNoDetection) {
  MadeTensor output({1, 21, 16, 16});
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 16; ++u) output.at({0, u < 8 ? 15 : 0, v, u}) = 20;
  for (const bool list_is_set : {false, true}) {
    DetectorOptions options;
    if (list_is_set) options.classes = ClassList::voc();
    const NetworkDecoder decoder(options, {64, 64}, views(output));
    const auto found = detections(decoder, {64, 64}, views(output));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(decoder.classes()[static_cast<std::size_t>(found[0].class_index)], "person");
    EXPECT_NEAR(found[0].box.width, 32, kPixelTolerance);
  }
}

TEST(NetworkDecoder, OneClassIsTheFirstBehindTheBackground) {
  const MadeTensor two({1, 2, 16, 16}, 0.9f), one({1, 1, 16, 16}, 0.9f);
  for (const ClassList& list : {ClassList({"background", "person"}), ClassList({"person"})}) {
    DetectorOptions options;
    options.classes = list;
    for (const MadeTensor& output : {two, one}) {
      const NetworkDecoder decoder(options, {64, 64}, views(output));
      const auto found = detections(decoder, {64, 64}, views(output));
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(decoder.classes()[static_cast<std::size_t>(found[0].class_index)], "person");
    }
  }
}

TEST(NetworkDecoder, DetectionsComeByConfidence) {
  MadeTensor output({1, 84, 8400});
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 4; ++k) output.at({0, k, i}) = static_cast<float>(100 + 50 * i);
    output.at({0, 4 + i, i}) = 0.5f + 0.1f * static_cast<float>((i * 3) % 5);
  }
  const NetworkDecoder decoder({}, {640, 640}, views(output));
  const auto found = detections(decoder, {640, 640}, views(output));
  ASSERT_EQ(found.size(), 5u);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i - 1].confidence, found[i].confidence);
}

TEST(NetworkDecoder, AUsersTableOfMobilityCounts) {
  MadeTensor output({1, 6, 8400});
  output.at({0, 4, 3}) = 0.9f;
  for (int k = 0; k < 4; ++k) output.at({0, k, 3}) = 100;
  DetectorOptions options;
  options.classes = ClassList({"robot", "shelf"});
  options.mobility.set("robot", Mobility::dynamic);
  const NetworkDecoder decoder(options, {640, 640}, views(output));
  const auto found = detections(decoder, {640, 640}, views(output));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].mobility, Mobility::dynamic);
}

}  // namespace
}  // namespace stillpoint
