// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Outputs that no sound network gives: an error that says so, or no detection; under sanitizers, nothing undefined.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "stillpoint/detectors/network_decoder.hpp"
#include "unit/detectors/made_tensor.hpp"

namespace stillpoint::absurd_outputs_test {
namespace {

constexpr float kAbsurd[] = {1e7f, 1e36f, 3e38f, std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()};

/// What is left in an image of the input's size.
std::vector<Detection> decoded(const DetectorOptions& options, const InputSize& input,
                               const std::vector<Tensor>& outputs) {
  const NetworkDecoder decoder(options, input, outputs);
  std::vector<RawDetection> raw;
  std::vector<Detection> found;
  decoder.decode(outputs, raw);
  decoder.finish(outputs, Letterbox(input, input, ImageFit::letterbox_centred), raw, found);
  return found;
}

DetectorOptions options_of(DetectorLayout layout, const ClassList& classes = ClassList({"person", "car"})) {
  DetectorOptions options;
  options.layout = layout;
  options.classes = classes;
  return options;
}

TEST(AbsurdOutputs, MaskRcnnsCornersOutOfTheWorld) {
  for (const float far : kAbsurd) {
    MadeTensor boxes({1, 1, 2, 7}), masks({2, 2, 15, 15}, 1.0f);
    boxes.write({0, 0, 0, 0}, {0, 0, 0.9f, -far, -far, far, far});
    boxes.write({0, 0, 1, 0}, {0, 0, 0.9f, 0.1f, 0.1f, 0.5f, 0.5f});
    EXPECT_EQ(decoded(options_of(DetectorLayout::mask_rcnn), {400, 400}, views(boxes, masks)).size(), 1u) << far;
  }
}

TEST(AbsurdOutputs, MaskRcnnsMasksWithoutACell) {
  for (const auto& [rows, columns] : {std::pair{0, 0}, {0, 15}, {15, 0}}) {
    MadeTensor boxes({1, 1, 2, 7});
    const MadeTensor masks({2, 2, rows, columns});
    boxes.write({0, 0, 0, 0}, {0, 0, 0.9f, 0.1f, 0.1f, 0.5f, 0.5f});
    expect_contains(
        error_of([&] {
          decoded(options_of(DetectorLayout::mask_rcnn), {400, 400}, views(boxes, masks));
        }),
        "layout mask-rcnn: found outputs 2x2x" + std::to_string(rows) + "x" + std::to_string(columns) + ", expected");
    boxes.write({0, 0, 0, 0}, {0, 0, 0.0f});
    EXPECT_TRUE(decoded(options_of(DetectorLayout::mask_rcnn), {400, 400}, views(boxes, masks)).empty());
  }
}

TEST(AbsurdOutputs, DetrsCoordinatesOutOfTheWorld) {
  for (const float far : kAbsurd) {
    for (const int field : {0, 1, 2, 3}) {
      MadeTensor logits({1, 3, 2}, 5.0f), boxes({1, 3, 4}, 0.5f);
      boxes.at({0, 1, field}) = field < 2 ? -far : far;
      EXPECT_EQ(decoded(options_of(DetectorLayout::detr), {640, 480}, views(logits, boxes)).size(), 2u) << far;
    }
  }
}

TEST(AbsurdOutputs, LabelledBoxesAndTheirMasksOutOfTheWorld) {
  for (const float far : kAbsurd) {
    MadeTensor labels(TensorShape{3}, 1.0f), scores(TensorShape{3}, 0.9f), boxes({3, 4}, 10.0f),
        masks({3, 1, 48, 64}, 1.0f);
    labels.whole_numbers = true;
    boxes.write({0, 0}, {10, 10, 20, 20});
    boxes.write({1, 0}, {-far, -far, far, far});
    boxes.write({2, 0}, {-9e5f, -9e5f, 9e5f, 9e5f});  // far out, and a box still: its mask must not overflow
    labels.values[1] = far;
    EXPECT_EQ(decoded(options_of(DetectorLayout::labelled_boxes), {64, 48}, views(labels, boxes, scores, masks)).size(),
              2u)
        << far;
  }
}

TEST(AbsurdOutputs, NoOutputAtAllIsAnError) {
  for (auto i = static_cast<int>(DetectorLayout::automatic); i <= static_cast<int>(DetectorLayout::label_map); ++i) {
    const auto layout = static_cast<DetectorLayout>(i);
    expect_contains(error_of([&] {
                      NetworkDecoder(options_of(layout), {64, 64}, {});
                    }),
                    "found outputs no output, expected at least one");
    expect_contains(error_of([&] { NetworkDecoder(options_of(layout, {}), {64, 64}, {}); }), "no output");
  }
}

TEST(AbsurdOutputs, AnOutputWithoutElementsIsNone) {
  const Tensor nowhere{{1, 2, 16, 16}, nullptr, false};
  expect_contains(error_of([&] {
                    NetworkDecoder(options_of(DetectorLayout::segmentation), {64, 64}, {&nowhere, 1});
                  }),
                  "with its elements");
}

// Empty in each of its extents, in turn: an error or nothing found.
TEST(AbsurdOutputs, EmptyOutputsFindNothing) {
  const std::vector<std::vector<int>> shapes = {
      {1, 6, 0},    {1, 0, 6}, {1, 0, 7}, {0, 7},       {1, 1, 0, 7},    {1, 2, 0, 16}, {1, 2, 8, 0}, {1, 0, 8, 8},
      {0, 2, 8, 8}, {1, 8, 0}, {1, 0, 8}, {1, 0, 0, 1}, {1, 3, 0, 0, 7}, {1, 21, 0, 0}, {0},          {}};
  for (const std::vector<int>& extents : shapes) {
    const MadeTensor output((TensorShape(extents)), 0.9f);
    for (auto i = static_cast<int>(DetectorLayout::automatic); i <= static_cast<int>(DetectorLayout::label_map); ++i) {
      const auto layout = static_cast<DetectorLayout>(i);
      for (const auto& outputs : {views(output), views(output, output), views(output, output, output)}) {
        try {
          EXPECT_TRUE(decoded(options_of(layout), {64, 48}, outputs).empty())
              << to_string(layout) << ' ' << describe(outputs);
        } catch (const Error&) {
        }
      }
    }
  }
}

TEST(AbsurdOutputs, ShapesThatNobodyCanCountAreRefused) {
  expect_contains(error_of([] { TensorShape({1, -1, 4}); }), "has the shape 1x-1x4, expected extents from 0 on");
  expect_contains(error_of([] { TensorShape({65536, 65536, 65536, 65536}); }), "at most 2147483647 elements");
  EXPECT_EQ(TensorShape({0, 65536, 65536}).count(), 0u);
}

TEST(AbsurdOutputs, AnInputWithoutPixelsIsAnError) {
  const MadeTensor output({1, 6, 84});
  for (const InputSize input : {InputSize{0, 64}, {64, 0}, {-8, 64}, {64, std::numeric_limits<int>::max()}})
    expect_contains(error_of([&] { NetworkDecoder(options_of(DetectorLayout::yolov8), input, views(output)); }),
                    "expected from 1 to 65535 pixels each way");
}

TEST(AbsurdOutputs, NanoDetHasFourPairsAtMost) {
  const MadeTensor scores({1, 2}), distances({1, 32});
  std::vector<Tensor> outputs;
  for (int i = 0; i < 40; ++i) outputs.push_back(i % 2 == 0 ? scores.view() : distances.view());
  expect_contains(error_of([&] {
                    NetworkDecoder(options_of(DetectorLayout::nanodet), {8, 8}, outputs);
                  }),
                  "expected a pair for each stride from 8 to 64 at most");
}

TEST(AbsurdOutputs, NumbersOfClassesOutOfRangeAreNoClass) {
  MadeTensor output({1, 4, 6});
  for (int i = 0; i < 4; ++i) output.write({0, i, 0}, {1, 1, 9, 9, 0.9f, kAbsurd[i]});
  DetectorOptions options = options_of(DetectorLayout::end2end);
  for (const int first : {std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), 0}) {
    options.first_class_number = first;
    EXPECT_TRUE(decoded(options, {64, 64}, views(output)).empty()) << first;
  }
}

// A host's own mask may be asked for a place a rounding beyond its box.
TEST(AbsurdOutputs, AMaskAnswersEverywhere) {
  const BoxMask mask{2, 1, {0, 1}}, empty;
  for (const float far : kAbsurd) {
    EXPECT_FALSE(mask.at(-far, far));
    EXPECT_EQ(mask.at(far, -far), !std::isnan(far));
    EXPECT_FALSE(empty.at(far, far));
  }
}

}  // namespace
}  // namespace stillpoint::absurd_outputs_test
