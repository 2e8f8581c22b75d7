// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The record of a frame, from what a filter said.

#include <opencv2/core/types.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "../backends/oracle_filter.hpp"
#include "frame_record.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/frame_result.hpp"
#include "stillpoint/core/regions.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"

namespace stillpoint_run {

namespace detail {

inline stillpoint::Mobility mobility_of(const stillpoint::Membership& feature) {
  if (feature.in_dynamic) return stillpoint::Mobility::dynamic;
  if (feature.in_movable) return stillpoint::Mobility::movable;
  return feature.in_fixed ? stillpoint::Mobility::fixed : stillpoint::Mobility::unknown;
}

/// The part that every filter's record has: pixels and flags.
inline void begin_record(const std::vector<cv::KeyPoint>& keypoints, stillpoint::span<const std::uint8_t> keep,
                         FrameRecord& record) {
  record.keep.assign(keep.begin(), keep.end());
  record.pixels.clear();
  for (const cv::KeyPoint& keypoint : keypoints) record.pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
  record.regions.clear();
  record.movers.clear();
  record.rows.clear();
  for (const stillpoint::Vector2f& pixel : record.pixels)
    record.rows.push_back({pixel, {}, "", stillpoint::FeatureScore{}.value, 0.0, stillpoint::Mobility::unknown});
  record.summary.features = keypoints.size();
  record.summary.kept = 0;
  for (const std::uint8_t flag : keep) record.summary.kept += flag != 0 ? 1 : 0;
}

inline std::optional<double> median_kept_score(const std::vector<FeatureRow>& rows) {
  std::vector<double> scores;
  for (const FeatureRow& row : rows)
    if (row.label.keep && std::isfinite(row.score)) scores.push_back(static_cast<double>(row.score));
  if (scores.empty()) return std::nullopt;
  return stillpoint::error_statistics(scores).median;
}

/// As boxes.txt has it: a column of a file.
inline std::string one_word(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == ',' || c == '\n') c = '_';
  return name.empty() ? "unknown" : name;
}

/// In which regions each feature is, as the filter asked: where an object's depth is known, by depth, too.
inline void locate(FrameRecord& record) {
  stillpoint::Regions regions;
  for (const RegionRow& row : record.regions) regions.detections.push_back(row.region.detection);
  std::vector<double> depths_m;
  for (const FeatureRow& row : record.rows) depths_m.push_back(row.depth_m);
  regions.locate(record.pixels, depths_m);
  for (std::size_t i = 0; i < record.rows.size(); ++i) record.rows[i].prior = mobility_of(regions.of_feature[i]);
}

template <class Lookup>
double depth_at(const stillpoint::FrameView& frame, const Lookup& lookup, const stillpoint::Vector2f& pixel) {
  if (frame.depth.empty()) return 0.0;
  return lookup.at(frame.depth, stillpoint::DepthScale(frame.image(), frame.depth.image)(pixel));
}

}  // namespace detail

/// Writes down what `FrameFilter` decided. A frame that was not judged gets its depths looked up here.
/// @param class_name  (int class_index) → text
template <class Filter, class ClassName>
void write_down(const stillpoint::FrameView& frame, const Filter& filter, const std::vector<cv::KeyPoint>& keypoints,
                const stillpoint::FrameResult& result, ClassName&& class_name, FrameRecord& record) {
  detail::begin_record(keypoints, result.keep(), record);
  const bool judged = stillpoint::judged(result.status());
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    FeatureRow& row = record.rows[i];
    row.label = result.label(i);
    row.reason = to_string(row.label.reason);
    row.score = result.score(i).value;
    row.depth_m = judged ? result.depth_m(i) : detail::depth_at(frame, filter.depth_lookup, row.pixel);
  }
  for (const UsedRegion& region : filter.prior.used())
    record.regions.push_back({region, class_name(region.detection.class_index)});
  detail::locate(record);
  for (const stillpoint::Mover& mover : result.movers())
    record.movers.push_back({mover, detail::one_word(mover.class_index < 0 ? "" : class_name(mover.class_index))});
  FrameSummary& summary = record.summary;
  summary.status = result.status();
  summary.warnings = result.warnings();
  summary.hint = result.hint();
  summary.motion = result.motion();
  summary.timings = result.timings();
  summary.keep_floor_kept = result.keep_floor_kept();
  if (judged) summary.kept_score = detail::median_kept_score(record.rows);
}

/// Writes down what the oracle read in the labels: it has no score, no motion, no regions and no stages.
template <class ClassName>
void write_down(const stillpoint::FrameView& frame, const examples::OracleFilter&,
                const std::vector<cv::KeyPoint>& keypoints, const examples::OracleFilter::Result& result, ClassName&&,
                FrameRecord& record) {
  detail::begin_record(keypoints, result.keep(), record);
  for (std::size_t i = 0; i < record.rows.size(); ++i) {
    FeatureRow& row = record.rows[i];
    row.label.keep = record.keep[i] != 0;
    row.label.verdict = row.label.keep ? stillpoint::Verdict::kept : stillpoint::Verdict::dynamic;
    row.reason = "label";
    row.depth_m = detail::depth_at(frame, stillpoint::RoundedDepth{}, row.pixel);
  }
  record.summary.status = stillpoint::Status::ok;
}

}  // namespace stillpoint_run
