// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The paper culls every dynamic feature, whatever is left.

#include <cstddef>

#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The null keep-floor.
struct NoKeepFloor {
  std::size_t apply(span<const Vector2f>, const ImageView&, span<Label>, Workspace&) const noexcept { return 0; }
};

}  // namespace stillpoint
