// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Frames as fast as the camera gave them: a detector in its own thread is as late as it would be on a robot.

#include <algorithm>
#include <chrono>
#include <thread>

namespace stillpoint_run {

/// Sleeps until a frame is due by its timestamp. Who is late does not sleep.
class FrameClock {
 public:
  void wait_for(double timestamp_s) {
    // A gap in a recording is not sat out.
    constexpr double kLongestStep_s = 1.0;
    if (is_running_) elapsed_s_ += std::clamp(timestamp_s - last_s_, 0.0, kLongestStep_s);
    if (!is_running_) start_ = Clock::now();
    is_running_ = true;
    last_s_ = timestamp_s;
    std::this_thread::sleep_until(
        start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(elapsed_s_)));
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_;
  double last_s_ = 0.0, elapsed_s_ = 0.0;
  bool is_running_ = false;
};

}  // namespace stillpoint_run
