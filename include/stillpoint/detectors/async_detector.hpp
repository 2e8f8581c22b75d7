// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A detector in a thread of its own: the tracker offers every frame and takes what has been found, and never waits.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/core/image.hpp"
#include "stillpoint/core/regions.hpp"

namespace stillpoint {

template <class D, class = void>
struct is_detector : std::false_type {};
template <class D>
struct is_detector<D, std::void_t<decltype(std::declval<D&>().detect(std::declval<const ImageView&>(),
                                                                     std::declval<std::vector<Detection>&>()))>>
    : std::true_type {};

/// What a detector found in one frame.
struct DetectorAnswer {
  double timestamp_s = 0.0;           ///< of that frame
  std::vector<Detection> detections;  ///< empty: it saw nothing
};

enum class DetectorStatus : std::uint8_t {
  idle,     ///< nothing to do; the last detection, if there was one, went well
  working,  ///< a frame waits or is being looked at
  failed,   ///< nothing to do; the last detection threw. The next frame is tried all the same
};

/// What became of the frames. offered = skipped + replaced + detected + failed + at most two that are on their way.
struct DetectorCounters {
  std::size_t offered = 0;
  std::size_t skipped = 0;   ///< not wanted: `detect_every`, or an empty image
  std::size_t replaced = 0;  ///< gave way to a newer frame before the detector came to them
  std::size_t detected = 0;
  std::size_t failed = 0;  ///< the detector threw
};

/// Runs a detector on the newest frame, over and over. One frame at most waits: a newer one replaces it.
///
///     AsyncDetector<MyDetector> detector(MyDetector("people.onnx"));
///     DetectorAnswer answer;
///     for each frame:
///       detector.offer(image, time_s);
///       if (detector.take(answer)) filter.prior.detected(answer.timestamp_s, answer.detections);
///       filter.filter_frame(...);
///
/// `offer` copies the image; all else that tracking waits for is a lock under which buffers are swapped. `offer` and
/// `take` are for one thread, everything else may be asked from any. No exception of the detector leaves this class.
/// @tparam Detector  `void detect(const ImageView& gray_or_bgr, std::vector<Detection>& detections)`; the vector comes
///                   empty. It may throw and take its time; it is never called by two threads at once.
template <class Detector>
class AsyncDetector {
 public:
  static_assert(is_detector<Detector>::value,
                "stillpoint: a Detector must offer void detect(const ImageView&, std::vector<Detection>&); see "
                "detectors/async_detector.hpp");

  struct Options {
    int detect_every = 1;         ///< of so many offered frames the first is looked at; below 2 every one
    bool is_synchronous = false;  ///< `offer` itself detects, without a thread: the same answers in every run
  };

  explicit AsyncDetector(Detector a_detector) : AsyncDetector(std::move(a_detector), Options()) {}

  /// @throws std::system_error where no thread can be started.
  AsyncDetector(Detector a_detector, const Options& options) : options_(options), detector_(std::move(a_detector)) {
    if (!options_.is_synchronous) thread_ = std::thread([this] { run(); });
  }

  /// Waits until a detection that is under way has ended: a network can't be stopped half-way. A waiting frame is
  /// dropped.
  ~AsyncDetector() {
    {
      const std::lock_guard lock(mutex_);
      is_stopping_ = true;
    }
    has_news_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  AsyncDetector(const AsyncDetector&) = delete;
  AsyncDetector& operator=(const AsyncDetector&) = delete;

  /// Hands a frame over; the image need not outlive the call.
  /// @param image  gray or BGR, whatever the detector takes
  /// @return       whether it will be looked at, unless a newer one comes first
  bool offer(const ImageView& image, double timestamp_s) {
    const bool is_wanted = !image.empty() && frame_++ % wanted_period() == 0;
    if (is_wanted && !options_.is_synchronous) offered_.assign(image, timestamp_s);
    {
      const std::lock_guard lock(mutex_);
      ++counters_.offered;
      if (!is_wanted) {
        ++counters_.skipped;
        return false;
      }
      if (!options_.is_synchronous) {
        counters_.replaced += is_waiting_;
        is_waiting_ = true;
        std::swap(offered_, waiting_);
      }
    }
    if (options_.is_synchronous)
      detect(image, timestamp_s);
    else
      has_news_.notify_all();
    return true;
  }

  /// The newest answer, each one once.
  /// @param answer  overwritten if there is one; its memory is reused
  /// @return        whether there was one
  bool take(DetectorAnswer& answer) {
    const std::lock_guard lock(mutex_);
    if (!has_answer_) return false;
    has_answer_ = false;
    std::swap(answer, answer_);
    return true;
  }

  DetectorStatus status() const {
    const std::lock_guard lock(mutex_);
    if (is_waiting_ || is_working_) return DetectorStatus::working;
    return error_.empty() ? DetectorStatus::idle : DetectorStatus::failed;
  }
  /// What the last detection threw; empty if it went well.
  std::string error() const {
    const std::lock_guard lock(mutex_);
    return error_;
  }
  DetectorCounters counters() const {
    const std::lock_guard lock(mutex_);
    return counters_;
  }

  /// Waits until every frame that was offered has been looked at or replaced. Tracking has no use for it; the end of a
  /// recording has.
  void wait() {
    std::unique_lock lock(mutex_);
    has_news_.wait(lock, [this] { return !is_waiting_ && !is_working_; });
  }

 private:
  struct Frame {
    ImageBuffer image;
    double timestamp_s = 0.0;
    void assign(const ImageView& view, double time_s) {
      image.assign(view);
      timestamp_s = time_s;
    }
  };

  std::size_t wanted_period() const noexcept {
    return options_.detect_every > 1 ? static_cast<std::size_t>(options_.detect_every) : 1;
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      has_news_.wait(lock, [this] { return is_waiting_ || is_stopping_; });
      if (is_stopping_) return;
      std::swap(waiting_, looked_at_);
      is_waiting_ = false;
      is_working_ = true;
      lock.unlock();
      detect(looked_at_.image.view(), looked_at_.timestamp_s);
      lock.lock();
      is_working_ = false;
      has_news_.notify_all();
    }
  }

  void detect(const ImageView& image, double timestamp_s) {
    found_.timestamp_s = timestamp_s;
    found_.detections.clear();
    std::string error;
    try {
      detector_.detect(image, found_.detections);
    } catch (const std::exception& thrown) {
      error = *thrown.what() != '\0' ? thrown.what() : "an exception without a message";
    } catch (...) {
      error = "an exception that is no std::exception";
    }
    const std::lock_guard lock(mutex_);
    ++(error.empty() ? counters_.detected : counters_.failed);
    if (error.empty()) {
      std::swap(found_, answer_);
      has_answer_ = true;
    }
    std::swap(error, error_);
  }

  Options options_;
  Detector detector_;
  Frame offered_;         // written by who offers; the lock is held only to swap it with waiting_
  Frame looked_at_;       // of the thread
  DetectorAnswer found_;  // of who detects
  std::size_t frame_ = 0;

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable has_news_;
  Frame waiting_;
  DetectorAnswer answer_;
  DetectorCounters counters_;
  std::string error_;
  bool is_waiting_ = false, is_working_ = false, has_answer_ = false, is_stopping_ = false;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace stillpoint
