// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A policy set that inherits from none and forgets the gate.
// expected: stillpoint: Policies must name a type for each of Camera, DepthNoise, DepthLookup, Prior, Matcher, EgoMotion, Scorer, Gate, Classifier, Memory and KeepFloor; inherit from DefaultPolicies and name what is yours; see policies.hpp

#include "sound_policies.hpp"

struct Policies {
  using Camera = SoundPolicies::Camera;
  using DepthNoise = SoundPolicies::DepthNoise;
  using DepthLookup = SoundPolicies::DepthLookup;
  using Prior = SoundPolicies::Prior;
  using Matcher = SoundPolicies::Matcher;
  using EgoMotion = SoundPolicies::EgoMotion;
  using Scorer = SoundPolicies::Scorer;
#ifndef STILLPOINT_MISTAKE
  using Gate = SoundPolicies::Gate;
#endif
  using Classifier = SoundPolicies::Classifier;
  using Memory = SoundPolicies::Memory;
  using KeepFloor = SoundPolicies::KeepFloor;
  static constexpr std::size_t kHistoryLength = 1;
};

template void use<Policies>(const Policies::Camera&);
