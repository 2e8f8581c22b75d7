// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Binary descriptors of ORB.

#include <opencv2/core/hal/hal.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace examples::slam {

constexpr int kDescriptorBytes = 32;
constexpr int kDescriptorBits = 8 * kDescriptorBytes;

using Descriptor = std::array<std::uint8_t, kDescriptorBytes>;

/// In how many bits two descriptors differ. Two of one corner rarely differ in more than 50 of the 256.
inline int distance_bits(const std::uint8_t* a, const std::uint8_t* b) {
  return cv::hal::normHamming(a, b, kDescriptorBytes);
}

inline Descriptor descriptor_from(const std::uint8_t* row) {
  Descriptor descriptor;
  std::copy_n(row, kDescriptorBytes, descriptor.begin());
  return descriptor;
}

}  // namespace examples::slam
