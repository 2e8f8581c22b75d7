// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#pragma once

#include <utility>

#include "stillpoint/core/observations.hpp"

namespace stillpoint::test {

/// What a stage reads of these matches and regions when nothing is remembered: the static prior is that of free space.
inline Observations observations_of(Matches matches, Regions regions = {}) {
  Observations observations{std::move(matches), std::move(regions), {}};
  observations.remembered.begin(observations.matches);
  return observations;
}

}  // namespace stillpoint::test
