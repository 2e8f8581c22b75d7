// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// From a network's outputs to detections, whichever library ran it.   outputs → raw boxes → boxes in the image

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/class_list.hpp"
#include "stillpoint/detectors/decode_detection_output.hpp"
#include "stillpoint/detectors/decode_detr.hpp"
#include "stillpoint/detectors/decode_nanodet.hpp"
#include "stillpoint/detectors/decode_segmentation.hpp"
#include "stillpoint/detectors/decode_yolo_grid.hpp"
#include "stillpoint/detectors/decode_yolo_raw.hpp"
#include "stillpoint/detectors/decode_yolov8.hpp"
#include "stillpoint/detectors/detector_options.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/letterbox.hpp"
#include "stillpoint/detectors/recognise_layout.hpp"
#include "stillpoint/detectors/yolo_masks.hpp"

namespace stillpoint {

/// Settles layout and classes once, by the outputs of a first run, and then decodes frame by frame.
class NetworkDecoder {
 public:
  NetworkDecoder() = default;

  /// @param outputs  of a run on any image, an empty one too
  /// @throws Error if layout or classes are neither set nor told by the shapes, or the shapes contradict them; if there
  ///         is no output, the input's size is none, or an option that is a share or a probability is not 0 to 1.
  NetworkDecoder(const DetectorOptions& options, const InputSize& input, span<const Tensor> outputs)
      : options_(options), layout_(options.layout) {
    require_options(options);
    require_input(input);
    require_outputs(outputs);
    settings_.input = input;
    settings_.lowest_confidence = options.lowest_confidence;
    if (options.classes.empty())
      choose_layout_and_classes(outputs);
    else if (layout_ == DetectorLayout::automatic)
      layout_ = recognise_layout(outputs, input, static_cast<int>(options.classes.size()));
    settings_.class_count = static_cast<int>(classes().size());
    if (layout_ == DetectorLayout::segmentation && outputs[0].shape[1] <= 2 && classes().starts_with_background() &&
        !options_.first_class_number)
      options_.first_class_number = -1;  // the one class that there is comes behind the background
    if (!options_.coding) options_.coding = yolo_coding(layout_);
    for (std::size_t i = 0; i < classes().size(); ++i) mobility_.push_back(options_.mobility[classes()[i]]);
    std::vector<RawDetection> ignored;
    decode(outputs, ignored);  // throws where the shapes are wrong
  }

  DetectorLayout layout() const noexcept { return layout_; }
  const ClassList& classes() const noexcept { return options_.classes; }

  /// Boxes that score enough, in pixels of the input; duplicates are still there, YOLO's masks not yet.
  /// @throws Error if the shapes are not those of the layout.
  void decode(span<const Tensor> outputs, std::vector<RawDetection>& found) const {
    found.clear();
    require_outputs(outputs);
    const auto only = [&]() -> const Tensor& {
      require_shape(outputs.size() == 1, std::string(to_string(layout_)).c_str(), "one output", outputs);
      return outputs[0];
    };
    switch (layout_) {
      case DetectorLayout::mask_rcnn: {
        const BoxesAndMasks parts = class_masks(outputs);
        decode_detection_output(*parts.boxes, settings_, found);
        return attach_class_masks(*parts.masks, found);
      }
      case DetectorLayout::ssd: return decode_detection_output(only(), settings_, found);
      case DetectorLayout::yolov7_end2end: return decode_yolov7_end2end(only(), settings_, found);
      case DetectorLayout::end2end: return decode_end2end(only(), settings_, found);
      case DetectorLayout::detr: return decode_detr(outputs, settings_, found);
      case DetectorLayout::labelled_boxes: return decode_labelled_boxes(outputs, settings_, found);
      case DetectorLayout::nanodet: return decode_nanodet(outputs, settings_, kNanoDetMiddle, found);
      case DetectorLayout::picodet: return decode_nanodet(outputs, settings_, kPicoDetMiddle, found);
      case DetectorLayout::nanodet_plus: return decode_nanodet_plus(only(), settings_, found);
      case DetectorLayout::yolo_grid:
      case DetectorLayout::yolox_decoded: return decode_yolo_grid(only(), settings_, 0, found);
      case DetectorLayout::yolox: return decode_yolox(only(), settings_, found);
      case DetectorLayout::yolov8: return decode_yolov8(only(), settings_, 0, false, found);
      case DetectorLayout::yolov8_transposed: return decode_yolov8(only(), settings_, 0, true, found);
      case DetectorLayout::yolov8_segmentation: {
        const BoxesAndPrototypes parts = prototypes(outputs);
        return decode_yolov8(*parts.boxes, settings_, parts.prototypes->shape[1], false, found);
      }
      case DetectorLayout::yolov5_segmentation: {
        const BoxesAndPrototypes parts = prototypes(outputs);
        return decode_yolo_grid(*parts.boxes, settings_, parts.prototypes->shape[1], found);
      }
      case DetectorLayout::darknet: return decode_darknet(outputs, settings_, found);
      case DetectorLayout::segmentation:
        return append_parts(label_map_from_scores(only(), settings_), settings_, options_.smallest_part, found);
      case DetectorLayout::label_map:
        return append_parts(label_map_from_labels(only()), settings_, options_.smallest_part, found);
      default: return decode_yolo_raw(outputs, settings_, *options_.coding, found);
    }
  }

