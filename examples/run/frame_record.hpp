// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What is written down of a frame (write_down.hpp): one row a feature, and the frame as a whole.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "used_region.hpp"

namespace stillpoint_run {

/// One feature and what was decided of it.
struct FeatureRow {
  stillpoint::Vector2f pixel;
  stillpoint::Label label;
  const char* reason;
  float score;
  double depth_m;
  stillpoint::Mobility prior;
};

/// A frame as a whole.
struct FrameSummary {
  double timestamp_s = 0.0;
  double time_s = 0.0;  ///< since the run's first frame
  stillpoint::Status status = stillpoint::Status::ok;
  stillpoint::Warnings warnings;
  const char* hint = "";  ///< what is probably wrong with the input
  stillpoint::Motion motion;
  stillpoint::Timings timings;
  double extract_ms = 0.0, track_ms = 0.0;
  std::size_t features = 0, kept = 0, keep_floor_kept = 0;
  std::optional<double> kept_score;          ///< median score of the features kept
  stillpoint::DropCount moving, background;  ///< of this frame alone; empty where there are no labels
};

/// A region of the prior as the filter had it.
struct RegionRow {
  UsedRegion region;
  std::string class_name;
};

/// An object that the filter follows.
struct MoverRow {
  stillpoint::Mover mover;
  std::string class_name;  ///< one word
};

/// What is kept of a mover in one frame of the run.
struct MoverInFrame {
  std::size_t frame = 0;  ///< of the run, from 0
  std::uint32_t id = 0;
  stillpoint::MoverState state = stillpoint::MoverState::moving;
  stillpoint::Box box;
  stillpoint::Vector3d centroid = stillpoint::Vector3d::Zero();  ///< in the camera, metres
  double speed_m_s = 0.0;
  std::string class_name;
};

/// What the filter said of the current frame, refilled each time.
struct FrameRecord {
  FrameSummary summary;
  std::vector<MoverRow> movers;
  std::vector<RegionRow> regions;
  std::vector<FeatureRow> rows;
  std::vector<stillpoint::Vector2f> pixels;
  std::vector<std::uint8_t> keep;
};

}  // namespace stillpoint_run
