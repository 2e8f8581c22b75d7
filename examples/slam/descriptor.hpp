// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A descriptor of ORB that is kept.

#include <algorithm>
#include <array>
#include <cstdint>

#include "../backends/descriptor_match.hpp"

namespace examples::slam {

using Descriptor = std::array<std::uint8_t, kDescriptorBytes>;

inline Descriptor descriptor_from(const std::uint8_t* row) {
  Descriptor descriptor;
  std::copy_n(row, kDescriptorBytes, descriptor.begin());
  return descriptor;
}

}  // namespace examples::slam
