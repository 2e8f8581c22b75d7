// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/detectors/recognise_layout.hpp"

#include <algorithm>

#include "unit/detectors/made_tensor.hpp"

namespace stillpoint {
namespace {

// Cells of strides 8, 16, 32 (and 64): 320: 1600 + 400 + 100 (+ 25) = 2100 (2125). 416: 2704 + 676 + 169 = 3549
// (and 49). 640: 6400 + 1600 + 400 = 8400.
constexpr InputSize k320{320, 320}, k416{416, 416}, k640{640, 640};

DetectorLayout recognised(const std::vector<MadeTensor>& outputs, const InputSize& input, int class_count) {
  std::vector<Tensor> tensors;
  for (const MadeTensor& output : outputs) tensors.push_back(output.view());
  return recognise_layout(tensors, input, class_count);
}

MadeTensor integers(const TensorShape& shape) {
  MadeTensor tensor(shape);
  tensor.whole_numbers = true;
  return tensor;
}

#define EXPECT_LAYOUT(expected, ...) EXPECT_EQ(to_string(DetectorLayout::expected), to_string(recognised(__VA_ARGS__)))

TEST(RecogniseLayout, DetectionOutputs) {
  EXPECT_LAYOUT(mask_rcnn, {MadeTensor({1, 1, 100, 7}), MadeTensor({100, 90, 15, 15})}, k640, 90);
  EXPECT_LAYOUT(mask_rcnn, {MadeTensor({100, 90, 15, 15}), MadeTensor({1, 1, 100, 7})}, k640, 91);
  EXPECT_LAYOUT(ssd, {MadeTensor({1, 1, 100, 7})}, k416, 80);
  EXPECT_LAYOUT(ssd, {MadeTensor({1, 1, 1, 7})}, k416, 80);
  EXPECT_LAYOUT(yolov7_end2end, {MadeTensor({12, 7})}, k640, 80);
  EXPECT_LAYOUT(end2end, {MadeTensor({1, 300, 6})}, k640, 80);
  EXPECT_THROW(recognised({MadeTensor({1, 1001, 6})}, k640, 80), Error);
}

TEST(RecogniseLayout, Queries) {
  EXPECT_LAYOUT(detr, {MadeTensor({1, 100, 80}), MadeTensor({1, 100, 4})}, k320, 80);
  EXPECT_LAYOUT(detr, {MadeTensor({1, 100, 4}), MadeTensor({1, 100, 92})}, k640, 91);
  EXPECT_THROW(recognised({MadeTensor({1, 2100, 80}), MadeTensor({1, 2100, 4})}, k320, 80), Error);  // a sum of cells
  EXPECT_THROW(recognised({MadeTensor({1, 100, 4}), MadeTensor({1, 100, 4})}, k320, 4), Error);
  EXPECT_LAYOUT(labelled_boxes, {integers({1, 300}), MadeTensor({1, 300, 4}), MadeTensor({1, 300})}, k640, 80);
  EXPECT_LAYOUT(labelled_boxes, {MadeTensor({7, 4}), integers({7}), MadeTensor({7}), MadeTensor({7, 1, 640, 640})},
                k640, 91);
  EXPECT_THROW(recognised({MadeTensor({300}), MadeTensor({300, 4}), MadeTensor({300})}, k640, 80), Error);
}

TEST(RecogniseLayout, DistanceHeads) {
  std::vector<MadeTensor> heads = {MadeTensor({1600, 80}), MadeTensor({400, 32}), MadeTensor({100, 80}),
                                   MadeTensor({1600, 32}), MadeTensor({400, 80}), MadeTensor({100, 32})};
  EXPECT_LAYOUT(nanodet, heads, k320, 80);
  EXPECT_THROW(recognised(heads, k416, 80), Error);
  EXPECT_THROW(recognised(heads, k320, 20), Error);
  EXPECT_THROW(recognised(heads, k320, 32), Error);  // classes or bins?
  heads.emplace_back(TensorShape{1, 25, 80});
  heads.emplace_back(TensorShape{1, 25, 32});
  EXPECT_LAYOUT(picodet, heads, k320, 80);
  EXPECT_LAYOUT(nanodet_plus, {MadeTensor({1, 2125, 112})}, k320, 80);
  EXPECT_LAYOUT(nanodet_plus, {MadeTensor({1, 3598, 112})}, k416, 80);  // 416 is no multiple of 64: 7x7 cells
}

TEST(RecogniseLayout, Yolo) {
  EXPECT_LAYOUT(yolo_grid, {MadeTensor({1, 25200, 85})}, k640, 80);
  EXPECT_LAYOUT(yolo_grid, {MadeTensor({1, 10647, 85})}, k416, 80);
  EXPECT_LAYOUT(yolo_grid, {MadeTensor({1, 1500, 25})}, k320, 20);  // YOLOv3-tiny: 3 · (400 + 100)
  EXPECT_LAYOUT(yolox, {MadeTensor({1, 3549, 85})}, k416, 80);
  EXPECT_LAYOUT(yolox_decoded, {MadeTensor({1, 3549, 85}, 200.0f)}, k416, 80);
  EXPECT_LAYOUT(yolov8, {MadeTensor({1, 84, 8400})}, k640, 80);
  EXPECT_LAYOUT(yolov8_transposed, {MadeTensor({1, 8400, 84})}, k640, 80);
  EXPECT_LAYOUT(yolox, {MadeTensor({1, 8400, 84})}, k640, 79);  // only the number of classes settles it
  EXPECT_LAYOUT(yolov8_segmentation, {MadeTensor({1, 116, 8400}), MadeTensor({1, 32, 160, 160})}, k640, 80);
  EXPECT_LAYOUT(yolov5_segmentation, {MadeTensor({1, 32, 160, 160}), MadeTensor({1, 25200, 117})}, k640, 80);
  EXPECT_LAYOUT(darknet, {MadeTensor({300, 85}), MadeTensor({1200, 85})}, k320, 80);
  EXPECT_LAYOUT(darknet, {MadeTensor({845, 25})}, k416, 20);  // YOLOv2: 5 · 169
}

TEST(RecogniseLayout, AnInputNeedNotBeSquare) {
  EXPECT_LAYOUT(yolov8, {MadeTensor({1, 84, 6300})}, InputSize({640, 480}), 80);     // 80·60 + 40·30 + 20·15
  EXPECT_LAYOUT(nanodet_plus, {MadeTensor({1, 68, 112})}, InputSize({72, 40}), 80);  // 9·5 + 5·3 + 3·2 + 2·1
}

TEST(RecogniseLayout, Pictures) {
  EXPECT_LAYOUT(segmentation, {MadeTensor({1, 1, 256, 256})}, {256, 256}, 80);
  EXPECT_LAYOUT(segmentation, {MadeTensor({1, 2, 144, 256})}, {256, 144}, 80);
  EXPECT_LAYOUT(segmentation, {MadeTensor({1, 21, 64, 64})}, {513, 513}, 20);
  EXPECT_LAYOUT(segmentation, {MadeTensor({1, 21, 64, 64})}, {513, 513}, 21);
  EXPECT_LAYOUT(segmentation, {MadeTensor({1, 19, 64, 64})}, {513, 513}, 19);
  EXPECT_LAYOUT(label_map, {MadeTensor({1, 64, 64, 1})}, {513, 513}, 21);
  EXPECT_LAYOUT(label_map, {integers({1, 64, 64})}, {513, 513}, 21);
  EXPECT_THROW(recognised({MadeTensor({1, 30, 64, 64})}, {513, 513}, 80), Error);
}

TEST(RecogniseLayout, HeadsFitFourFamilies) {
  const std::vector<MadeTensor> heads = {MadeTensor({1, 3, 80, 80, 85}), MadeTensor({1, 3, 40, 40, 85}),
                                         MadeTensor({1, 3, 20, 20, 85})};
  const std::string error = error_of([&] { recognised(heads, k640, 80); });
  expect_contains(error, "outputs 1x3x80x80x85, 1x3x40x40x85, 1x3x20x20x85 with an input of 640x640 and 80 classes");
  expect_contains(error, "fit more than one layout; set one of yolov3, yolov4, yolov5, yolov7");
  expect_contains(error_of([&] {
                    recognised({MadeTensor({1, 255, 20, 20}), MadeTensor({1, 255, 40, 40})}, k640, 80);
                  }),
                  "set one of yolov3, yolov4, yolov5, yolov7");
  // One alone is a picture with too many classes, and two of one size are neither.
  for (const std::size_t count : {1u, 2u})
    expect_contains(error_of([&] {
                      recognised(std::vector<MadeTensor>(count, MadeTensor({1, 255, 20, 20})), k640, 80);
                    }),
                    "fit no layout");
}

TEST(RecogniseLayout, WhatFitsTwoIsRefused) {
  // As many boxes as fields: 84 cells of 64x64.
  expect_contains(error_of([&] {
                    recognised({MadeTensor({1, 84, 84})}, {64, 64}, 80);
                  }),
                  "set one of yolov8, yolov8-transposed");
  // One class, and few cells.
  expect_contains(error_of([&] { recognised({MadeTensor({1, 84, 6})}, {64, 64}, 1); }), "set one of end2end, yolox");
  // Two classes, seven numbers a row.
  expect_contains(error_of([&] { recognised({MadeTensor({300, 7})}, k320, 2); }), "set one of yolov7-end2end, darknet");
}

TEST(RecogniseLayout, WhatFitsNoneIsRefusedWithAllNames) {
  const std::string error = error_of([&] { recognised({MadeTensor({1, 1000})}, {224, 224}, 80); });
  expect_contains(error, "outputs 1x1000 with an input of 224x224 and 80 classes fit no layout");
  for (const std::string_view name : detail::kLayoutNames)
    if (name != "automatic") expect_contains(error, std::string(name));
  EXPECT_THROW(recognise_layout({}, k640, 80), Error);
  EXPECT_THROW(recognised({MadeTensor({1, 84, 8400})}, k416, 80), Error);
}

TEST(RecogniseLayout, NamesLeadToLayoutsAndBack) {
  for (const std::string_view name : detail::kLayoutNames) EXPECT_EQ(to_string(layout_from_name(name)), name);
  EXPECT_EQ(layout_from_name("yolov8-transposed"), DetectorLayout::yolov8_transposed);
  expect_contains(error_of([] { layout_from_name("yolo9000"); }),
                  "detector layout: found 'yolo9000', expected automatic or one of mask-rcnn, ssd");
}

}  // namespace
}  // namespace stillpoint
