// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Stages that count their calls and answer what a test tells them: the pipeline before any geometry.

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_noise.hpp"
#include "stillpoint/filter_frame.hpp"

namespace stillpoint::mock {

/// What the stages were asked, in the order of the calls. One for all stages of a filter.
struct Log {
  std::vector<std::string> calls;

  std::size_t count(const std::string& call) const {
    std::size_t n = 0;
    for (const std::string& c : calls) n += c == call;
    return n;
  }
};

struct Stage {
  Log* log = nullptr;
  void note(const char* call) const {
    if (log != nullptr) log->calls.emplace_back(call);
  }
};

struct Prior : Stage {
  std::vector<Detection> detections;
  PixelFormat colour_format = PixelFormat::none;
  void regions(const FrameView& frame, Regions& regions) {
    note("prior");
    colour_format = frame.colour.format;
    regions.detections = detections;
  }
};

/// Matches every feature to where it is, and appends corners of its own at (1, 1).
struct Matcher : Stage {
  std::size_t own_corners = 0;
  double reference_time_s = std::numeric_limits<double>::quiet_NaN();
  double current_time_s = std::numeric_limits<double>::quiet_NaN();
  int reference_gray = -1, current_gray = -1;  ///< of the pixel (0, 0)

  void match(const FrameView& reference, const FrameView& current, Matches& matches) {
    note("match");
    reference_time_s = reference.timestamp_s;
    current_time_s = current.timestamp_s;
    reference_gray = reference.gray.row<std::uint8_t>(0)[0];
    current_gray = current.gray.row<std::uint8_t>(0)[0];
    matches.resize(matches.host_count + own_corners);
    for (std::size_t i = matches.host_count; i < matches.size(); ++i) matches.current.pixel[i] = {1, 1};
    for (std::size_t i = 0; i < matches.size(); ++i) {
      matches.reference.pixel[i] = matches.current.pixel[i];
      matches.state[i] = MatchState::matched;
    }
  }
  void reset() { note("matcher.reset"); }
};

struct EgoMotion : Stage {
  Motion answer;
  MotionPrior asked;
  std::size_t features = 0;
  std::vector<Membership> memberships;
  std::vector<double> depth_m;

  EgoMotion() { answer.status = Status::ok; }
  template <class Camera>
  Motion estimate(const Observations& observations, const Camera&, const MotionPrior& prior, Workspace&) {
    note("motion");
    asked = prior;
    features = observations.size();
    memberships = observations.regions.of_feature;
    depth_m = observations.matches.current.depth_m;
    return answer;
  }
};

/// The score of feature i is i.
struct Scorer : Stage {
  template <class Camera>
  void score(const Observations& observations, const Motion&, const Camera&, span<FeatureScore> scores) const {
    note("score");
    for (std::size_t i = 0; i < observations.size(); ++i) scores[i].value = static_cast<float>(i);
  }
};

struct Gate : Stage {
  double level = 0.5;
  Threshold threshold(span<const FeatureScore>, const Regions&, Workspace&) const {
    note("gate");
    return {level};
  }
};

/// Drops every feature whose score is odd, and notes the threshold in its probability.
struct Classifier : Stage {
  void classify(const Observations&, const Evidence& evidence, span<Label> labels, Workspace&) const {
    note("classify");
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i].keep = static_cast<int>(evidence.scores[i].value) % 2 == 0;
      labels[i].verdict = labels[i].keep ? Verdict::kept : Verdict::dynamic;
      labels[i].reason = labels[i].keep ? Reason::static_cluster : Reason::moving_cluster;
      labels[i].cluster = static_cast<std::int32_t>(i);
      labels[i].probability = static_cast<float>(evidence.threshold.level);
    }
  }
};

struct Memory : Stage {
  double unjudged_s = 0;
  void update(const Observations& observations, const Motion&, const Evidence&, span<Label>, Workspace&) {
    note("memory");
    unjudged_s = observations.matches.unjudged_s;
  }
  void reset() { note("memory.reset"); }
};

/// Keeps the first `lowest` dropped features.
struct KeepFloor : Stage {
  std::size_t lowest = 0;
  std::size_t pixels_seen = 0, labels_seen = 0;
  std::size_t apply(span<const Vector2f> pixels, const ImageView&, span<Label> labels, Workspace&) {
    note("keep_floor");
    pixels_seen = pixels.size();
    labels_seen = labels.size();
    std::size_t kept = 0;
    for (Label& label : labels) {
      if (label.keep || kept == lowest) continue;
      label.keep = true;
      label.reason = Reason::keep_floor;
      ++kept;
    }
    return kept;
  }
};

struct Policies {
  using Camera = stillpoint::Camera;
  using DepthNoise = KinectNoise;
  using DepthLookup = RoundedDepth;
  using Prior = mock::Prior;
  using Matcher = mock::Matcher;
  using EgoMotion = mock::EgoMotion;
  using Scorer = mock::Scorer;
  using Gate = mock::Gate;
  using Classifier = mock::Classifier;
  using Memory = mock::Memory;
  using KeepFloor = mock::KeepFloor;
  static constexpr std::size_t kHistoryLength = 1;
};

using Filter = FrameFilter<Policies>;

inline void log_to(Log& log, Filter& filter) {
  filter.prior.log = filter.matcher.log = filter.ego_motion.log = filter.scorer.log = filter.gate.log = &log;
  filter.classifier.log = filter.memory.log = filter.keep_floor.log = &log;
}

}  // namespace stillpoint::mock
