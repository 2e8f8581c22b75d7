// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_yolov8.hpp"

#include "stillpoint/detectors/yolo_masks.hpp"
#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_yolov8_test {
namespace {

const DecodeSettings kSettings{{64, 32}, 3, 0.4f};

/// Writes a box into a column of 1xfieldsxN, or a row of 1xNxfields.
void put(MadeTensor& output, bool transposed, int box, std::initializer_list<float> fields) {
  int k = 0;
  for (const float value : fields) {
    (transposed ? output.at({0, box, k}) : output.at({0, k, box})) = value;
    ++k;
  }
}

TEST(DecodeYoloV8, ColumnsOrRowsWithoutAnObjectness) {
  for (const bool transposed : {false, true}) {
    MadeTensor output(transposed ? TensorShape{1, 42, 7} : TensorShape{1, 7, 42});
    put(output, transposed, 41, {30, 16, 20, 8, 0.1f, 0.2f, 0.9f});
    put(output, transposed, 0, {30, 16, 20, 8, 0.39f, 0.2f, 0.3f});
    put(output, transposed, 1, {30, 16, 20, 8, NAN, NAN, NAN});
    std::vector<RawDetection> found;
    decode_yolov8(output.view(), kSettings, 0, transposed, found);
    ASSERT_EQ(found.size(), 1u) << transposed;
    expect_box(found[0], 20, 12, 40, 20);
    EXPECT_EQ(found[0].label, 2);
    EXPECT_NEAR(found[0].score, 0.9f, 1e-6f);
    EXPECT_EQ(found[0].source, 41);
    EXPECT_THROW(decode_yolov8(output.view(), kSettings, 0, !transposed, found), Error);
  }
}

TEST(YoloMasks, MixturesOfPrototypesDecideByTheirSign) {
  // Prototypes of a quarter of the input, 16x8: the first is +1 left of column 8 and -1 from there on, the second +1.
  MadeTensor prototypes({1, 2, 8, 16});
  for (int v = 0; v < 8; ++v)
    for (int u = 0; u < 16; ++u) {
      prototypes.at({0, 0, v, u}) = u < 8 ? 1.0f : -1.0f;
      prototypes.at({0, 1, v, u}) = 1.0f;
    }
  for (const bool columns : {true, false}) {
    MadeTensor boxes(columns ? TensorShape{1, 9, 42} : TensorShape{1, 42, 9});
    // 24 to 40, 8 to 24: four columns and four rows of prototypes, halved by the boundary at 8·4 = 32 pixels.
    put(boxes, !columns, 5, {32, 16, 16, 16, 1, 0, 0, /*mixture*/ 1, 0});
    put(boxes, !columns, 6, {32, 16, 16, 16, 1, 0, 0, -1, 0});
    put(boxes, !columns, 7, {32, 16, 16, 16, 1, 0, 0, 1, 1.5f});
    std::vector<RawDetection> found;
    decode_yolov8(boxes.view(), kSettings, 2, !columns, found);
    ASSERT_EQ(found.size(), 3u);
    attach_yolo_masks(boxes.view(), prototypes.view(), {7, columns}, kSettings.input, found);
    for (const RawDetection& box : found) {
      ASSERT_TRUE(box.mask);
      EXPECT_EQ(box.mask->columns, 4);
      EXPECT_EQ(box.mask->rows, 4);
    }
    EXPECT_TRUE(found[0].mask->at(0.4f, 0.5f));
    EXPECT_FALSE(found[0].mask->at(0.6f, 0.5f));
    EXPECT_FALSE(found[1].mask->at(0.4f, 0.5f));
    EXPECT_TRUE(found[1].mask->at(0.6f, 0.5f));
    EXPECT_TRUE(found[2].mask->at(0.4f, 0.5f));  // 1 + 1.5 and -1 + 1.5
    EXPECT_TRUE(found[2].mask->at(0.6f, 0.5f));
  }
}

TEST(YoloMasks, OutsideThePictureIsNothing) {
  const MadeTensor prototypes({1, 1, 8, 16}, 1.0f);
  MadeTensor boxes({1, 8, 42});
  put(boxes, false, 0, {0, 16, 40, 64, 1, 0, 0, 1});  // from -20 to 20, -16 to 48
  std::vector<RawDetection> found;
  decode_yolov8(boxes.view(), kSettings, 1, false, found);
  attach_yolo_masks(boxes.view(), prototypes.view(), {7, true}, kSettings.input, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].mask->columns, 10);
  EXPECT_EQ(found[0].mask->rows, 8);  // not 16: no larger than the prototypes
  EXPECT_FALSE(found[0].mask->at(0.2f, 0.5f));
  EXPECT_TRUE(found[0].mask->at(0.8f, 0.5f));
}

}  // namespace
}  // namespace stillpoint::decode_yolov8_test
