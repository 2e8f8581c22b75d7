// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A detector on ONNX Runtime: a network from an .onnx file, an image in, detections out.

#include <onnxruntime_cxx_api.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/core/regular_file.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/detectors/detector_options.hpp"
#include "stillpoint/detectors/drop_duplicates.hpp"
#include "stillpoint/detectors/model_files.hpp"
#include "stillpoint/detectors/model_input_size.hpp"
#include "stillpoint/detectors/network_decoder.hpp"
#include "stillpoint/detectors/network_input.hpp"
#include "stillpoint/detectors/tensor.hpp"

namespace stillpoint {

/// Runs .onnx networks, on the CPU. One thread at a time may use it.
class OnnxRuntimeDetector {
 public:
  struct Options : DetectorOptions {
    int intra_op_threads = 1;  ///< share each operation; 0: as many as the machine has cores
    int inter_op_threads = 1;  ///< run operations that do not wait for each other; 0: as above
  };

  /// Reads the network and runs it once, since some can be read but not run.
  /// @throws Error naming the file if it is missing or broken, ONNX Runtime cannot run it, it wants other inputs than
  /// an image (float, 1x3xHxW; any extent may be free) and perhaps the image's size (int64, 1x2), or layout, classes or
  /// input size can neither be told nor agree with what was set.
  OnnxRuntimeDetector(const std::filesystem::path& model, const Options& options)
      : name_(require_library(model)), highest_overlap_(options.highest_overlap) {
    detail::require_regular_file(model, "a model");
    guarded("read", [&] { open(model, options); });
    InputSize size;
    guarded("take", [&] {
      size = choose_inputs();
      choose_outputs(options.outputs);
    });
    if (options.input_size.width != 0 || options.input_size.height != 0) size = options.input_size;
    require_input_size(size, name_);
    const std::vector<float> nothing(3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    guarded("run", [&] {
      run(nothing, size);
      decoder_ = NetworkDecoder(options, size, tensors_);
    });
    input_ = NetworkInput(size, options.preprocess ? *options.preprocess : usual_preprocess(decoder_.layout()));
  }
  explicit OnnxRuntimeDetector(const std::filesystem::path& model) : OnnxRuntimeDetector(model, Options()) {}

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
  using Extents = std::vector<std::int64_t>;  // less than 0: free

  /// A library that is older than the headers has no table of functions for them: not even its errors could be read.
  static std::string require_library(const std::filesystem::path& model) {
    if (OrtGetApiBase()->GetApi(ORT_API_VERSION) == nullptr)
      throw Error(model.string() + ": ONNX Runtime " + library_version() + " was loaded, and this was compiled for 1." +
                  std::to_string(ORT_API_VERSION) + " or later");
    return model.string();
  }
  static std::string library_version() { return OrtGetApiBase()->GetVersionString(); }

  void open(const std::filesystem::path& model, const Options& options) {
    if (options.intra_op_threads < 0 || options.inter_op_threads < 0)
      throw Error("found " + std::to_string(std::min(options.intra_op_threads, options.inter_op_threads)) +
                  " threads, expected 0 (one for each core) or more");
    Ort::SessionOptions session;
    session.SetLogSeverityLevel(ORT_LOGGING_LEVEL_FATAL);  // what goes wrong is thrown, too
    session.SetIntraOpNumThreads(options.intra_op_threads);
    session.SetInterOpNumThreads(options.inter_op_threads);
    session.SetExecutionMode(options.inter_op_threads == 1 ? ORT_SEQUENTIAL : ORT_PARALLEL);
    environment_ = Ort::Env(ORT_LOGGING_LEVEL_FATAL, "stillpoint");
    session_ = Ort::Session(environment_, model.c_str(), session);
  }

  /// The image comes first, then its size if the network asks for that (RT-DETR and its like, post-processed).
  /// @return the size that the network wants; 0 where it leaves that free
  InputSize choose_inputs() {
    InputSize size;
    std::string size_name;
    Ort::AllocatorWithDefaultOptions allocator;
    for (std::size_t i = 0; i < session_.GetInputCount(); ++i) {
      const std::string name = session_.GetInputNameAllocated(i, allocator).get();
      const Ort::TypeInfo type = session_.GetInputTypeInfo(i);
      const bool is_tensor = type.GetONNXType() == ONNX_TYPE_TENSOR;
      const Extents extents = is_tensor ? type.GetTensorTypeAndShapeInfo().GetShape() : Extents();
      const auto element = is_tensor ? type.GetTensorTypeAndShapeInfo().GetElementType() : ONNXTensorElementDataType();
      const auto may_be = [&](std::size_t d, std::int64_t extent) { return extents[d] == extent || extents[d] < 0; };
      if (element == ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT && extents.size() == 4 && may_be(0, 1) && may_be(1, 3) &&
          input_names_.empty()) {
        input_names_.push_back(name);
        const auto extent = [&](std::size_t d) { return extents[d] < 0 ? 0 : static_cast<int>(extents[d]); };
        size = {extent(3), extent(2)};
      } else if (element == ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64 && extents.size() == 2 && may_be(0, 1) &&
                 may_be(1, 2) && size_name.empty()) {
        size_name = name;
      } else {
        throw Error("found the input '" + name + "' (" + describe(element) + " " + describe(extents) +
                    "), expected an image (float 1x3xHxW) and perhaps its size (int64 1x2)");
      }
    }
    if (input_names_.empty()) throw Error("found no input for an image, expected float 1x3xHxW");
    if (!size_name.empty()) input_names_.push_back(size_name);
    return size;
  }

  void choose_outputs(const std::vector<std::string>& wanted) {
    std::vector<std::string> available;
    Ort::AllocatorWithDefaultOptions allocator;
    for (std::size_t i = 0; i < session_.GetOutputCount(); ++i)
      available.emplace_back(session_.GetOutputNameAllocated(i, allocator).get());
    for (const std::string& name : wanted) {
      if (std::find(available.begin(), available.end(), name) != available.end()) continue;
      std::string message = "found no output '" + name + "', expected one of";
      for (const std::string& other : available) message.append(&other == &available[0] ? " " : ", ").append(other);
      throw Error(message);
    }
    output_names_ = wanted.empty() ? available : wanted;
    converted_.resize(output_names_.size());
  }

  void run(const std::vector<float>& values, const InputSize& size) {
    const std::array<std::int64_t, 4> extents = {1, 3, size.height, size.width};
    const std::array<std::int64_t, 2> size_extents = {1, 2};
    std::array<std::int64_t, 2> width_and_height = {size.width, size.height};
    const Ort::MemoryInfo memory = Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault);
    std::vector<Ort::Value> inputs;
    inputs.push_back(Ort::Value::CreateTensor<float>(memory, const_cast<float*>(values.data()), values.size(),
                                                     extents.data(), extents.size()));
    if (input_names_.size() > 1)
      inputs.push_back(Ort::Value::CreateTensor<std::int64_t>(memory, width_and_height.data(), width_and_height.size(),
                                                              size_extents.data(), size_extents.size()));
    const auto input_names = pointers(input_names_), output_names = pointers(output_names_);
    results_ = session_.Run(Ort::RunOptions{nullptr}, input_names.data(), inputs.data(), inputs.size(),
                            output_names.data(), output_names.size());
    tensors_.clear();
    for (std::size_t i = 0; i < results_.size(); ++i) tensors_.push_back(tensor(i));
  }

