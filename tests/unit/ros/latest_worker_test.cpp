// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The newest jobs are done, in their order; none is done after the end.

#include "stillpoint_ros/latest_worker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <thread>
#include <vector>

namespace stillpoint_ros::latest_worker_test {

/// Does jobs when it is told to.
struct Held {
  std::promise<void> begun, may_end;
  std::promise<void> all_done;
  std::vector<int> done;

  void work(int job) {
    if (done.empty()) {
      begun.set_value();
      may_end.get_future().wait();
    }
    done.push_back(job);
    if (job == kLast) all_done.set_value();
  }
  static constexpr int kLast = 9;
};

TEST(LatestWorker, LeavesTheOldestOutWhenItIsLate) {
  for (const std::size_t longest_queue : {1u, 3u}) {
    Held held;
    LatestWorker<int> worker([&held](int& job) { held.work(job); }, longest_queue);
    worker.submit(0);
    held.begun.get_future().wait();
    for (int job = 1; job <= Held::kLast; ++job) worker.submit(job);
    held.may_end.set_value();
    held.all_done.get_future().wait();
    EXPECT_EQ(held.done, longest_queue == 1 ? (std::vector<int>{0, 9}) : (std::vector<int>{0, 7, 8, 9}));
    EXPECT_EQ(worker.left_out(), 9 - longest_queue);
  }
}

TEST(LatestWorker, EndsAfterTheJobAtHand) {
  std::promise<void> begun;
  std::vector<int> done;
  {
    LatestWorker<int> worker(
        [&](int& job) {
          if (done.empty()) {
            begun.set_value();
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
          }
          done.push_back(job);
        },
        5);
    worker.submit(1);
    begun.get_future().wait();
    worker.submit(2);  // both wait while the first is done, and after it nothing is
    worker.submit(3);
  }
  EXPECT_EQ(done, std::vector<int>{1});
}

}  // namespace stillpoint_ros::latest_worker_test
