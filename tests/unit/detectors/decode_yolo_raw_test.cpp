// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_yolo_raw.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_yolo_raw_test {
namespace {

// Input 64x32, strides 8 and 16: heads of 8x4 and 4x2 cells. Two classes: 7 fields a box.
const DecodeSettings kSettings{{64, 32}, 2, 0.4f};
constexpr float kNever = -30.0f;      // its sigmoid is 1e-13
constexpr float kLogit = 1.0986123f;  // ln 3: its sigmoid is 0.75

YoloCoding two_heads(DetectorLayout family) {
  YoloCoding coding = yolo_coding(family);
  coding.anchors = {{4, 6}, {8, 10}, {12, 14}, {16, 18}, {20, 22}, {24, 26}};
  return coding;
}

struct Heads {
  MadeTensor stride8{{1, 3, 4, 8, 7}, kNever}, stride16{{1, 3, 2, 4, 7}, kNever};
  Heads() {
    // Second anchor of stride 8, row 2, column 5: t = (ln 3, 0, 0, ln 3), objectness 0.75, class 1 surely.
    stride8.write({0, 1, 2, 5, 0}, {kLogit, 0, 0, kLogit, kLogit, kNever, 30});
    // Third anchor of stride 16, row 1, column 3: t = 0 all, objectness 0.75, class 0 surely.
    stride16.write({0, 2, 1, 3, 0}, {0, 0, 0, 0, kLogit, 30, kNever});
  }
};

TEST(DecodeYoloRaw, Version5SquaresSizesAndWidensMiddles) {
  const Heads heads;
  std::vector<RawDetection> found;
  decode_yolo_raw(views(heads.stride16, heads.stride8), kSettings, two_heads(DetectorLayout::yolov5), found);
  ASSERT_EQ(found.size(), 2u);
  // x = (2·0.75 - 0.5 + 5)·8 = 48, y = (2·0.5 - 0.5 + 2)·8 = 20; w = (2·0.5)²·8 = 8, h = (2·0.75)²·10 = 22.5.
  expect_box(found[0], 44, 20 - 11.25f, 52, 20 + 11.25f);
  EXPECT_NEAR(found[0].score, 0.75f, 1e-5f);
  EXPECT_EQ(found[0].label, 1);
  // x = (2·0.5 - 0.5 + 3)·16 = 56, y = (0.5 + 1)·16 = 24; w = 24, h = 26.
  expect_box(found[1], 56 - 12, 24 - 13, 56 + 12, 24 + 13);
  EXPECT_EQ(found[1].label, 0);
}

TEST(DecodeYoloRaw, Version3TakesExponentials) {
  const Heads heads;
  std::vector<RawDetection> found;
  decode_yolo_raw(views(heads.stride8, heads.stride16), kSettings, two_heads(DetectorLayout::yolov3), found);
  ASSERT_EQ(found.size(), 2u);
  // x = (0.75 + 5)·8 = 46, y = (0.5 + 2)·8 = 20; w = e^0·8 = 8, h = e^(ln 3)·10 = 30.
  expect_box(found[0], 42, 5, 50, 35);
}

TEST(DecodeYoloRaw, Version4WidensMiddlesByHead) {
  Heads heads;
  heads.stride16.write({0, 2, 1, 3, 0}, {kLogit});
  std::vector<RawDetection> found;
  decode_yolo_raw(views(heads.stride8, heads.stride16), kSettings, two_heads(DetectorLayout::yolov4), found);
  ASSERT_EQ(found.size(), 2u);
  // Stride 8 has 1.2: x = (1.2·0.75 - 0.1 + 5)·8 = 46.4.
  expect_box(found[0], 42.4f, 5, 50.4f, 35);
  // Stride 16 has 1.1: x = (1.1·0.75 - 0.05 + 3)·16 = 60.4, y = (1.1·0.5 - 0.05 + 1)·16 = 24; w = 24, h = 26.
  expect_box(found[1], 60.4f - 12, 24 - 13, 60.4f + 12, 24 + 13);
}

TEST(DecodeYoloRaw, FieldsMayBeChannelsBeforeTheCells) {
  const Heads heads;
  MadeTensor stride8({1, 21, 4, 8}), stride16({1, 21, 2, 4});
  const auto permute = [](MadeTensor from, MadeTensor& to) {
    for (int a = 0; a < 3; ++a)
      for (int v = 0; v < from.shape[2]; ++v)
        for (int u = 0; u < from.shape[3]; ++u)
          for (int k = 0; k < 7; ++k) to.at({0, a * 7 + k, v, u}) = from.at({0, a, v, u, k});
  };
  permute(heads.stride8, stride8);
  permute(heads.stride16, stride16);
  std::vector<RawDetection> expected, found;
  decode_yolo_raw(views(heads.stride8, heads.stride16), kSettings, two_heads(DetectorLayout::yolov5), expected);
  decode_yolo_raw(views(stride8, stride16), kSettings, two_heads(DetectorLayout::yolov5), found);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    expect_box(found[i], expected[i].left, expected[i].top, expected[i].right, expected[i].bottom);
}

TEST(DecodeYoloRaw, ScoreIsObjectnessTimesClassAndNanIsNothing) {
  Heads heads;
  heads.stride8.write({0, 1, 2, 5, 5}, {kNever, 0});  // 0.75 · 0.5 = 0.375 < 0.4
  heads.stride16.write({0, 2, 1, 3, 4}, {std::numeric_limits<float>::quiet_NaN()});
  std::vector<RawDetection> found;
  decode_yolo_raw(views(heads.stride8, heads.stride16), kSettings, two_heads(DetectorLayout::yolov5), found);
  EXPECT_TRUE(found.empty());
}

TEST(DecodeYoloRaw, RefusesOtherShapesAndTheWrongNumberOfAnchors) {
  const Heads heads;
  std::vector<RawDetection> found;
  const auto decode = [&](const std::vector<Tensor>& outputs, const YoloCoding& coding) {
    return error_of([&] { decode_yolo_raw(outputs, kSettings, coding, found); });
  };
  expect_contains(decode(views(heads.stride8, heads.stride16), yolo_coding(DetectorLayout::yolov5)),
                  "anchors: found 9, expected 6 for outputs 1x3x4x8x7, 1x3x2x4x7");
  expect_contains(decode(views(MadeTensor({1, 20, 4, 8})), two_heads(DetectorLayout::yolov5)),
                  "found outputs 1x20x4x8");
  expect_contains(decode(views(MadeTensor({1, 100, 7})), two_heads(DetectorLayout::yolov5)), "found outputs 1x100x7");
}

TEST(YoloCoding, EachFamilyHasItsAnchors) {
  // Width and height of the nine, as the configuration files of YOLOv3 and YOLOv4 list them.
  using Sizes = std::vector<std::pair<float, float>>;
  const Sizes version3 = {{10, 13},  {16, 30},  {33, 23},   {30, 61},  {62, 45},
                          {59, 119}, {116, 90}, {156, 198}, {373, 326}};
  const Sizes version4 = {{12, 16},  {19, 36},   {40, 28},   {36, 75},  {76, 55},
                          {72, 146}, {142, 110}, {192, 243}, {459, 401}};
  const auto sizes = [](DetectorLayout family) {
    Sizes found;
    for (const Anchor& anchor : yolo_coding(family).anchors) found.emplace_back(anchor.width, anchor.height);
    return found;
  };
  EXPECT_EQ(sizes(DetectorLayout::yolov3), version3);
  EXPECT_EQ(sizes(DetectorLayout::yolov5), version3);
  EXPECT_EQ(sizes(DetectorLayout::yolov4), version4);
  EXPECT_EQ(sizes(DetectorLayout::yolov7), version4);
  for (const DetectorLayout squared : {DetectorLayout::yolov5, DetectorLayout::yolov7})
    EXPECT_TRUE(yolo_coding(squared).squared);
  for (const DetectorLayout exponential : {DetectorLayout::yolov3, DetectorLayout::yolov4})
    EXPECT_FALSE(yolo_coding(exponential).squared);
}

}  // namespace
}  // namespace stillpoint::decode_yolo_raw_test
