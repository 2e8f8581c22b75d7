// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Which feature is most like another, by ORB's binary descriptors?

#include <opencv2/core/hal/hal.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "spread_orb.hpp"

namespace examples {

constexpr int kDescriptorBytes = 32;
constexpr int kDescriptorBits = 8 * kDescriptorBytes;

/// In how many bits two descriptors differ. Two of one corner rarely differ in more than 50 of the 256.
inline int distance_bits(const std::uint8_t* a, const std::uint8_t* b) {
  return cv::hal::normHamming(a, b, kDescriptorBytes);
}

/// The best of those that were compared, and its rival.
class DescriptorMatch {
 public:
  int feature = -1;            ///< the best; -1: none yet
  int bits = kDescriptorBits;  ///< in which it differs

  /// @param other_octave  of the pyramid, below SpreadOrb::kLevels
  void compare(int other, int other_octave, int other_bits) {
    Octave& octave = octaves_[static_cast<std::size_t>(other_octave)];
    octave.second_bits = std::min(octave.second_bits, std::max(octave.bits, other_bits));
    octave.bits = std::min(octave.bits, other_bits);
    if (other_bits >= bits) return;
    feature = other;
    bits = other_bits;
    octave_ = other_octave;
  }

  /// Of the second best. Neighbouring octaves hold the same corner: only one of the best's own octave is a rival.
  int second_bits() const { return octaves_[static_cast<std::size_t>(octave_)].second_bits; }

 private:
  struct Octave {
    int bits = kDescriptorBits, second_bits = kDescriptorBits;
  };
  std::array<Octave, SpreadOrb::kLevels> octaves_;
  int octave_ = 0;
};

}  // namespace examples
