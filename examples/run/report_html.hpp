// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// report.html: one file that needs no network. What happened first, then the frames, the plots beside them, tables.

#include <string>

#include "figures.hpp"
#include "options.hpp"
#include "picture_roll.hpp"
#include "stillpoint/core/camera.hpp"

namespace stillpoint_run {

/// The whole page.
std::string report_html(const Options& options, const RunRecord& run, const Figures& figures,
                        const stillpoint::Camera& camera, const PictureRoll& roll);

}  // namespace stillpoint_run
