// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The paper's tables: errors of trajectories with and without the filter, and what others say they reach.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "stillpoint/core/span.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/evaluation/trajectory_error.hpp"
#include "stillpoint/io/number_format.hpp"

namespace tables {

/// What was published of a sequence, ATE (RMSE, metres); 0 where nothing was.
struct Published {
  const char* sequence;
  double orb_slam3, dyna_slam, ngd_slam, mvs_slam;
};

/// The paper's section 4 for ORB-SLAM3, DynaSLAM and MVS-SLAM on TUM; NGD-SLAM's paper for itself and for Bonn. Claims:
/// none was measured here.
inline constexpr std::array<Published, 9> kPublished = {{{"walking_xyz", 0.2995, 0.0186, 0.015, 0.0116},
                                                         {"walking_rpy", 0.1755, 0.0489, 0.034, 0.0262},
                                                         {"walking_halfsphere", 0.2305, 0.0373, 0.024, 0.0171},
                                                         {"walking_static", 0.0348, 0.0087, 0.007, 0.0061},
                                                         {"sitting_xyz", 0.0101, 0.0235, 0, 0.0016},
                                                         {"sitting_rpy", 0.0315, 0.0765, 0, 0.0117},
                                                         {"sitting_halfsphere", 0.0376, 0.0293, 0, 0.0150},
                                                         {"sitting_static", 0.0046, 0.0185, 0, 0.0012},
                                                         {"bonn_crowd", 0, 0.016, 0.024, 0}}};

/// The three errors of a trajectory that the paper's tables have.
struct Errors {
  stillpoint::ErrorStatistics ate_m, rpe_m, rpe_deg;
};

/// As evo computes them: positions after alignment; relative errors of poses a second apart (30 frames), all pairs.
/// @return nothing where too few poses have a partner
inline std::optional<Errors> errors_of(const stillpoint::Trajectory& reference, const stillpoint::Trajectory& estimate,
                                       double frames_apart = 30) {
  using namespace stillpoint;
  const AbsoluteTrajectoryError absolute = absolute_trajectory_error(reference, estimate, Alignment::se3);
  if (absolute.alignment.status != AlignmentStatus::ok) return std::nullopt;
  RelativeErrorOptions options;
  options.delta = frames_apart;
  options.unit = DeltaUnit::frames;
  options.pairs = PairSelection::all;
  const TrajectoryErrors relative = relative_trajectory_error(reference, estimate, options);
  return Errors{error_statistics(absolute.errors.translation_m), error_statistics(relative.translation_m),
                error_statistics(relative.rotation_deg)};
}

/// A sequence. Errors are empty where a tracker gave too few poses to align.
struct Row {
  std::string sequence;
  std::optional<Errors> filtered, unfiltered;
  bool is_here = false;  ///< false: it was not run
};

inline std::string number(double value, int digits = 4) {
  return std::isfinite(value) ? stillpoint::format_fixed(value, digits) : "–";
}

namespace detail {

using Member = stillpoint::ErrorStatistics Errors::*;

inline std::string figures(const std::optional<Errors>& errors, Member member) {
  if (!errors) return " lost | – | – | – |";
  const stillpoint::ErrorStatistics& s = (*errors).*member;
  return ' ' + number(s.rmse) + " | " + number(s.mean) + " | " + number(s.median) + " | " + number(s.std) + " |";
}

/// η of RMSE, mean, median and standard deviation (Eq. 17).
inline std::string improvement(const Row& row, Member member) {
  if (!row.filtered || !row.unfiltered) return " – | – | – | – |";
  const stillpoint::ErrorStatistics &with = (*row.filtered).*member, &without = (*row.unfiltered).*member;
  std::string cells;
  for (const auto figure : {&stillpoint::ErrorStatistics::rmse, &stillpoint::ErrorStatistics::mean,
                            &stillpoint::ErrorStatistics::median, &stillpoint::ErrorStatistics::std}) {
    const auto eta = stillpoint::improvement_percent(without.*figure, with.*figure);
    cells += ' ' + (eta ? number(*eta, 2) : std::string("–")) + " |";
  }
  return cells;
}

}  // namespace detail

/// One of tables 1 to 3: RMSE, mean, median and standard deviation without the filter and with it, and η in percent.
inline std::string error_table(const std::string& title, stillpoint::span<const Row> rows,
                               stillpoint::ErrorStatistics Errors::*member) {
  std::string text =
      "**" + title +
      "**\n\n| sequence | without: RMSE | mean | median | SD | with: RMSE | mean | median | SD | η RMSE, % | "
      "mean | median | SD |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    text += "| " + row.sequence + " |";
    if (!row.is_here)
      text += " the sequence is not here | | | | | | | | | | | |\n";
    else
      text += detail::figures(row.unfiltered, member) + detail::figures(row.filtered, member) +
              detail::improvement(row, member) + '\n';
  }
  return text + '\n';
}

