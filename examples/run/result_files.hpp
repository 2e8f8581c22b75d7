// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The files of one run: those of the run before stay until all of these are written.

#include <algorithm>
#include <deque>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/io/atomic_file.hpp"
#include "stillpoint/io/trajectory_file.hpp"

namespace stillpoint_run {

/// Files in one folder that get their names together.
class ResultFiles {
 public:
  explicit ResultFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A file to write bit by bit; it lives as long as this.
  /// @throws stillpoint::Error if it can't be made
  stillpoint::AtomicFile& open(const std::string& name) {
    names_.push_back(name);
    return files_.emplace_back(folder_ / name);
  }
  void add(const std::string& name, const std::string& text) { open(name).write(text); }
  void add(const std::string& name, const stillpoint::Trajectory& trajectory) {
    add(name, stillpoint::format_trajectory(folder_ / name, trajectory));
  }

  /// Writes all that is left.
  /// @throws stillpoint::Error if it can't; the files of the run before are as they were
  void finish() {
    for (stillpoint::AtomicFile& file : files_) file.finish();
  }

  /// Gives the files their names; then what only the run before wrote goes.
  void commit() {
    std::error_code ignored;
    const bool had_a_run = std::filesystem::exists(folder_ / "report.json", ignored);
    for (stillpoint::AtomicFile& file : files_) file.commit();
    if (!had_a_run) return;
    for (const char* name : {"movers.csv", "options.yaml", "trajectory_live.txt", "map.ply", "map_before_loop.ply"})
      if (std::find(names_.begin(), names_.end(), name) == names_.end())
        std::filesystem::remove(folder_ / name, ignored);
  }

 private:
  std::filesystem::path folder_;
  std::deque<stillpoint::AtomicFile> files_;
  std::deque<std::string> names_;
};

}  // namespace stillpoint_run
