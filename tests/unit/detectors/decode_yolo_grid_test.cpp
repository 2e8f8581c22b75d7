// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_yolo_grid.hpp"

#include <cmath>
#include <limits>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_yolo_grid_test {
namespace {

// Input 64x32: 8x4 + 4x2 + 2x1 = 32 + 8 + 2 = 42 cells. Two classes: 7 fields.
const DecodeSettings kSettings{{64, 32}, 2, 0.4f};

TEST(DecodeYoloGrid, RowsAreMiddlesInPixels) {
  MadeTensor output({1, 126, 7});
  output.write({0, 100, 0}, {30, 16, 20, 8, 0.8f, 0.1f, 0.9f});
  output.write({0, 101, 0}, {30, 16, 20, 8, 0.5f, 0.1f, 0.7f});  // 0.35: too little
  output.write({0, 102, 0}, {30, 16, -20, 8, 1, 1, 0});          // no area
  output.write({0, 103, 0}, {NAN, 16, 20, 8, 1, 1, 0});
  std::vector<RawDetection> found;
  decode_yolo_grid(output.view(), kSettings, 0, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 20, 12, 40, 20);
  EXPECT_NEAR(found[0].score, 0.72f, 1e-6f);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_EQ(found[0].source, 100);
}

TEST(DecodeYoloGrid, MaskFieldsAreNoClasses) {
  MadeTensor output({1, 3, 7 + 4});
  output.write({0, 1, 0}, {30, 16, 20, 8, 1, 0.5f, 0.6f, 9, 9, 9, 9});
  std::vector<RawDetection> found;
  decode_yolo_grid(output.view(), kSettings, 4, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].score, 0.6f, 1e-6f);
  EXPECT_THROW(decode_yolo_grid(output.view(), kSettings, 0, found), Error);
}

TEST(DecodeYolox, AddsTheCellAndTakesExponentials) {
  MadeTensor output({1, 42, 7});
  // Cell 13 of stride 8: column 5, row 1. x = (0.5 + 5)·8 = 44, y = (-0.25 + 1)·8 = 6; w = 2·8, h = 1·8.
  output.write({0, 13, 0}, {0.5f, -0.25f, std::log(2.0f), 0, 1, 0.5f, 0});
  // Cell 32 + 6 of stride 16: column 2, row 1. x = 2·16 = 32, y = 16; w = h = 16.
  output.write({0, 38, 0}, {0, 0, 0, 0, 1, 0, 0.75f});
  // Cell 41, the last, of stride 32: column 1, row 0. x = 1.5·32 = 48, y = 0.5·32 = 16; w = h = 32.
  output.write({0, 41, 0}, {0.5f, 0.5f, 0, 0, 0.5f, 1, 0});
  std::vector<RawDetection> found;
  decode_yolox(output.view(), kSettings, found);
  ASSERT_EQ(found.size(), 3u);
  expect_box(found[0], 36, 2, 52, 10);
  expect_box(found[1], 24, 8, 40, 24);
  expect_box(found[2], 32, 0, 64, 32);
  EXPECT_EQ(found[1].label, 1);
  EXPECT_NEAR(found[2].score, 0.5f, 1e-6f);
  EXPECT_THROW(decode_yolox(MadeTensor({1, 41, 7}).view(), kSettings, found), Error);
  EXPECT_THROW(decode_yolox(MadeTensor({1, 42, 8}).view(), kSettings, found), Error);
}

TEST(DecodeYolox, NegativeSizesOrMiddlesNearTheirCellsAreUndecoded) {
  MadeTensor output({1, 42, 7});
  output.write({0, 7, 0}, {3, -2, 0.5f, 1});
  EXPECT_TRUE(yolox_is_undecoded(output.view()));  // all near
  output.write({0, 8, 0}, {40, 20, 0.5f, 1});
  EXPECT_FALSE(yolox_is_undecoded(output.view()));  // one is far, no size is negative
  output.write({0, 9, 2}, {-0.1f});
  EXPECT_TRUE(yolox_is_undecoded(output.view()));
}

TEST(DecodeDarknet, SharesOfTheInputAndScoresThatAreMultipliedAlready) {
  MadeTensor coarse({6, 7}), fine({24, 7});
  // x = 0.5·64 = 32, y = 0.25·32 = 8; w = 0.25·64 = 16, h = 0.5·32 = 16. The score is 0.6, not 0.7·0.6.
  fine.write({4, 0}, {0.5f, 0.25f, 0.25f, 0.5f, 0.7f, 0, 0.6f});
  std::vector<RawDetection> found;
  decode_darknet(views(coarse, fine), kSettings, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 24, 0, 40, 16);
  EXPECT_NEAR(found[0].score, 0.6f, 1e-6f);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_THROW(decode_darknet(views(MadeTensor({6, 8})), kSettings, found), Error);
}

}  // namespace
}  // namespace stillpoint::decode_yolo_grid_test