/// Table 4: ATE beside what others say they reach.
inline std::string comparison_table(stillpoint::span<const Row> rows) {
  std::string text =
      "**Table 4: ATE, RMSE in metres, beside what was published**\n\n| sequence | here, without | here, with | "
      "ORB-SLAM3 | "
      "DynaSLAM | NGD-SLAM | MVS-SLAM (claim) |\n|---|---|---|---|---|---|---|\n";
  const auto cell = [](double value) { return value > 0 ? number(value) : std::string("–"); };
  const auto ours = [](const Row& row, const std::optional<Errors>& errors) {
    return errors ? number(errors->ate_m.rmse) : std::string(row.is_here ? "lost" : "not here");
  };
  for (const Row& row : rows) {
    Published known{"", 0, 0, 0, 0};
    for (const Published& published : kPublished)
      if (row.sequence == published.sequence) known = published;
    text += "| " + row.sequence + " | " + ours(row, row.unfiltered) + " | " + ours(row, row.filtered) + " | " +
            cell(known.orb_slam3) + " | " + cell(known.dyna_slam) + " | " + cell(known.ngd_slam) + " | " +
            cell(known.mvs_slam) + " |\n";
  }
  return text + '\n';
}

/// What a reader of the tables must know; empty where there is nothing.
inline std::string notes(stillpoint::span<const Row> rows) {
  const bool has_bonn = std::any_of(rows.begin(), rows.end(), [](const Row& row) {
    return row.sequence.rfind("bonn_", 0) == 0 && (row.filtered || row.unfiltered);
  });
  return has_bonn ? "The poses of bonn_* are those of markers on the camera, not of the camera: compare the ATE. "
                    "Tables 2 and "
                    "3 have no meaning there.\n"
                  : "";
}

/// All figures, one row for each sequence, metric and filter.
inline std::string as_csv(stillpoint::span<const Row> rows) {
  std::string text = "sequence,filter,metric,rmse,mean,median,std,count\n";
  for (const Row& row : rows)
    for (const bool is_filtered : {false, true}) {
      const std::optional<Errors>& errors = is_filtered ? row.filtered : row.unfiltered;
      const std::string begin = row.sequence + (is_filtered ? ",with," : ",without,");
      if (!errors) {
        text += begin + (row.is_here ? "lost" : "not here") + ",,,,,\n";
        continue;
      }
      const std::pair<const char*, const stillpoint::ErrorStatistics*> metrics[] = {
          {"ate_m", &errors->ate_m}, {"rpe_m", &errors->rpe_m}, {"rpe_deg", &errors->rpe_deg}};
      for (const auto& [name, s] : metrics)
        text += begin + name + ',' + number(s->rmse, 9) + ',' + number(s->mean, 9) + ',' + number(s->median, 9) + ',' +
                number(s->std, 9) + ',' + std::to_string(s->count) + '\n';
    }
  return text;
}

}  // namespace tables
