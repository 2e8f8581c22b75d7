// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The corrections of the paper's method in `DefaultPolicies`, each of which can be switched off to see what it is
// worth: their names. switch_off.hpp does it.

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint_run {

/// One choice of the paper that `DefaultPolicies` makes otherwise.
struct Correction {
  const char* name;  ///< for the command line
  const char* then;  ///< what the filter does without it
};

inline constexpr std::array<Correction, 15> kCorrections = {{
    {"whitened", "offsets in radians and metres, Eq. 9, in place of likelihoods"},
    {"calibrated", "the level is the mean score of the static features, Eq. 10"},
    {"measured-noise", "matches support a motion within 0.1 px, not within the noise"},
    {"own-noise", "pixel and depth noise as assumed, not as found in the frame; the gate does not learn"},
    {"stationary-camera", "a stationary camera is estimated like any other"},
    {"clusters", "a tenth as many clusters as features, undivided, that decide alone"},
    {"all-features", "only features in boxes of moving classes are tested"},
    {"older-frames", "features are looked for in the last frame alone"},
    {"memory", "each frame is judged by itself; no dynamic prior either"},
    {"lost-features", "what no longer looks alike is no evidence"},
    {"past-hypothesis", "the motion is that with the most support, whatever went before"},
    {"inertia", "the motion is what was measured, whatever the velocity was"},
    {"area-support", "the host's keypoints support the motion, not corners and surfaces by area"},
    {"depth-guard", "depth at the rounded pixel, edges and holes or not"},
    {"keep-floor", "all dynamic features are dropped, whatever is left"},
}};

/// Those that are switched off.
struct Without {
  std::vector<std::string> names;
  bool operator()(std::string_view name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

  /// True where options of `DefaultPolicies` do not do: `SwitchedPolicies` is needed.
  bool needs_other_stages() const {
    return (*this)("whitened") || (*this)("calibrated") || (*this)("all-features") || (*this)("area-support") ||
           (*this)("depth-guard");
  }
};

}  // namespace stillpoint_run
