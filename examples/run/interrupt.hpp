// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Ctrl-C, and a polite kill, end the run, not the program: what was found until then is written down.

#include <csignal>

namespace stillpoint_run {

namespace detail {

// A signal can't reach anything but a global.
inline volatile std::sig_atomic_t interrupted = 0;

}  // namespace detail

/// From here on the first Ctrl-C, SIGTERM or SIGHUP is remembered; the second one kills as usual.
inline void catch_interrupt() {
  struct sigaction action = {};
  action.sa_handler = [](int) { detail::interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // reading goes on: the frame is finished
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up = {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // under nohup it stays ignored
}

inline bool was_interrupted() { return detail::interrupted != 0; }

}  // namespace stillpoint_run
