// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which feature is most like another, by ORB's binary descriptors?

#include <opencv2/core/hal/hal.hpp>

#include <cstdint>

namespace examples {

constexpr int kDescriptorBytes = 32;
constexpr int kDescriptorBits = 8 * kDescriptorBytes;

/// In how many bits two descriptors differ. Two of one corner rarely differ in more than 50 of the 256.
inline int distance_bits(const std::uint8_t* a, const std::uint8_t* b) {
  return cv::hal::normHamming(a, b, kDescriptorBytes);
}

/// The best and the second best of those that were compared.
struct DescriptorMatch {
  int feature = -1;  ///< -1: none yet
  int bits = kDescriptorBits, second_bits = kDescriptorBits;
  int octave = -1;

  void compare(int other, int other_octave, int other_bits) {
    if (other_bits < bits) {
      // Neighbouring octaves hold the same corner: only one of the best's own octave is a rival.
      second_bits = octave == other_octave ? bits : kDescriptorBits;
      feature = other;
      bits = other_bits;
      octave = other_octave;
    } else if (other_bits < second_bits && other_octave == octave) {
      second_bits = other_bits;
    }
  }
};

}  // namespace examples
