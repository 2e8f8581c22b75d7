// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A detector on OpenCV's dnn module: a network from a file, an image in, detections out.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/detector_options.hpp"
#include "stillpoint/detectors/drop_duplicates.hpp"
#include "stillpoint/detectors/model_files.hpp"
#include "stillpoint/detectors/model_input_size.hpp"
#include "stillpoint/detectors/network_decoder.hpp"
#include "stillpoint/detectors/network_input.hpp"
#include "stillpoint/detectors/tensor.hpp"

namespace stillpoint {

/// Runs .onnx, Darknet, TensorFlow and Caffe networks. One thread at a time may use it; OpenCV works with as many
/// threads as `cv::setNumThreads` allows.
class OpenCvDetector {
 public:
  struct Options : DetectorOptions {
    std::filesystem::path config;  ///< structure beside the weights; none: the file of the same name, see ModelFiles
    cv::dnn::Backend backend = cv::dnn::DNN_BACKEND_OPENCV;
    cv::dnn::Target target = cv::dnn::DNN_TARGET_CPU;
  };

  /// Reads the network and runs it once, since some can be read but not run.
  /// @throws Error naming the file if it is missing or broken, OpenCV cannot run it, backend and target are not there,
  /// or layout, classes or input size can neither be told nor agree with what was set.
  OpenCvDetector(const std::filesystem::path& model, const Options& options) : name_(model.string()) {
    const ModelFiles files = find_model_files(model, options.config);
    require_backend(options);
    guarded("read", [&] { network_ = cv::dnn::readNet(files.model.string(), files.config.string()); });
    const InputSize size = input_size(files, options);
    guarded("run", [&] {
      network_.setPreferableBackend(options.backend);
      network_.setPreferableTarget(options.target);
    });
    choose_outputs(options.outputs);
    const std::vector<float> nothing(3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    guarded("run", [&] {
      run(nothing, size);
      decoder_ = NetworkDecoder(options, size, tensors_);
    });
    input_ = NetworkInput(size, options.preprocess ? *options.preprocess : usual_preprocess(decoder_.layout()));
    highest_overlap_ = options.highest_overlap;
  }
  explicit OpenCvDetector(const std::filesystem::path& model) : OpenCvDetector(model, Options()) {}
  OpenCvDetector(const OpenCvDetector&) = delete;  // two would share one network
  OpenCvDetector& operator=(const OpenCvDetector&) = delete;
  OpenCvDetector(OpenCvDetector&&) = default;
  OpenCvDetector& operator=(OpenCvDetector&&) = default;

  /// Finds what the network knows, the most confident first.
  /// @param image       BGR; gray is taken as a colourless image; 8 bit
  /// @param detections  pixels of the image, cut at its border; what was in it is dropped
  /// @throws Error if the image is empty or of another format, or the network cannot be run.
  void detect(const ImageView& image, std::vector<Detection>& detections) {
    detections.clear();
    const Letterbox letterbox = input_.fill(image);
    guarded("run", [&] {
      run(input_.values(), input_.size());
      decoder_.decode(tensors_, found_);
    });
    if (leaves_duplicates(decoder_.layout())) drop_duplicates(found_, highest_overlap_);
    decoder_.finish(tensors_, letterbox, found_, detections);
  }

  DetectorLayout layout() const noexcept { return decoder_.layout(); }
  /// `Detection::class_index` is an index into it.
  const ClassList& classes() const noexcept { return decoder_.classes(); }
  InputSize input_size() const noexcept { return input_.size(); }

 private:
  InputSize input_size(const ModelFiles& files, const Options& options) const {
    InputSize size = options.input_size;
    if (size.width == 0 && size.height == 0) {
      if (files.model.extension() == ".onnx") size = onnx_input_size(files.model);
      if (files.config.extension() == ".cfg") size = darknet_input_size(files.config);
    }
    require_input_size(size, name_);
    return size;
  }

  /// OpenCV would take the CPU without a word.
  void require_backend(const Options& options) const {
    const auto available = cv::dnn::getAvailableTargets(options.backend);
    if (std::find(available.begin(), available.end(), options.target) == available.end())
      throw Error(name_ + ": this OpenCV " CV_VERSION " was built without backend " + std::to_string(options.backend) +
                  " on target " + std::to_string(options.target) + " (cv::dnn::Backend, cv::dnn::Target)");
  }

  void choose_outputs(const std::vector<std::string>& wanted) {
    guarded("read", [&] {
      output_names_.assign(wanted.begin(), wanted.end());
      if (wanted.empty()) output_names_ = network_.getUnconnectedOutLayersNames();
    });
    for (const std::string& output : output_names_)
      if (network_.getLayerId(output) < 0) refuse_output(output);
  }
  [[noreturn]] void refuse_output(const std::string& output) const {
    std::string names;
    for (const std::string& name : network_.getUnconnectedOutLayersNames())
      names.append(names.empty() ? "" : ", ").append(name);
    throw Error(name_ + ": found no output '" + output + "', expected one of " + names + ", or an inner layer");
  }

  void run(const std::vector<float>& values, const InputSize& size) {
    const int extents[] = {1, 3, size.height, size.width};
    network_.setInput(cv::Mat(4, extents, CV_32F, const_cast<float*>(values.data())));
    network_.forward(results_, output_names_);
    tensors_.clear();
    for (cv::Mat& result : results_) {
      const bool whole_numbers = result.depth() < CV_32F;
      if (result.depth() != CV_32F) result.convertTo(result, CV_32F);
      if (!result.isContinuous()) result = result.clone();
      tensors_.push_back({TensorShape(span<const int>(result.size.p, static_cast<std::size_t>(result.dims))),
                          result.ptr<float>(), whole_numbers});
    }
  }

  /// OpenCV's own exceptions as ours, on one line, and the file's name before ours.
  template <class Action>
  void guarded(const char* what, Action&& action) const {
    try {
      action();
    } catch (const Error& error) {
      throw Error(name_ + ": " + error.what());
    } catch (const std::exception& exception) {
      std::string reason = exception.what();
      std::replace(reason.begin(), reason.end(), '\n', ' ');
      reason.erase(reason.find_last_not_of("> ") + 1);  // the quotation marks of OpenCV's own lines
      throw Error(name_ + ": OpenCV " CV_VERSION " cannot " + what +
                  " this network (docs/detectors.md has remedies): " + reason);
    }
  }

  std::string name_;
  cv::dnn::Net network_;
  std::vector<cv::String> output_names_;
  std::vector<cv::Mat> results_;
  std::vector<Tensor> tensors_;
  NetworkDecoder decoder_;
  NetworkInput input_;
  float highest_overlap_ = 0.45f;
  std::vector<RawDetection> found_;
};

}  // namespace stillpoint
