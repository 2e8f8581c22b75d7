// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// ATE, RPE and recall, by the library's own evaluation.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "stillpoint/evaluation/error_statistics.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/evaluation/trajectory_error.hpp"
#include "stillpoint/io/trajectory_file.hpp"

namespace stillpoint_python {
namespace {

using stillpoint::ErrorStatistics;
using stillpoint::Trajectory;

/// One of a few words as an enumerator; they stand in the enum's order.
template <class Enum, std::size_t count>
Enum choice(const char* name, const std::string& word, const std::array<const char*, count>& words) {
  std::string list;
  for (std::size_t i = 0; i < count; ++i) {
    if (word == words[i]) return static_cast<Enum>(i);
    list += (i == 0 ? "" : " or ") + std::string(words[i]);
  }
  throw stillpoint::Error(std::string(name) + " is '" + word + "', expected " + list);
}

/// A file, or rows of `timestamp tx ty tz qx qy qz qw`.
Trajectory trajectory_of(const py::object& object, const std::string& name) {
  if (py::hasattr(object, "__fspath__") || py::isinstance<py::str>(object))
    return stillpoint::read_trajectory(object.cast<std::filesystem::path>());
  const py::array array = as_array(object, name, "a file, or a NumPy array with shape (N, 8)");
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != 8)
    throw stillpoint::Error(name + " has shape " + shape_text(array) +
                            ", expected (N, 8): timestamp tx ty tz qx qy qz qw");
  const py::array_t<double, py::array::c_style | py::array::forcecast> rows(array);
  Trajectory trajectory;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double* const row = rows.data(i, 0);
    const std::string place = name + ", row " + std::to_string(i);
    for (int column = 0; column < 8; ++column)
      if (!std::isfinite(row[column])) throw stillpoint::Error(place + " is not finite, expected eight finite numbers");
    const std::optional<stillpoint::Pose> pose =
        stillpoint::pose_from_quaternion({row[7], row[4], row[5], row[6]}, {row[1], row[2], row[3]});
    if (!pose) throw stillpoint::Error(place + " has a quaternion of length zero, expected qx qy qz qw of length one");
    trajectory.push_back({row[0], *pose});
  }
  return trajectory;
}

/// Errors of a trajectory and what they say as a whole.
struct TrajectoryError {
  stillpoint::TrajectoryErrors errors;
  stillpoint::AlignmentResult alignment;
};

TrajectoryError ate(const py::object& reference, const py::object& estimate, const std::string& alignment,
                    double max_time_difference_s) {
  constexpr std::array<const char*, 3> kAlignments{"none", "se3", "sim3"};
  auto error = stillpoint::absolute_trajectory_error(
      trajectory_of(reference, "reference"), trajectory_of(estimate, "estimate"),
      choice<stillpoint::Alignment>("alignment", alignment, kAlignments), max_time_difference_s);
  return {std::move(error.errors), error.alignment};
}

TrajectoryError rpe(const py::object& reference, const py::object& estimate, double delta, const std::string& unit,
                    const std::string& pairs, double max_time_difference_s) {
  constexpr std::array<const char*, 2> kUnits{"frames", "metres"}, kPairs{"consecutive", "all"};
  stillpoint::RelativeErrorOptions options;
  options.delta = delta;
  options.unit = choice<stillpoint::DeltaUnit>("unit", unit, kUnits);
  options.pairs = choice<stillpoint::PairSelection>("pairs", pairs, kPairs);
  return {stillpoint::relative_trajectory_error(trajectory_of(reference, "reference"),
                                                trajectory_of(estimate, "estimate"), options, max_time_difference_s),
          {}};
}

py::array similarity_of(const TrajectoryError& error) {
  const stillpoint::Similarity& similarity = error.alignment.target_from_source;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = similarity.scale * similarity.rotation;
  matrix.topRightCorner<3, 1>() = similarity.translation;
  return matrix_array(matrix);
}

std::string status_of(const TrajectoryError& error) {
  constexpr std::array<const char*, 4> kNames{"ok", "too_few_points", "collinear", "not_finite"};
  return kNames[static_cast<std::size_t>(error.alignment.status)];
}

