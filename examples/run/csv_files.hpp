// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// features.csv, frames.csv and movers.csv: fixed decimals, no locale, the same bytes on every run.

#include <Eigen/Geometry>

#include <charconv>
#include <cstddef>
#include <string>

#include "frame_record.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_run {

/// One row per feature and frame; what is not known is `nan`, a feature of no cluster has -1.
class FeaturesFile {
 public:
  explicit FeaturesFile(stillpoint::AtomicFile& file) : file_(file) {
    file_.write("timestamp,x,y,keep,verdict,reason,score,cluster,depth,prior\n");
  }

  void write(const FrameRecord& record) {
    // Five decimals of a pixel: enough that rounding to a whole pixel gives the same one as the float did.
    constexpr int kPixelDecimals = 5, kScoreDecimals = 6, kDepthDecimals = 4;
    const std::string timestamp = stillpoint::format_timestamp(record.summary.timestamp_s);
    text_.clear();
    for (const FeatureRow& row : record.rows) {
      text_ += timestamp;
      append(static_cast<double>(row.pixel.x()), kPixelDecimals);
      append(static_cast<double>(row.pixel.y()), kPixelDecimals);
      text_ += row.label.keep ? ",1," : ",0,";
      text_ += to_string(row.label.verdict);
      text_ += ',';
      text_ += row.reason;
      append(static_cast<double>(row.score), kScoreDecimals);
      append(row.label.cluster);
      append(row.depth_m, kDepthDecimals);
      text_ += ',';
      text_ += to_string(row.prior);
      text_ += '\n';
    }
    file_.write(text_);
  }

 private:
  void append(double value, int decimals) {
    text_ += ',';
    text_ += stillpoint::format_fixed(value, decimals);
  }
  void append(std::int32_t value) {
    char digits[12];
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    text_ += ',';
    text_.append(digits, end.ptr);
  }

  stillpoint::AtomicFile& file_;
  std::string text_;
};

/// One row per frame, with the motion that its verdicts assumed: current_from_reference, `nan` where there was none;
/// warnings have `|` between them.
class FramesFile {
 public:
  explicit FramesFile(stillpoint::AtomicFile& file) : file_(file) {
    file_.write("timestamp,status,reference_timestamp,tx,ty,tz,qx,qy,qz,qw,features,kept,keep_floor_kept,warnings\n");
  }

  void write(const FrameSummary& frame) {
    std::string row = stillpoint::format_timestamp(frame.timestamp_s) + ',' + to_string(frame.status);
    const stillpoint::Motion& motion = frame.motion;
    if (motion.usable()) {
      row += ',' + stillpoint::format_timestamp(motion.reference_timestamp_s);
      Eigen::Quaterniond rotation(motion.current_from_reference.linear());
      if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
      const stillpoint::Vector3d translation = motion.current_from_reference.translation();
      for (const double value : {translation.x(), translation.y(), translation.z(),  //
                                 rotation.x(), rotation.y(), rotation.z(), rotation.w()})
        row += ',' + stillpoint::format_fixed(value, 9);
    } else {
      row += ",nan,nan,nan,nan,nan,nan,nan,nan";
    }
    row += ',' + std::to_string(frame.features) + ',' + std::to_string(frame.kept) + ',' +
           std::to_string(frame.keep_floor_kept) + ',';
    bool is_first = true;
    if (frame.warnings.empty()) row += "none";
    frame.warnings.for_each([&](stillpoint::Warning warning) {
      row += is_first ? "" : "|";
      row += to_string(warning);
      is_first = false;
    });
    row += '\n';
    file_.write(row);
  }

 private:
  stillpoint::AtomicFile& file_;
};

/// One row per mover and frame: place and velocity in the axes of the current camera, the velocity relative to the
/// world; the class is `unknown` where no detector named it.
class MoversFile {
 public:
  explicit MoversFile(stillpoint::AtomicFile& file) : file_(file) {
    file_.write("timestamp,id,state,x,y,z,vx,vy,vz,features,class\n");
  }

  void write(const FrameRecord& record) {
    constexpr int kDecimals = 4;
    for (const MoverRow& row : record.movers) {
      const stillpoint::Mover& mover = row.mover;
      std::string text = stillpoint::format_timestamp(record.summary.timestamp_s) + ',' + std::to_string(mover.id) +
                         ',' + to_string(mover.state);
      for (const stillpoint::Vector3d& vector : {mover.centroid, mover.velocity})
        for (const double value : {vector.x(), vector.y(), vector.z()})
          text += ',' + stillpoint::format_fixed(value, kDecimals);
      file_.write(text + ',' + std::to_string(mover.feature_count) + ',' + row.class_name + '\n');
    }
  }

 private:
  stillpoint::AtomicFile& file_;
};

}  // namespace stillpoint_run