  /// Masks for what is left, classes by name, boxes in the image: the most confident first.
  void finish(span<const Tensor> outputs, const Letterbox& letterbox, std::vector<RawDetection>& found,
              std::vector<Detection>& detections) const {
    const auto lost = [&](RawDetection& raw) {
      return !classes().names(class_index(raw.label)) || !letterbox.clip(raw);
    };
    found.erase(std::remove_if(found.begin(), found.end(), lost), found.end());
    std::stable_sort(found.begin(), found.end(),
                     [](const RawDetection& a, const RawDetection& b) { return a.score > b.score; });
    if (layout_ == DetectorLayout::yolov8_segmentation || layout_ == DetectorLayout::yolov5_segmentation) {
      const bool v8 = layout_ == DetectorLayout::yolov8_segmentation;
      const BoxesAndPrototypes parts = prototypes(outputs);
      attach_yolo_masks(*parts.boxes, *parts.prototypes, {(v8 ? 4 : 5) + settings_.class_count, v8}, settings_.input,
                        found);
    }
    detections.clear();
    for (RawDetection& raw : found) {
      const int index = class_index(raw.label);
      Detection detection;
      detection.box = letterbox.to_image(raw);
      detection.mobility = mobility_[static_cast<std::size_t>(index)];
      detection.confidence = std::min(raw.score, 1.0f);
      detection.mask = std::move(raw.mask);
      detection.class_index = static_cast<std::int16_t>(index);
      detections.push_back(std::move(detection));
    }
  }

 private:
  /// Where the network's number is in the list: they count from 0, but SSD from a background that most lists lack, and
  /// OpenCV's Mask R-CNN without the background that COCO's list has.
  int class_index(int label) const noexcept {
    if (label < 0) return -1;
    if (options_.first_class_number) {
      const std::int64_t index = std::int64_t{label} - *options_.first_class_number;
      return index >= 0 && index < static_cast<std::int64_t>(classes().size()) ? static_cast<int>(index) : -1;
    }
    const bool background = classes().starts_with_background();
    if (layout_ == DetectorLayout::ssd && !background) return label - 1;
    if (layout_ == DetectorLayout::mask_rcnn && background) return label + 1;
    return label;
  }

  static void require_options(const DetectorOptions& options) {
    const std::pair<const char*, float> shares[] = {{"lowest_confidence", options.lowest_confidence},
                                                    {"highest_overlap", options.highest_overlap},
                                                    {"smallest_part", options.smallest_part}};
    for (const auto& [name, value] : shares)
      if (!(value >= 0.0f && value <= 1.0f))
        throw Error(std::string(name) + " is " + option_text(value) + ", expected 0 to 1");
  }

