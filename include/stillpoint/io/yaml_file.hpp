// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A YAML file as OpenCV's FileStorage reads it, with errors that name file and field.

#include <opencv2/core/persistence.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

#include "stillpoint/core/error.hpp"

namespace stillpoint {

/// The fields of one file, each checked on the way out. Every member throws `Error` where a field is not as expected.
class YamlFile {
 public:
  /// @throws Error if there is no such file, or it is none that FileStorage reads.
  explicit YamlFile(const std::filesystem::path& file) : file_(file.string()) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) throw Error(file_ + ": no such file");
    if (!std::filesystem::is_regular_file(file, ignored)) throw Error(file_ + ": expected a file");
    try {
      if (storage_.open(file_, cv::FileStorage::READ)) return;
    } catch (const cv::Exception& error) {
      throw Error(file_ + ": " + error.err +
                  ", expected YAML as OpenCV's FileStorage writes it, beginning with %YAML:1.0");
    }
    throw Error(file_ + ": cannot be read");
  }

  cv::FileNode root() const { return storage_.root(); }
  bool has(const char* field) const { return !storage_[field].empty(); }

  /// A finite number.
  double number(const char* field, const char* expected) const {
    const cv::FileNode node = storage_[field];
    if (node.empty()) fail(field, "is missing", expected);
    if (!node.isReal() && !node.isInt()) fail(field, "is not a number", expected);
    const double value = node.real();
    if (!std::isfinite(value)) fail(field, "is not finite", expected);
    return value;
  }

  double positive(const char* field, const char* expected) const {
    const double value = number(field, expected);
    if (!(value > 0)) fail(field, "is " + std::to_string(value), expected);
    return value;
  }

  /// A width or height.
  int size(const char* field) const {
    constexpr double kLargest = 65535;  // what PNG and JPEG can hold, too
    const char* const expected = "a whole number of pixels from 1 to 65535";
    const double value = positive(field, expected);
    if (!(value <= kLargest) || value != std::floor(value)) fail(field, "is " + std::to_string(value), expected);
    return static_cast<int>(value);
  }

  std::string text(const char* field, const char* expected) const {
    const cv::FileNode node = storage_[field];
    if (!node.isString()) fail(field, "is not a word", expected);
    return node.string();
  }

  [[noreturn]] void fail(const std::string& field, const std::string& found, const std::string& expected) const {
    throw Error(file_ + ": " + field + " " + found + ", expected " + expected);
  }

 private:
  std::string file_;
  cv::FileStorage storage_;
};

}  // namespace stillpoint
