// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How large an image does a network want? Its file says so, but OpenCV does not hand it on.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/detectors/raw_detection.hpp"

namespace stillpoint {

namespace detail {

/// One field after another of a message in protobuf's encoding (protobuf.dev, "Encoding"), of those that ONNX uses.
class ProtobufFields {
 public:
  ProtobufFields(std::ifstream& file, std::int64_t begin, std::int64_t end)
      : file_(file), at_(begin), next_(begin), end_(end) {}

  int number = 0;                      ///< of the field
  std::uint64_t value = 0;             ///< if it is an integer …
  std::int64_t content = 0, size = 0;  ///< … else where its bytes are

  /// False at the end, and where the file is broken: what follows is for the library that runs it to complain about.
  bool next() {
    at_ = next_;
    if (at_ >= end_) return false;
    file_.clear();
    file_.seekg(at_);
    std::uint64_t key = 0;
    if (!varint(key)) return false;
    number = static_cast<int>(key >> 3);
    value = 0;
    content = at_;
    size = 0;
    switch (key & 7) {
      case 0: return varint(value) && advance(0);
      case 1: return advance(8);
      case 2: {
        std::uint64_t length = 0;
        if (!varint(length) || length > static_cast<std::uint64_t>(end_ - at_)) return false;
        content = at_;
        size = static_cast<std::int64_t>(length);
        return advance(size);
      }
      case 5: return advance(4);
      default: return false;
    }
  }

  ProtobufFields message() const { return {file_, content, content + size}; }
  std::string text() const {
    std::string result(static_cast<std::size_t>(size), '\0');
    file_.clear();
    file_.seekg(content);
    file_.read(result.data(), size);
    return result;
  }

 private:
  bool varint(std::uint64_t& result) {
    result = 0;
    for (int shift = 0; shift < 64 && at_ < end_; shift += 7) {
      const int byte = file_.get();
      if (byte < 0) return false;
      ++at_;
      result |= static_cast<std::uint64_t>(byte & 127) << shift;
      if ((byte & 128) == 0) return true;
    }
    return false;
  }
  bool advance(std::int64_t bytes) {
    if (bytes > end_ - at_) return false;
    next_ = at_ + bytes;
    return true;
  }

  std::ifstream& file_;
  std::int64_t at_, next_, end_;
};

/// ValueInfoProto: name 1, type 2 { tensor 1 { shape 2 { dimension 1 { value 1 } } } }.
inline std::vector<int> onnx_shape(const ProtobufFields& value_info, std::string& name) {
  std::vector<int> shape;
  for (ProtobufFields info = value_info; info.next();) {
    if (info.number == 1) name = info.text();
    if (info.number != 2) continue;
    for (ProtobufFields type = info.message(); type.next();)
      for (ProtobufFields tensor = type.message(); type.number == 1 && tensor.next();)
        for (ProtobufFields dims = tensor.message(); tensor.number == 2 && dims.next();) {
          if (dims.number != 1) continue;
          shape.push_back(0);  // a dimension without a number is free
          for (ProtobufFields dim = dims.message(); dim.next();)
            if (dim.number == 1 && dim.value <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
              shape.back() = static_cast<int>(dim.value);
        }
  }
  return shape;
}

inline constexpr int kLargestInput_px = 8192;

/// Reads a line "width=320" or "height=192" without blanks, perhaps with a comment after it; leaves others alone.
/// @throws Error if it is no whole number that an int holds.
inline void read_darknet_size(const std::string& line, const std::string& name, const std::string& where, int& size) {
  if (line.compare(0, name.size() + 1, name + '=') != 0) return;
  const std::string value = line.substr(name.size() + 1, line.find('#') - name.size() - 1);
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, size);
  if (read.ec != std::errc() || read.ptr != end)
    throw Error(where + ": " + name + " is '" + value + "', expected a whole number of pixels from 1 to " +
                std::to_string(kLargestInput_px));
}

}  // namespace detail

/// Size of the first input 1x3xHxW of an ONNX file; one of a free number of images counts, weights do not (onnx.proto:
/// ModelProto.graph 7, GraphProto.input 11); zeros where the file leaves it free or is no such file.
inline InputSize onnx_input_size(const std::filesystem::path& file) {
  std::error_code error;
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) return {};
  for (detail::ProtobufFields model(stream, 0, bytes); model.next();) {
    if (model.number != 7) continue;
    for (detail::ProtobufFields graph = model.message(); graph.next();) {
      if (graph.number != 11) continue;
      std::string name;
      const std::vector<int> shape = detail::onnx_shape(graph.message(), name);
      if (shape.size() == 4 && shape[0] <= 1 && shape[1] == 3) return {shape[3], shape[2]};
    }
  }
  return {};
}

/// @throws Error naming the model, if neither its file nor the user has told a size, or it is absurd.
inline void require_input_size(const InputSize& size, const std::string& model) {
  constexpr int kLargest = detail::kLargestInput_px;
  if (size.width == 0 || size.height == 0)
    throw Error(model + ": the file does not say how large an input the network wants: set the input size");
  if (size.width < 1 || size.height < 1 || size.width > kLargest || size.height > kLargest)
    throw Error(model + ": found the input size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                ", expected 1 to " + std::to_string(kLargest) + " each");
}

/// `width` and `height` of a Darknet .cfg; zeros where it has none.
/// @throws Error naming the line whose width or height is no whole number.
inline InputSize darknet_input_size(const std::filesystem::path& file) {
  InputSize size;
  std::ifstream stream(file);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string where = file.string() + ':' + std::to_string(++number);
    std::string packed;
    for (const char c : line)
      if (c != ' ' && c != '\t' && c != '\r') packed += c;
    if (size.width == 0) detail::read_darknet_size(packed, "width", where, size.width);
    if (size.height == 0) detail::read_darknet_size(packed, "height", where, size.height);
    if (!packed.empty() && packed[0] == '[' && packed != "[net]" && packed != "[network]") break;
  }
  return size;
}

}  // namespace stillpoint
