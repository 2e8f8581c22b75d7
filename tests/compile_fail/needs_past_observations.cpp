// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A scorer of older frames behind a matcher that looks into one: it would find nothing, without a word.
// names: ReprojectionScore,TwoFrames
// expected: stillpoint: this Stage needs the features in older frames, where this Matcher does not look: take PatchMatcher or ProvidedMatches, or a stage that needs two frames (OffsetScore, SampsonScore); see docs/extending.md

#include "sound_policies.hpp"
#include "stillpoint/score/reprojection_score.hpp"

struct TwoFrames : stillpoint::ProvidedMatches {
  using Provides = stillpoint::Capabilities<stillpoint::capability::matches, stillpoint::capability::feature_matches>;
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Matcher = TwoFrames;
  using Scorer = stillpoint::ReprojectionScore;
#endif
};

template void use<Policies>(const Policies::Camera&);
