// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The frame rate that a caller gives to images without times of their own.

#include <cmath>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/options.hpp"

namespace stillpoint::detail {

/// @throws Error if the rate is not positive and finite: times by an infinite one would not rise.
inline void require_frame_rate(double rate_hz) {
  if (!(rate_hz > 0 && std::isfinite(rate_hz)))
    throw Error("frame rate: found " + option_text(rate_hz) + ", expected a positive number of images per second");
}

}  // namespace stillpoint::detail
