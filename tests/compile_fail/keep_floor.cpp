// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A keep-floor that does not say how many it kept.
// expected: stillpoint: Policies::KeepFloor must offer std::size_t apply(span<const Vector2f> pixels, const ImageView&, span<Label>, Workspace&); see verdict/keep_floor.hpp

#include "sound_policies.hpp"

struct SilentKeepFloor {
  void apply(stillpoint::span<const stillpoint::Vector2f>, const stillpoint::ImageView&,
             stillpoint::span<stillpoint::Label>, stillpoint::Workspace&) const {}
};

struct Policies : SoundPolicies {
#ifdef STILLPOINT_MISTAKE
  using KeepFloor = SilentKeepFloor;
#endif
};

template void use<Policies>(const Policies::Camera&);
