// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// stillpoint_slam_time SEQUENCE: tracking with the filter and the SLAM of examples/slam beside cv::ORB (1000) on the
// same frames, run in turn. Tracking is all that the caller waits for: corners, filter, pose; mapping has a thread of
// its own. Prints the 95th percentiles and their ratio: of the processor time of the caller's thread, which another
// load hardly changes, and of the clock, which also has what it waits for the map. OpenCV has one thread.

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "quantiles.hpp"
#include "slam/slam.hpp"
#include "stillpoint/compiled.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/opencv.hpp"
#include "thread_time.hpp"

namespace stillpoint::bench {
namespace {

struct Milliseconds {
  std::vector<double> of_thread, of_clock;
};

template <class Function>
void measure(Milliseconds& times, Function&& function) {
  const double thread_start_ms = thread_ms();
  const auto start = std::chrono::steady_clock::now();
  function();
  times.of_clock.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  times.of_thread.push_back(thread_ms() - thread_start_ms);
}

void print(const char* what, const std::vector<double>& slam_ms, const std::vector<double>& orb_ms) {
  const double slam = percentile_95(slam_ms).value(), orb = percentile_95(orb_ms).value();
  std::printf("%s: tracking %.1f ms, cv::ORB(1000) %.1f ms, ratio %.2f\n", what, slam, orb, slam / orb);
}

void run(const char* folder) {
  cv::setNumThreads(1);
  TumSequence sequence(folder, std::nullopt);
  FilteredTracker tracker(FrameFilter<>(sequence.camera()),
                          examples::slam::Slam(sequence.camera(), examples::slam::SlamOptions{}));
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000);
  Milliseconds of_slam, of_orb;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const auto images = sequence.load(i);
    cv::Mat gray;
    cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
    FrameView frame(gray, DepthView(images.depth, sequence.depth_factor()), sequence.frames()[i].timestamp_s);
    measure(of_orb, [&] {
      std::vector<cv::KeyPoint> keypoints;
      cv::Mat descriptors;
      orb->detectAndCompute(gray, cv::noArray(), keypoints, descriptors);
    });
    measure(of_slam, [&] { tracker.track(frame); });
  }
  std::printf("%s: %zu frames, 95th percentiles\n", folder, sequence.frames().size());
  print("processor time of the thread", of_slam.of_thread, of_orb.of_thread);
  print("clock", of_slam.of_clock, of_orb.of_clock);
}

}  // namespace
}  // namespace stillpoint::bench

int main(int count, char** arguments) {
  try {
    if (count != 2) {
      std::fputs("usage: stillpoint_slam_time SEQUENCE\n", stderr);
      return 2;
    }
    stillpoint::bench::run(arguments[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stillpoint_slam_time: %s\n", error.what());
    return 2;
  }
}
