// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The arguments are in another order.
// expected: stillpoint: Policies::Classifier must offer void classify(const Observations&, const Evidence&, span<Label>, Workspace&); see cluster/region_clusters.hpp

#include "sound_policies.hpp"

struct ShuffledClassifier {
  void classify(const stillpoint::Evidence&, const stillpoint::Observations&, stillpoint::span<stillpoint::Label>,
                stillpoint::Workspace&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using Classifier = ShuffledClassifier;
#endif
};

template void use<Policies>(const Policies::Camera&);
