// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The fuzzer's bytes as numbers. At their end, zeros.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : data_[at_++]; }
  bool flag() { return (byte() & 1) != 0; }

  /// From least to most, both included; a byte where that is enough, else four.
  int integer(int least, int most) {
    const auto range = static_cast<std::uint64_t>(static_cast<std::int64_t>(most) - least) + 1;
    std::uint64_t value = byte();
    for (int i = 0; i < 3 && range > 256; ++i) value = value << 8 | byte();
    return static_cast<int>(least + static_cast<std::int64_t>(value % range));
  }

  /// A usual number, or any bit pattern: NaN, infinity, the largest and the smallest.
  double number(double least, double most) {
    const int kind = byte();
    if (kind < 240) return least + (most - least) * integer(0, 65535) / 65535.0;
    constexpr double kOdd[] = {0.0,   -0.0,   1e-300,
                               1e308, -1e308, std::numeric_limits<double>::quiet_NaN(),
                               1e36,  -1e36,  std::numeric_limits<double>::infinity(),
                               1e10,  5e-324, -std::numeric_limits<double>::infinity()};
    if (kind < 240 + 12) return kOdd[kind - 240];
    double value = 0;
    std::uint8_t bits[sizeof value];
    for (std::uint8_t& b : bits) b = byte();
    std::memcpy(&value, bits, sizeof value);
    return value;
  }
  float single(double least, double most) {
    const double value = number(least, most);
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (value > kLargest) return std::numeric_limits<float>::infinity();  // out of range a cast is undefined
    if (value < -kLargest) return -std::numeric_limits<float>::infinity();
    return static_cast<float>(value);
  }

  /// All that is left.
  std::string rest() {
    std::string text(reinterpret_cast<const char*>(data_) + at_, size_ - at_);
    at_ = size_;
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// What must hold of an answer; said so that the fuzzer keeps the input.
inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

}  // namespace fuzz
