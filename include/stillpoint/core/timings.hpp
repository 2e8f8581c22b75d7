// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How long each stage took.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "stillpoint/core/needs_cpp17.hpp"

namespace stillpoint {

enum class Stage : std::uint8_t { prior, match, motion, score, gate, classify, memory, verdict, movers };
inline constexpr std::size_t kStageCount = 9;

constexpr const char* to_string(Stage stage) noexcept {
  constexpr const char* kNames[kStageCount] = {"prior",    "match",  "motion",  "score", "gate",
                                               "classify", "memory", "verdict", "movers"};
  return kNames[static_cast<std::size_t>(stage)];
}

/// Milliseconds a stage took in the last frame.
struct Timings {
  std::array<double, kStageCount> ms{};

  double operator[](Stage stage) const noexcept { return ms[static_cast<std::size_t>(stage)]; }
  double total_ms() const noexcept {
    double sum = 0;
    for (const double stage_ms : ms) sum += stage_ms;
    return sum;
  }

  /// Runs a stage and adds what it took.
  template <class Function>
  void run(Stage stage, Function&& function) {
    const auto start = std::chrono::steady_clock::now();
    function();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    ms[static_cast<std::size_t>(stage)] += elapsed.count();
  }
};

}  // namespace stillpoint
