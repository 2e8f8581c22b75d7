// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The arguments are in another order.
// expected: stillpoint: Policies::Classifier must offer void classify(const Matches&, span<const FeatureScore>, const Threshold&, const Regions&, span<Label>, Workspace&); see cluster/region_clusters.hpp

#include "sound_policies.hpp"

struct ShuffledClassifier {
  void classify(const stillpoint::Threshold&, const stillpoint::Matches&,
                stillpoint::span<const stillpoint::FeatureScore>, const stillpoint::Regions&,
                stillpoint::span<stillpoint::Label>, stillpoint::Workspace&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Classifier = ShuffledClassifier;
#endif
};

template void use<Policies>(const Policies::Camera&);
