// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The files of this folder as text; CMake writes the definitions.

namespace stillpoint_run {

extern const char* const kReportStyle;   ///< report.css
extern const char* const kReportScript;  ///< the .js files, one after the other

}  // namespace stillpoint_run
