// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/decode_detr.hpp"

#include <cmath>
#include <limits>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::decode_detr_test {
namespace {

const DecodeSettings kSettings{{200, 100}, 3, 0.4f};

TEST(DecodeDetr, AsManyColumnsAsClassesAreSigmoids) {
  MadeTensor logits({1, 10, 3}, -10), boxes({1, 10, 4});
  logits.at({0, 4, 2}) = std::log(3.0f);  // 0.75
  boxes.write({0, 4, 0}, {0.5f, 0.4f, 0.2f, 0.6f});
  std::vector<RawDetection> found;
  decode_detr(views(boxes, logits), kSettings, found);  // in either order
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 80, 10, 120, 70);
  EXPECT_NEAR(found[0].score, 0.75f, 1e-6f);
  EXPECT_EQ(found[0].label, 2);
}

TEST(DecodeDetr, OneColumnMoreIsASoftmaxAgainstNothing) {
  const MadeTensor boxes({1, 10, 4}, 0.5f);
  MadeTensor three({1, 10, 3}, 0);
  three.write({0, 0, 0}, {std::log(6.0f), std::log(2.0f), 0});  // 6/9, 2/9, nothing 1/9
  three.write({0, 1, 0}, {0, 0, std::log(8.0f)});               // nothing: 8/10
  for (int q = 2; q < 10; ++q) three.at({0, q, 2}) = 5;
  std::vector<RawDetection> found;
  decode_detr(views(three, boxes), {{200, 100}, 2, 0.4f}, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].score, 6.0f / 9, 1e-6f);
  EXPECT_EQ(found[0].label, 0);
}

TEST(DecodeDetr, FourColumnsOfLogitsCannotBeToldFromBoxes) {
  const MadeTensor logits({1, 10, 4}), boxes({1, 10, 4});
  std::vector<RawDetection> found;
  expect_contains(error_of([&] { decode_detr(views(logits, boxes), kSettings, found); }),
                  "layout detr: found outputs 1x10x4, 1x10x4, expected");
}

struct Labelled {
  MadeTensor labels{{1, 3}}, boxes{{1, 3, 4}}, scores{{1, 3}};
  Labelled() {
    labels.whole_numbers = true;
    labels.write({0, 0}, {7, 1, 2});
    scores.write({0, 0}, {0.1f, 0.9f, NAN});
    boxes.write({0, 1, 0}, {10, 20, 30, 60});
  }
};

TEST(DecodeLabelledBoxes, LabelsAreTheIntegers) {
  const Labelled made;
  std::vector<RawDetection> found;
  decode_labelled_boxes(views(made.scores, made.labels, made.boxes), kSettings, found);
  ASSERT_EQ(found.size(), 1u);
  expect_box(found[0], 10, 20, 30, 60);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_NEAR(found[0].score, 0.9f, 1e-6f);
}

TEST(DecodeLabelledBoxes, MasksCoverTheWholeInput) {
  const Labelled made;
  MadeTensor masks({3, 1, 100, 200});
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 200; ++u) masks.at({1, 0, v, u}) = 1;  // above 40: the upper half of the box
  std::vector<RawDetection> found;
  decode_labelled_boxes(views(made.labels, made.boxes, made.scores, masks), kSettings, found);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_TRUE(found[0].mask);
  EXPECT_EQ(found[0].mask->columns, 20);
  EXPECT_EQ(found[0].mask->rows, 40);
  EXPECT_TRUE(found[0].mask->at(0.5f, 0.49f));
  EXPECT_FALSE(found[0].mask->at(0.5f, 0.51f));
}

TEST(DecodeLabelledBoxes, NothingFoundIsNoError) {
  MadeTensor labels({0}), boxes({0, 4}), scores({0});
  labels.whole_numbers = true;
  std::vector<RawDetection> found;
  decode_labelled_boxes(views(labels, boxes, scores), kSettings, found);
  EXPECT_TRUE(found.empty());
  labels.whole_numbers = false;
  expect_contains(error_of([&] { decode_labelled_boxes(views(labels, boxes, scores), kSettings, found); }),
                  "found outputs 0, 0x4, 0, expected Q integers");
}

}  // namespace
}  // namespace stillpoint::decode_detr_test