/// @param frames  any iterable of (labels, keypoints, keep)
stillpoint::FilterScore recall(const py::iterable& frames) {
  stillpoint::FilterScore score;
  for (const py::handle& item : frames) {
    if (!py::isinstance<py::sequence>(item) || py::len(item) != 3)
      throw py::type_error("frame " + std::to_string(score.frames()) + " is " + type_name(item) +
                           ", expected (labels, keypoints, keep)");
    const auto [labels, keypoints, keep] = item.cast<std::tuple<py::object, py::object, py::object>>();
    const py::array flags = as_array(keep, "keep", "a NumPy array of bool with shape (N,)");
    if (!holds<bool>(flags)) throw py::type_error("keep has dtype " + type_text(flags) + ", expected bool");
    if (flags.ndim() != 1) throw stillpoint::Error("keep has shape " + shape_text(flags) + ", expected (N,)");
    const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast> bytes(flags);
    score.add_frame(image_of(labels, "labels"), pixels_of(keypoints),
                    {bytes.data(), static_cast<std::size_t>(bytes.size())});
  }
  return score;
}

}  // namespace

void bind_evaluation(py::module_& module) {
  py::class_<ErrorStatistics>(module, "ErrorStatistics",
                              "Summary of a list of errors, in their unit; NaN where it is empty.")
      .def_readonly("count", &ErrorStatistics::count)
      .def_readonly("rmse", &ErrorStatistics::rmse)
      .def_readonly("mean", &ErrorStatistics::mean)
      .def_readonly("median", &ErrorStatistics::median)
      .def_readonly("std", &ErrorStatistics::std)
      .def_readonly("min", &ErrorStatistics::min)
      .def_readonly("max", &ErrorStatistics::max)
      .def("__repr__", [](const ErrorStatistics& statistics) {
        return "<ErrorStatistics: rmse " + stillpoint::option_text(statistics.rmse) + " of " +
               std::to_string(statistics.count) + '>';
      });

  py::class_<TrajectoryError>(module, "TrajectoryError", "Errors of a trajectory, in the order of time.")
      .def_property_readonly("timestamps_s", [](const TrajectoryError& e) { return array_of(e.errors.timestamps_s); })
      .def_property_readonly("translation_m", [](const TrajectoryError& e) { return array_of(e.errors.translation_m); })
      .def_property_readonly("rotation_deg", [](const TrajectoryError& e) { return array_of(e.errors.rotation_deg); })
      .def_property_readonly(
          "translation", [](const TrajectoryError& e) { return stillpoint::error_statistics(e.errors.translation_m); },
          "Statistics in metres.")
      .def_property_readonly(
          "rotation", [](const TrajectoryError& e) { return stillpoint::error_statistics(e.errors.rotation_deg); },
          "Statistics in degrees.")
      .def_property_readonly("status", &status_of,
                             "Of the alignment: ok, too_few_points, collinear or not_finite; then there are no errors.")
      .def_property_readonly("reference_from_estimate", &similarity_of, "The alignment, 4 x 4, with its scale.");

  py::class_<stillpoint::FilterScore>(module, "FilterScore",
                                      "How well verdicts agree with labels; None where nothing was counted.")
      .def_property_readonly("recall", &stillpoint::FilterScore::recall,
                             "Share of the moving features that were dropped.")
      .def_property_readonly("false_positive_rate", &stillpoint::FilterScore::false_positive_rate,
                             "Share of the background's features that were dropped.")
      .def_property_readonly("parked_dropped", &stillpoint::FilterScore::parked_dropped,
                             "Share of the features on movers at rest that were dropped.")
      .def_property_readonly("moving", [](const stillpoint::FilterScore& score) { return score.moving().features; })
      .def_property_readonly("background",
                             [](const stillpoint::FilterScore& score) { return score.background().features; })
      .def_property_readonly("frames", &stillpoint::FilterScore::frames);

  module.def("ate", &ate,
             "Absolute trajectory error, as evo's ape. Trajectories are files or arrays (N, 8) of timestamp tx ty tz "
             "qx qy qz\n"
             "qw, world_from_camera. alignment is se3, sim3 or none.",
             py::arg("reference"), py::arg("estimate"), py::arg("alignment") = "se3",
             py::arg("max_time_difference_s") = 0.01);
  module.def(
      "rpe", &rpe,
      "Relative trajectory error, as evo's rpe. delta is in unit, frames or metres; pairs are consecutive or all.",
      py::arg("reference"), py::arg("estimate"), py::arg("delta") = 1.0, py::arg("unit") = "frames",
      py::arg("pairs") = "consecutive", py::arg("max_time_difference_s") = 0.01);
  module.def(
      "recall", &recall,
      "Recall and false-positive rate over frames, each (labels, keypoints, keep). labels are uint8 (height, width):\n"
      "0 background, 255 moving, 128 a mover at rest, 64 not counted. The first frame is left out.",
      py::arg("frames"));
}

}  // namespace stillpoint_python
