// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// An output of a network, whichever library ran it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// Extents of a tensor, outermost first. Ones are kept: the rank tells layouts apart.
class TensorShape {
 public:
  static constexpr int kHighestRank = 6;

  TensorShape() = default;
  TensorShape(std::initializer_list<int> extents) : TensorShape(span<const int>(extents.begin(), extents.size())) {}
  /// @throws Error with more than `kHighestRank` extents, a negative one, or more elements than an int counts: whoever
  ///         walks through a tensor may do it with an int.
  explicit TensorShape(span<const int> extents) {
    if (extents.size() > kHighestRank)
      throw Error("an output of the network has " + std::to_string(extents.size()) + " dimensions, expected at most " +
                  std::to_string(kHighestRank));
    std::copy(extents.begin(), extents.end(), extents_.begin());
    rank_ = static_cast<int>(extents.size());
    double elements = 1;
    for (const int extent : extents) elements *= extent < 0 ? std::numeric_limits<double>::infinity() : extent;
    if (!(elements <= std::numeric_limits<int>::max()))
      throw Error("an output of the network has the shape " + text() + ", expected extents from 0 on and at most " +
                  std::to_string(std::numeric_limits<int>::max()) + " elements");
  }

  int rank() const noexcept { return rank_; }
  int operator[](int dimension) const noexcept { return extents_[static_cast<std::size_t>(dimension)]; }
  /// The innermost extent, 0 for a scalar.
  int last() const noexcept { return rank_ == 0 ? 0 : (*this)[rank_ - 1]; }

  /// Number of elements.
  std::size_t count() const noexcept {
    std::size_t product = 1;
    for (int d = 0; d < rank_; ++d) product *= static_cast<std::size_t>((*this)[d]);
    return product;
  }

  /// "1x84x8400".
  std::string text() const {
    std::string result;
    for (int d = 0; d < rank_; ++d) result += (d == 0 ? "" : "x") + std::to_string((*this)[d]);
    return rank_ == 0 ? "scalar" : result;
  }

 private:
  std::array<int, kHighestRank> extents_{};
  int rank_ = 0;
};

/// Elements that belong to the library which ran the network: row-major, without gaps.
struct Tensor {
  TensorShape shape;
  const float* data = nullptr;
  bool whole_numbers = false;  ///< labels: were integers before they were converted
};

/// "1x100x80, 1x100x4 (integers)", for messages.
inline std::string describe(span<const Tensor> outputs) {
  std::string text;
  for (const Tensor& output : outputs)
    text += (text.empty() ? "" : ", ") + output.shape.text() + (output.whole_numbers ? " (integers)" : "");
  return text.empty() ? "no output" : text;
}

}  // namespace stillpoint
