// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A thread that works on the newest jobs: who is late leaves the oldest out, and is not late for ever.

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace stillpoint_ros {

/// Runs `work` for each job in its own thread, in their order. Jobs that wait longer than the queue is are left out.
template <class Job>
class LatestWorker {
 public:
  /// @param work           must not throw
  /// @param longest_queue  jobs that may wait while one is worked on; at least 1
  LatestWorker(std::function<void(Job&)> work, std::size_t longest_queue)
      : work_(std::move(work)), longest_queue_(std::max<std::size_t>(longest_queue, 1)), thread_([this] { run(); }) {}
  LatestWorker(const LatestWorker&) = delete;
  LatestWorker& operator=(const LatestWorker&) = delete;
  /// Waits for the job at hand; those in the queue are left out.
  ~LatestWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void submit(Job job) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      queue_.push_back(std::move(job));
      if (queue_.size() > longest_queue_) {
        queue_.pop_front();
        ++left_out_;
      }
    }
    changed_.notify_all();
  }

  /// Since the start.
  std::size_t left_out() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return left_out_;
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return is_ending_ || !queue_.empty(); });
      if (is_ending_) return;
      Job job = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      work_(job);
      lock.lock();
    }
  }

  std::function<void(Job&)> work_;
  std::size_t longest_queue_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> queue_;
  std::size_t left_out_ = 0;
  bool is_ending_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace stillpoint_ros
