// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a detector says while the frames go by: nothing, what boxes.txt knows, or what a network finds.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detector_record.hpp"
#include "frame_source.hpp"
#include "network.hpp"
#include "options.hpp"
#include "stillpoint/core/random.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/detectors/async_detector.hpp"
#include "stillpoint/detectors/mobility_table.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint_run {

/// Where the prior's answers come from. This one has none.
class DetectionFeed {
 public:
  DetectionFeed() = default;
  DetectionFeed(const DetectionFeed&) = delete;
  DetectionFeed& operator=(const DetectionFeed&) = delete;
  virtual ~DetectionFeed() = default;

  /// Call it for each frame, in their order, before the filter.
  /// @return what is new: of this frame, or late of an earlier one. An empty list says that nothing was seen.
  virtual std::optional<stillpoint::DetectorAnswer> next(const SourceFrame&) { return std::nullopt; }
  /// The name behind `Detection::class_index`.
  virtual std::string class_name(int) const { return ""; }
  /// After the last frame; empty where no network ran.
  virtual std::optional<DetectorRecord> finish() { return std::nullopt; }
};

/// The sequence's own boxes: those of every n-th frame, a share of them left out at random.
class BoxFeed : public DetectionFeed {
 public:
  explicit BoxFeed(const Options& options)
      : every_(static_cast<std::size_t>(options.detect_every)),
        dropped_share_(options.drop_boxes),
        random_(options.seed) {}

  std::optional<stillpoint::DetectorAnswer> next(const SourceFrame& frame) override {
    if (frame_++ % every_ != 0) return std::nullopt;
    stillpoint::DetectorAnswer answer{frame.timestamp_s, {}};
    for (const stillpoint::DetectedBox& found : frame.boxes) {
      if (dropped_share_ > 0 && random_.uniform() < dropped_share_) continue;
      stillpoint::Detection detection{found.box, mobility_[found.class_name], found.confidence};
      detection.class_index = index_of(found.class_name);
      answer.detections.push_back(detection);
    }
    return answer;
  }

  std::string class_name(int index) const override { return index < 0 ? "" : names_[static_cast<std::size_t>(index)]; }

 private:
  std::int16_t index_of(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    const auto index = static_cast<std::int16_t>(found - names_.begin());
    if (found == names_.end()) names_.push_back(name);
    return index;
  }

  std::size_t every_, frame_ = 0;
  double dropped_share_;
  stillpoint::Random random_;
  stillpoint::MobilityTable mobility_;
  std::vector<std::string> names_;  // in the order in which they came
};

/// A network, in a thread of its own unless `--sync`.
class NetworkFeed : public DetectionFeed {
 public:
  NetworkFeed(const Options& options, std::unique_ptr<Network> network)
      : network_(std::move(network)),
        detector_(Watched{network_.get(), &times_ms_, &last_error_}, {options.detect_every, options.is_synchronous}) {}

  std::optional<stillpoint::DetectorAnswer> next(const SourceFrame& frame) override {
    detector_.offer(frame.colour, frame.timestamp_s);
    stillpoint::DetectorAnswer answer;
    if (!detector_.take(answer)) return std::nullopt;
    return answer;
  }

  std::string class_name(int index) const override {
    const stillpoint::ClassList& classes = network_->classes();
    return classes.names(index) ? classes[static_cast<std::size_t>(index)] : "";
  }

  std::optional<DetectorRecord> finish() override {
    detector_.wait();  // from here on its thread writes nothing
    return DetectorRecord{network_->layout(), network_->input_size(), detector_.counters(), times_ms_, last_error_};
  }

 private:
  /// The network with a clock beside it, and a memory of what went wrong.
  struct Watched {
    Network* network;
    std::vector<double>* times_ms;
    std::string* last_error;

    void detect(const stillpoint::ImageView& image, std::vector<stillpoint::Detection>& detections) {
      const auto start = std::chrono::steady_clock::now();
      try {
        network->detect(image, detections);
      } catch (const std::exception& error) {
        *last_error = error.what();
        throw;
      }
      times_ms->push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
  };

  std::unique_ptr<Network> network_;
  std::vector<double> times_ms_;
  std::string last_error_;
  stillpoint::AsyncDetector<Watched> detector_;  // last: its thread uses all of the above
};

/// The feed that the options name.
/// @throws stillpoint::Error where a network can't be read or run.
inline std::unique_ptr<DetectionFeed> open_feed(const Options& options) {
  if (options.has_network()) return std::make_unique<NetworkFeed>(options, open_network(options));
  if (options.prior == "boxes") return std::make_unique<BoxFeed>(options);
  return std::make_unique<DetectionFeed>();
}

}  // namespace stillpoint_run
