// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The member is called otherwise.
// expected: stillpoint: Policies::DepthNoise must offer double sigma(double depth_m) const; see depth/depth_noise.hpp

#include "sound_policies.hpp"

struct StandardDeviation {
  double standard_deviation(double depth_m) const { return 0.01 * depth_m; }
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using DepthNoise = StandardDeviation;
#endif
};

template void use<Policies>(const Policies::Camera&);