  static void require_input(const InputSize& input) {
    constexpr int kLargest = 65535;  // what images' files can hold, too
    if (input.width < 1 || input.height < 1 || input.width > kLargest || input.height > kLargest)
      throw Error("the network's input is " + std::to_string(input.width) + "x" + std::to_string(input.height) +
                  ", expected from 1 to " + std::to_string(kLargest) + " pixels each way");
  }

  /// At least one, and elements in each that should have some.
  void require_outputs(span<const Tensor> outputs) const {
    bool fits = !outputs.empty();
    for (const Tensor& output : outputs) fits = fits && (output.data != nullptr || output.shape.count() == 0);
    require_shape(fits, std::string(to_string(layout_)).c_str(), "at least one output, with its elements", outputs);
  }

  /// Without a class list: the list that comes with the library whose length fits the shapes, if it is one alone.
  void choose_layout_and_classes(span<const Tensor> outputs) {
    std::vector<const ClassList*> fitting;
    std::vector<DetectorLayout> layouts;
    const std::array<ClassList, 5> lists = {ClassList::coco(), ClassList::coco91(), ClassList::voc(),
                                            ClassList::voc21(), ClassList::cityscapes()};
    for (const ClassList& list : lists) {
      for (const DetectorLayout layout : fitting_layouts(outputs, settings_.input, static_cast<int>(list.size()))) {
        if (layout_ != DetectorLayout::automatic && layout != layout_) continue;
        // YOLO and its kin have no number for the background. 21 channels are VOC's with it: no need of VOC without.
        if (leaves_duplicates(layout) && list.starts_with_background()) continue;
        if (layout == DetectorLayout::segmentation && outputs[0].shape[1] == 21 && list.size() == 20) continue;
        fitting.push_back(&list);
        if (std::find(layouts.begin(), layouts.end(), layout) == layouts.end()) layouts.push_back(layout);
      }
    }
    if (layouts.size() > 1)
      throw Error("outputs " + describe(outputs) + " fit more than one layout; set one of " + layout_names(layouts));
    if (layouts.empty())
      throw Error("outputs " + describe(outputs) + " with an input of " + std::to_string(settings_.input.width) + "x" +
                  std::to_string(settings_.input.height) + " and the classes of COCO, VOC or Cityscapes fit " +
                  (layout_ == DetectorLayout::automatic
                       ? "no layout; set the class list, the input size, or one of " + layout_names()
                       : "not " + std::string(to_string(layout_)) + "; set the class list or another layout"));
    layout_ = layouts.front();
    if (layout_ == DetectorLayout::segmentation && outputs[0].shape[1] <= 2)
      options_.classes = ClassList::person();  // what networks with one class are made for
    else if (fitting.size() == 1)
      options_.classes = *fitting.front();
    else
      throw Error("outputs " + describe(outputs) + " are those of " + std::string(to_string(layout_)) +
                  ", which do not tell the classes: set the class list");
  }

  BoxesAndPrototypes prototypes(span<const Tensor> outputs) const {
    const BoxesAndPrototypes parts = find_prototypes(outputs);
    require_shape(static_cast<bool>(parts), std::string(to_string(layout_)).c_str(),
                  "boxes of rank 3 and prototypes 1xmxhxw", outputs);
    return parts;
  }
  BoxesAndMasks class_masks(span<const Tensor> outputs) const {
    const BoxesAndMasks parts = find_class_masks(outputs);
    require_shape(static_cast<bool>(parts), "mask-rcnn", "1x1xKx7 and Kx(classes)xhxw", outputs);
    return parts;
  }

  DetectorOptions options_;
  DetectorLayout layout_ = DetectorLayout::automatic;
  DecodeSettings settings_;
  std::vector<Mobility> mobility_;  ///< of each class
};

}  // namespace stillpoint
