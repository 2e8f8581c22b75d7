// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The paper remembers nothing: each frame is judged by itself.

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/workspace.hpp"

namespace stillpoint {

/// The null memory.
struct NoMemory {
  using Needs = Capabilities<capability::verdicts>;

  void update(const Observations&, const Motion&, const Evidence&, span<Label>, Workspace&) const noexcept {}
  void reset() noexcept {}
};

}  // namespace stillpoint
