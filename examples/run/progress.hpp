// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How far a run has come, on standard error.

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>

namespace stillpoint_run {

/// One line that is rewritten on a terminal; elsewhere a line now and then, so that a log stays short.
class Progress {
 public:
  /// @param total  frames; empty where only the end tells
  Progress(std::optional<std::size_t> total, bool quiet)
      : total_(total), quiet_(quiet), is_terminal_(isatty(STDERR_FILENO) != 0) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {  // what is printed next, an error too, begins on a line of its own
    if (line_is_open_) std::fputc('\n', stderr);
  }

  /// Call it once per frame, after the frame.
  void frame_done() {
    ++done_;
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> interval(is_terminal_ ? 0.2 : 10.0);
    if (done_ != total_ && now - last_shown_ < interval) return;
    last_shown_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double frames_per_s = elapsed_s > 0 ? static_cast<double>(done_) / elapsed_s : 0.0;
    const char *const begin = is_terminal_ ? "\r" : "", *const end = is_terminal_ ? "   " : "\n";
    if (total_) {
      const double left_s = frames_per_s > 0 ? static_cast<double>(*total_ - done_) / frames_per_s : 0.0;
      std::fprintf(stderr, "%sframe %zu of %zu, %.1f frames/s, %.0f s left%s", begin, done_, *total_, frames_per_s,
                   left_s, end);
    } else {
      std::fprintf(stderr, "%sframe %zu, %.1f frames/s, Ctrl-C ends it%s", begin, done_, frames_per_s, end);
    }
    line_is_open_ = is_terminal_;
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<std::size_t> total_;
  std::size_t done_ = 0;
  bool quiet_, is_terminal_, line_is_open_ = false;
  Clock::time_point start_ = Clock::now(), last_shown_ = start_;
};

}  // namespace stillpoint_run
