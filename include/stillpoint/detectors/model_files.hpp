// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The files that make up a model: many formats keep weights and structure apart.

#include <array>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/regular_file.hpp"

namespace stillpoint {

/// What `cv::dnn::readNet` takes.
struct ModelFiles {
  std::filesystem::path model;
  std::filesystem::path config;  ///< empty where there is none
};

/// Either of two files may be given; the other is looked for beside it, under the same name: .weights and .cfg
/// (Darknet), .caffemodel and .prototxt (Caffe), .bin and .xml (OpenVINO), .pb and .pbtxt (TensorFlow, where the second
/// is optional). .onnx is one file.
/// @throws Error naming the file that is not there or is none, or an ending that is not known.
inline ModelFiles find_model_files(const std::filesystem::path& file, std::filesystem::path config = {}) {
  detail::require_regular_file(file, "a model");
  const std::string ending = file.extension().string();
  constexpr std::array<std::pair<const char*, const char*>, 4> kPairs = {
      {{".weights", ".cfg"}, {".caffemodel", ".prototxt"}, {".bin", ".xml"}, {".pb", ".pbtxt"}}};
  for (const auto& [weights, structure] : kPairs) {
    if (ending != weights && ending != structure) continue;
    const bool optional = ending == std::string(".pb");
    if (config.empty()) {
      config = file;
      config.replace_extension(ending == weights ? structure : weights);
      std::error_code ignored;
      if (optional && !std::filesystem::exists(config, ignored)) return {file, {}};
    }
    detail::require_regular_file(config, "a model");
    return ending == weights ? ModelFiles{file, config} : ModelFiles{config, file};
  }
  if (ending != ".onnx")
    throw Error(file.string() + ": found the ending '" + ending +
                "', expected .onnx, .weights, .cfg, .pb, .pbtxt, .caffemodel, .prototxt, .xml or .bin");
  return {file, {}};
}

}  // namespace stillpoint
