// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_detection_output.hpp"

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_detection_output_test {
namespace {

const DecodeSettings kSettings{{200, 100}, 3, 0.4f};

TEST(DecodeDetectionOutput, CornersAreSharesOfTheInput) {
  MadeTensor output({1, 1, 4, 7});
  output.write({0, 0, 0, 0}, {0, 2, 0.9f, 0.1f, 0.2f, 0.5f, 0.6f});
  output.write({0, 0, 1, 0}, {0, 1, 0.3f, 0.1f, 0.2f, 0.5f, 0.6f});
  output.write({0, 0, 2, 0}, {0, 1, NAN, 0.1f, 0.2f, 0.5f, 0.6f});
  std::vector<RawDetection> found;
  decode_detection_output(output.view(), kSettings, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 20, 20, 100, 60);
  EXPECT_EQ(found[0].label, 2);
  EXPECT_NEAR(found[0].score, 0.9f, 1e-6f);
}

TEST(DecodeDetectionOutput, UnusedRowsAreNothingEvenWithoutAThreshold) {
  DecodeSettings all = kSettings;
  all.lowest_confidence = 0;
  MadeTensor output({1, 1, 2, 7});
  output.write({0, 0, 0, 0}, {0, 0, 0, 0.1f, 0.2f, 0.5f, 0.6f});
  std::vector<RawDetection> found;
  decode_detection_output(output.view(), all, found);
  EXPECT_TRUE(found.empty());
  EXPECT_THROW(decode_detection_output(MadeTensor({1, 2, 7}).view(), all, found), Error);
}

TEST(DecodeDetectionOutput, MasksAreTheChannelOfTheClass) {
  MadeTensor output({1, 1, 2, 7}), masks({2, 3, 4, 4});
  output.write({0, 0, 1, 0}, {0, 2, 0.9f, 0, 0, 0.5f, 1});
  for (int v = 0; v < 4; ++v)  // second box, class 2: the left half
    for (int u = 0; u < 2; ++u) masks.at({1, 2, v, u}) = 1;
  std::vector<RawDetection> found;
  decode_detection_output(output.view(), kSettings, found);
  attach_class_masks(masks.view(), found);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_TRUE(found[0].mask);
  EXPECT_TRUE(found[0].mask->at(0.05f, 0.5f));
  EXPECT_TRUE(found[0].mask->at(0.45f, 0.9f));
  EXPECT_FALSE(found[0].mask->at(0.55f, 0.1f));
  EXPECT_FALSE(found[0].mask->at(0.95f, 0.5f));

  found[0].label = 3;  // no such channel
  found[0].mask = nullptr;
  attach_class_masks(masks.view(), found);
  EXPECT_FALSE(found[0].mask);
}

TEST(DecodeEnd2End, TwoOrdersOfColumns) {
  MadeTensor seven({2, 7}), six({1, 3, 6});
  seven.write({1, 0}, {0, 10, 20, 30, 60, 2, 0.9f});  // image, corners, class, score
  six.write({0, 2, 0}, {10, 20, 30, 60, 0.8f, 1});    // corners, score, class
  six.write({0, 1, 0}, {10, 20, 30, 60, NAN, 1});
  six.write({0, 0, 0}, {30, 20, 10, 60, 0.8f, 1});  // right is left of left
  std::vector<RawDetection> found;
  decode_yolov7_end2end(seven.view(), kSettings, found);
  decode_end2end(six.view(), kSettings, found);
  ASSERT_EQ(found.size(), 2u);
  for (const RawDetection& box : found) expect_box(box, 10, 20, 30, 60);
  EXPECT_EQ(found[0].label, 2);
  EXPECT_NEAR(found[0].score, 0.9f, 1e-6f);
  EXPECT_EQ(found[1].label, 1);
  EXPECT_NEAR(found[1].score, 0.8f, 1e-6f);
  EXPECT_THROW(decode_end2end(seven.view(), kSettings, found), Error);
  EXPECT_THROW(decode_yolov7_end2end(six.view(), kSettings, found), Error);
}

}  // namespace
}  // namespace stillpoint::decode_detection_output_test
