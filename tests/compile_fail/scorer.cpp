// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Plain numbers instead of scores.
// expected: stillpoint: Policies::Scorer must offer void score(const Observations&, const Motion&, const Camera&, span<FeatureScore>); see score/offset_score.hpp

#include "sound_policies.hpp"

struct PlainNumbers {
  void score(const stillpoint::Observations&, const stillpoint::Motion&, const stillpoint::Camera&,
             stillpoint::span<double>) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Scorer = PlainNumbers;
#endif
};

template void use<Policies>(const Policies::Camera&);
