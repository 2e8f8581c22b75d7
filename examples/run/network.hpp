// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The detector of `--prior MODEL`, whichever library runs it.

#include <memory>
#include <utility>
#include <vector>

#include "options.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/class_list.hpp"
#include "stillpoint/detectors/detector_options.hpp"
#include "stillpoint/detectors/layout.hpp"
#include "stillpoint/detectors/raw_detection.hpp"
#ifdef STILLPOINT_RUN_WITH_DNN
#include "stillpoint/detectors/opencv_dnn.hpp"
#endif

namespace stillpoint_run {

/// A detector that was read from a file. One call per frame: virtual functions cost nothing here.
class Network {
 public:
  Network() = default;
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;
  virtual ~Network() = default;

  virtual void detect(const stillpoint::ImageView& image, std::vector<stillpoint::Detection>& detections) = 0;
  virtual stillpoint::DetectorLayout layout() const = 0;
  virtual const stillpoint::ClassList& classes() const = 0;
  virtual stillpoint::InputSize input_size() const = 0;
};

/// Any of the library's detectors as a `Network`.
template <class Detector>
class NetworkOf : public Network {
 public:
  explicit NetworkOf(Detector detector) : detector_(std::move(detector)) {}

  void detect(const stillpoint::ImageView& image, std::vector<stillpoint::Detection>& detections) override {
    detector_.detect(image, detections);
  }
  stillpoint::DetectorLayout layout() const override { return detector_.layout(); }
  const stillpoint::ClassList& classes() const override { return detector_.classes(); }
  stillpoint::InputSize input_size() const override { return detector_.input_size(); }

 private:
  Detector detector_;
};

/// Reads the network that `--prior` names. The one place that knows which libraries there are.
/// @throws stillpoint::Error where it can't be read or run, or this program was built without a library for it.
inline std::unique_ptr<Network> open_network(const Options& options) {
  stillpoint::DetectorOptions wanted;
  wanted.layout = stillpoint::layout_from_name(options.detector_layout);
  if (!options.classes.empty()) wanted.classes = stillpoint::ClassList::named(options.classes);
#ifdef STILLPOINT_RUN_WITH_DNN
  stillpoint::OpenCvDetector::Options opencv;
  static_cast<stillpoint::DetectorOptions&>(opencv) = wanted;
  return std::make_unique<NetworkOf<stillpoint::OpenCvDetector>>(stillpoint::OpenCvDetector(options.prior, opencv));
#else
  throw stillpoint::Error("--prior: found " + options.prior +
                          ", but this stillpoint_run was built without OpenCV's dnn module, which runs networks; "
                          "expected none, boxes or labels");
#endif
}

}  // namespace stillpoint_run
