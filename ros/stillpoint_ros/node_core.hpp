// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A whole node but for ROS itself: messages in, answers and a report out.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stillpoint/core/options.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/policies/default_policies.hpp"
#include "stillpoint_ros/frame_pairing.hpp"
#include "stillpoint_ros/input_watch.hpp"
#include "stillpoint_ros/latest_worker.hpp"
#include "stillpoint_ros/mask_session.hpp"
#include "stillpoint_ros/parameters.hpp"

namespace stillpoint_ros {

/// What diagnostics say, as diagnostic_msgs/DiagnosticStatus has it.
struct Report {
  enum Level : std::uint8_t { ok, warn, error };
  Level level = ok;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<std::string> missing;  ///< what keeps frames from being judged, one sentence each
  std::string hint;                  ///< the filter's last one since the last report; empty: none
};

/// Takes messages from any thread, judges frames in a thread of its own and hands the answers to `publish` there.
class NodeCore {
 public:
  using Publish = std::function<void(const PairedFrame&, const FrameAnswer&)>;

  /// @param topics  of image, depth and camera_info, for what is said to the user
  NodeCore(std::array<std::string, kInputCount> topics, Publish publish)
      : watch_(std::move(topics)), publish_(std::move(publish)) {}

  /// Reads the options and begins. Until then messages must not come.
  /// @param source  see ParameterReader
  /// @return the names of all parameters that there are
  /// @throws stillpoint::Error naming a parameter that is out of its range
  template <class Source>
  std::vector<std::string> start(Source& source) {
    std::vector<std::string> names;
    ParameterReader<Source> reader(source, names);
    each_option(session_.options, reader);
    reader("sync_tolerance_s", pairing_.options.tolerance_s, stillpoint::OptionRange{0, 10});
    int longest_queue = 1;
    reader("longest_queue", longest_queue, stillpoint::OptionRange{1, 1e6});
    each_option(session_.filter, reader);
    pairing_.options.longest_queue =
        std::max<std::size_t>(pairing_.options.longest_queue, static_cast<std::size_t>(longest_queue));
    most_detections_ = std::max(kFewestWaiting, static_cast<std::size_t>(longest_queue));
    worker_ =
        std::make_unique<LatestWorker<Job>>([this](Job& job) { work(job); }, static_cast<std::size_t>(longest_queue));
    return names;
  }

  void add_image(RawImage image) {
    add(Input::image, [&] { pairing_.add_image(std::move(image)); });
  }
  void add_depth(RawImage depth) {
    add(Input::depth, [&] { pairing_.add_depth(std::move(depth)); });
  }
  void add_camera_info(CameraInfo info) {
    add(Input::camera_info, [&] { pairing_.add_camera_info(std::move(info)); });
  }
  /// What a detector saw in the image of that time. It may be late; early, it waits for that image.
  void add_detections(double stamp_s, std::vector<stillpoint::Detection> detections) {
    const std::lock_guard<std::mutex> lock(mutex_);
    detections_.push_back({stamp_s, recording_, std::move(detections)});
    if (detections_.size() > most_detections_) detections_.erase(detections_.begin());
  }

  /// What happened since the last call, once per second.
  Report report() {
    const std::lock_guard<std::mutex> lock(mutex_);
    Report report;
    report.missing = watch_.missing(now_s(), pairing_);
    const std::string status = stillpoint::to_string(last_status_);
    const auto share = [](std::size_t part, std::size_t whole) {
      return whole == 0 ? std::string("n/a")
                        : stillpoint::format_fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1);
    };
    report.hint = std::exchange(hint_, {});
    const bool is_doubtful = !report.hint.empty() || judged_ == 0;
    report.level = !report.missing.empty() ? Report::error : is_doubtful ? Report::warn : Report::ok;
    if (!report.missing.empty())
      report.message = report.missing.front();
    else if (!report.hint.empty())
      report.message = report.hint;
    else
      report.message = judged_ > 0 ? "frames are judged" : "no frame was judged: " + status;
    report.values = {{"frames", std::to_string(frames_)},
                     {"frames judged", std::to_string(judged_)},
                     {"last status", frames_ == 0 ? "n/a" : status},
                     {"features kept [%]", share(kept_, features_)},
                     {"detected objects", std::to_string(objects_)},
                     {"movers", session_.options.follow_movers ? std::to_string(movers_) : "not followed"},
                     {"latency, longest [ms]", stillpoint::format_fixed(1000 * longest_latency_s_, 1)},
                     {"filter, last [ms]", stillpoint::format_fixed(last_filter_ms_, 1)},
                     {"frames left out, all", std::to_string(worker_ ? worker_->left_out() : 0)},
                     {"images without depth, all", std::to_string(pairing_.unpaired_images())},
                     {"detections waiting", std::to_string(detections_.size())}};
    frames_ = judged_ = features_ = kept_ = 0;
    longest_latency_s_ = 0.0;
    return report;
  }

