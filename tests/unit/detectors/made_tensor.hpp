// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#pragma once

// Outputs of networks, made by hand.

#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "stillpoint/detectors/raw_detection.hpp"
#include "stillpoint/detectors/tensor.hpp"
#include "unit/error_of.hpp"

namespace stillpoint {

/// A tensor that owns its numbers.
struct MadeTensor {
  TensorShape shape;
  std::vector<float> values;
  bool whole_numbers = false;

  explicit MadeTensor(const TensorShape& extents, float filling = 0.0f)
      : shape(extents), values(extents.count(), filling) {}

  float& at(std::initializer_list<int> index) {
    std::size_t offset = 0;
    int dimension = 0;
    for (const int i : index)
      offset = offset * static_cast<std::size_t>(shape[dimension++]) + static_cast<std::size_t>(i);
    return values.at(offset);
  }
  /// Writes a run of numbers from an index on.
  void write(std::initializer_list<int> index, std::initializer_list<float> run) {
    float* to = &at(index);
    for (const float value : run) *to++ = value;
  }
  Tensor view() const { return {shape, values.data(), whole_numbers}; }
};

template <class... Made>
std::vector<Tensor> views(const Made&... tensors) {
  return {tensors.view()...};
}

constexpr float kPixelTolerance = 1e-3f;  // float arithmetic on numbers below a thousand

inline void expect_box(const RawDetection& found, float left, float top, float right, float bottom) {
  EXPECT_NEAR(found.left, left, kPixelTolerance);
  EXPECT_NEAR(found.top, top, kPixelTolerance);
  EXPECT_NEAR(found.right, right, kPixelTolerance);
  EXPECT_NEAR(found.bottom, bottom, kPixelTolerance);
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), text.npos) << "expected '" << part << "' in: " << text;
}

}  // namespace stillpoint
