// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A YAML file of named fields, with errors that name file, line and field.

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/regular_file.hpp"
#include "stillpoint/io/yaml_tree.hpp"

namespace stillpoint {

/// The fields of one file, each checked on the way out. Every member throws `Error` where a field is not as expected.
/// Read are YAML 1.2 and what OpenCV's FileStorage writes.
class YamlFile {
 public:
  static constexpr std::size_t kLargestBytes = 1000000;

  /// @throws Error if there is no such file, or it is no YAML of at most `kLargestBytes`, 32 maps and lists deep.
  explicit YamlFile(const std::filesystem::path& file) : file_(file.string()), root_(parse_yaml(file_, read(file))) {}

  /// A map, or nothing where the file is empty.
  const YamlNode& root() const noexcept { return root_; }
  /// Null where there is none.
  const YamlNode* find(const char* field) const noexcept { return root_.find(field); }
  bool has(const char* field) const noexcept { return find(field) != nullptr; }

  /// A finite number.
  double number(const char* field, const char* expected) const {
    const YamlNode* const node = find(field);
    if (node == nullptr) fail(field, "is missing", expected);
    return finite(*node, field, expected);
  }
  /// @param name  of the node, for the message
  double finite(const YamlNode& node, const std::string& name, const std::string& expected) const {
    const std::optional<double> value = node.number();
    if (!value) fail(node, name, is_what(node), expected);
    if (!std::isfinite(*value)) fail(node, name, "is not finite", expected);
    return *value;
  }

  double positive(const char* field, const char* expected) const {
    const double value = number(field, expected);
    if (!(value > 0)) fail(field, "is " + option_text(value), expected);
    return value;
  }

  /// A width or height.
  int size(const char* field) const {
    constexpr double kLargest = 65535;  // what PNG and JPEG can hold, too
    const char* const expected = "a whole number of pixels from 1 to 65535";
    const double value = positive(field, expected);
    if (!(value <= kLargest) || value != std::floor(value)) fail(field, "is " + option_text(value), expected);
    return static_cast<int>(value);
  }

  std::string text(const char* field, const char* expected) const {
    const YamlNode* const node = find(field);
    const bool is_word = node != nullptr && node->kind == YamlNode::Kind::scalar && !node->number();
    if (!is_word) fail(field, "is not a word", expected);
    return node->text;
  }

  /// @param field  of the file's map; the message names its line if it is there
  [[noreturn]] void fail(const std::string& field, const std::string& found, const std::string& expected) const {
    const YamlNode* const node = root_.find(field);
    fail(node != nullptr ? *node : YamlNode{}, field, found, expected);
  }
  [[noreturn]] void fail(const YamlNode& node, const std::string& name, const std::string& found,
                         const std::string& expected) const {
    const std::string line = node.line > 0 ? ':' + std::to_string(node.line) : std::string();
    throw Error(file_ + line + ": " + name + ' ' + found + ", expected " + expected);
  }

 private:
  /// What is there in place of a number.
  static std::string is_what(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::list) return "is a list";
    if (node.kind == YamlNode::Kind::map) return "is a map";
    if (node.text.empty()) return "is empty";
    return node.is_quoted ? "is \"" + node.text + "\", in quotes" : "is '" + node.text + "'";
  }

  static std::string read(const std::filesystem::path& file) {
    detail::require_regular_file(file, "a file");
    std::ifstream stream(file, std::ios::binary);
    std::string text(kLargestBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad() || !stream.is_open()) throw Error(file.string() + ": cannot be read");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestBytes)
      throw Error(file.string() + ": is too large, expected at most " + std::to_string(kLargestBytes) + " bytes");
    return text;
  }

  std::string file_;
  YamlNode root_;
};

}  // namespace stillpoint