  Tensor tensor(std::size_t index) {
    const Ort::Value& result = results_[index];
    if (!result.IsTensor()) throw Error("found the output '" + output_names_[index] + "', which is no tensor");
    const auto info = result.GetTensorTypeAndShapeInfo();
    std::vector<int> extents;
    for (const std::int64_t extent : info.GetShape()) extents.push_back(static_cast<int>(extent));
    const TensorShape shape(extents);
    const auto converted = [&](const auto* values) {
      converted_[index].resize(shape.count());
      std::transform(values, values + shape.count(), converted_[index].begin(),
                     [](auto value) { return static_cast<float>(value); });
      return Tensor{shape, converted_[index].data(), true};
    };
    switch (info.GetElementType()) {
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT: return {shape, result.GetTensorData<float>(), false};
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64: return converted(result.GetTensorData<std::int64_t>());
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT32: return converted(result.GetTensorData<std::int32_t>());
      default:
        throw Error("found the output '" + output_names_[index] + "' of " + describe(info.GetElementType()) +
                    ", expected float, int32 or int64");
    }
  }

  static std::vector<const char*> pointers(const std::vector<std::string>& names) {
    std::vector<const char*> result(names.size());
    std::transform(names.begin(), names.end(), result.begin(), [](const std::string& name) { return name.c_str(); });
    return result;
  }
  static std::string describe(ONNXTensorElementDataType type) {
    switch (type) {
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT: return "float";
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT16: return "float16";
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT32: return "int32";
      case ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64: return "int64";
      default: return "ONNX's type " + std::to_string(static_cast<int>(type));
    }
  }
  static std::string describe(const Extents& extents) {
    std::string text;
    for (const std::int64_t extent : extents)
      text.append(text.empty() ? "" : "x").append(extent < 0 ? "?" : std::to_string(extent));
    return text.empty() ? "scalar" : text;
  }

  /// ONNX Runtime's exceptions as ours, on one line, and the file's name before ours.
  template <class Action>
  void guarded(const char* what, Action&& action) const {
    try {
      action();
    } catch (const Error& error) {
      throw Error(name_ + ": " + error.what());
    } catch (const std::exception& exception) {
      std::string reason = exception.what();
      std::replace(reason.begin(), reason.end(), '\n', ' ');
      throw Error(name_ + ": ONNX Runtime " + library_version() + " cannot " + what + " this network: " + reason);
    }
  }

  std::string name_;
  Ort::Env environment_{nullptr};
  Ort::Session session_{nullptr};
  std::vector<std::string> input_names_, output_names_;
  std::vector<Ort::Value> results_;
  std::vector<std::vector<float>> converted_;  ///< of the outputs that are integers
  std::vector<Tensor> tensors_;
  NetworkDecoder decoder_;
  NetworkInput input_;
  float highest_overlap_;
  std::vector<RawDetection> found_;
};

}  // namespace stillpoint
