// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Random numbers that are the same on every platform: generator and distributions are our own, because the
// distributions of <random> differ between standard libraries.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/span.hpp"

namespace stillpoint {

/// xoshiro256** (Blackman and Vigna, "Scrambled Linear Pseudorandom Number Generators", 2018), seeded by SplitMix64.
/// Equal seeds give equal sequences. 32 bytes of state; copying forks the sequence.
class Random {
 public:
  static constexpr std::uint64_t kDefaultSeed = 0x5711'1901'97u;

  explicit Random(std::uint64_t seed = kDefaultSeed) noexcept {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }

  /// Uniform over all 64-bit values.
  std::uint64_t bits() noexcept {
    const std::uint64_t result = rotate_left(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate_left(state_[3], 45);
    return result;
  }

  /// Uniform integer in [0, bound), without modulo bias: values of the incomplete last interval are drawn again.
  /// @param bound at least 1.
  std::size_t index(std::size_t bound) noexcept {
    const std::uint64_t wide_bound = bound;
    const std::uint64_t incomplete = (0 - wide_bound) % wide_bound;
    std::uint64_t draw = bits();
    while (draw < incomplete) draw = bits();
    const std::size_t drawn = draw % wide_bound;  // below `bound`: it fits
    return drawn;
  }

  /// Uniform in [0, 1), 53 random bits.
  double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }

  /// Normal with mean 0 and standard deviation 1 (Box and Muller, 1958; one of the pair is thrown away, so that the
  /// state is the generator's alone).
  double gaussian() noexcept {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }

  /// Fills `sample` with distinct indices of [0, population), each subset equally likely (Floyd, 1987).
  /// @param sample its size is at most `population`. Cost O(k²) for k = sample.size(): meant for minimal samples.
  void distinct(span<std::size_t> sample, std::size_t population) noexcept {
    const std::size_t k = sample.size();
    for (std::size_t i = 0; i < k; ++i) {
      const std::size_t last = population - k + i;
      const std::size_t draw = index(last + 1);
      bool taken = false;
      for (std::size_t j = 0; j < i; ++j) taken = taken || sample[j] == draw;
      sample[i] = taken ? last : draw;
    }
  }

 private:
  static std::uint64_t rotate_left(std::uint64_t x, int count) noexcept { return (x << count) | (x >> (64 - count)); }

  std::uint64_t state_[4] = {};
};

}  // namespace stillpoint