 private:
  static constexpr std::size_t kFewestWaiting = 16;  // detections that may wait for a frame, at least

  struct Job {
    PairedFrame frame;
    double arrived_s = 0.0;
    std::size_t recording = 0;
  };
  struct StampedDetections {
    double stamp_s;
    std::size_t recording;
    std::vector<stillpoint::Detection> detections;
  };

  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  template <class Add>
  void add(Input input, Add&& add_message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    watch_.seen(input, now_s());
    add_message();
    while (std::optional<PairedFrame> frame = pairing_.take()) {
      watch_.paired(now_s());
      if (frame->image.stamp_s < newest_frame_s_) ++recording_;
      newest_frame_s_ = frame->image.stamp_s;
      worker_->submit({std::move(*frame), now_s(), recording_});
    }
  }

  /// Those of this frame and of earlier ones. Those of later frames still wait, those of an earlier recording do not.
  std::vector<StampedDetections> take_detections(const Job& job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double latest_s = job.frame.image.stamp_s + pairing_.options.tolerance_s;
    std::vector<StampedDetections> due, later;
    for (StampedDetections& seen : detections_) {
      if (seen.recording < job.recording) continue;
      const bool is_due = seen.recording == job.recording && seen.stamp_s <= latest_s;
      (is_due ? due : later).push_back(std::move(seen));
    }
    detections_.swap(later);
    return due;
  }

  /// In the worker's thread.
  void work(Job& job) {
    try {
      for (const StampedDetections& seen : take_detections(job))
        session_.filter.prior.detected(seen.stamp_s, seen.detections);
      const FrameAnswer& answer = session_.process(job.frame);
      publish_(job.frame, answer);
      count(answer, now_s() - job.arrived_s);
    } catch (const std::exception& error) {  // OpenCV's, too: nobody else catches in this thread
      const std::lock_guard<std::mutex> lock(mutex_);
      watch_.rejected(now_s(), error.what());
    }
  }

  void count(const FrameAnswer& answer, double latency_s) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++frames_;
    judged_ += stillpoint::judged(answer.status) ? 1 : 0;
    features_ += answer.features;
    kept_ += answer.kept;
    objects_ = answer.objects;
    movers_ = answer.movers.size();
    last_status_ = answer.status;
    last_filter_ms_ = answer.filter_ms;
    longest_latency_s_ = std::max(longest_latency_s_, latency_s);
    if (*answer.hint != '\0') hint_ = answer.hint;
  }

  std::mutex mutex_;  // of all but the session, which is the worker's
  FramePairing pairing_;
  InputWatch watch_;
  std::vector<StampedDetections> detections_;
  std::size_t most_detections_ = kFewestWaiting;
  std::size_t recording_ = 0;  // grows when stamps of frames jump back
  double newest_frame_s_ = -std::numeric_limits<double>::infinity();
  std::size_t frames_ = 0, judged_ = 0, features_ = 0, kept_ = 0;  // since the last report
  std::size_t objects_ = 0, movers_ = 0;
  double longest_latency_s_ = 0.0, last_filter_ms_ = 0.0;
  stillpoint::Status last_status_ = stillpoint::Status::first_frame;
  std::string hint_;  // the last one since the last report
  MaskSession session_;
  Publish publish_;
  std::unique_ptr<LatestWorker<Job>> worker_;  // the last: its thread uses the others
};

}  // namespace stillpoint_ros
