// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// FrameFilter and what it answers.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/prior/propagated_prior.hpp"

namespace stillpoint_python {
namespace {

using stillpoint::Detection;
using stillpoint::FrameResult;
using stillpoint::ImageBuffer;

/// A copy of a frame's result, with its features as arrays of their own.
struct Result {
  explicit Result(FrameResult copy) : shared(std::make_shared<const FrameResult>(std::move(copy))), frame(*shared) {
    const std::size_t size = frame.size();
    std::vector<float> weight;
    stillpoint::weights(frame, weight);
    keep = array_of<bool>(size, [&](std::size_t i) { return frame.keep()[i] != 0; });
    verdicts = array_of<std::uint8_t>(size, [&](std::size_t i) { return frame.label(i).verdict; });
    reasons = array_of<std::uint8_t>(size, [&](std::size_t i) { return frame.label(i).reason; });
    scores = array_of<float>(size, [&](std::size_t i) { return frame.score(i).value; });
    probabilities = array_of<float>(size, [&](std::size_t i) { return frame.label(i).probability; });
    clusters = array_of<std::int32_t>(size, [&](std::size_t i) { return frame.label(i).cluster; });
    depths_m = array_of<double>(size, [&](std::size_t i) { return frame.depth_m(i); });
    weights = array_of<float>(size, [&](std::size_t i) { return weight[i]; });
    mover_of = array_of<std::int32_t>(
        size, [&](std::size_t i) { return frame.mover(i) == nullptr ? -1 : frame.mover(i) - frame.movers().data(); });
    movers = movers_of(shared);
  }

  std::shared_ptr<const FrameResult> shared;
  const FrameResult& frame;
  py::array keep, verdicts, reasons, scores, probabilities, clusters, depths_m, weights, mover_of;
  py::tuple movers;
};

py::array mask_of(const Result& result, int radius_px) {
  ImageBuffer mask;
  result.frame.mask(mask, radius_px);
  return mask_array(mask.view());
}

py::tuple warnings_of(const Result& result) {
  py::list warnings;
  result.frame.warnings().for_each(
      [&](stillpoint::Warning warning) { warnings.append(member("FrameWarning", warning)); });
  return py::tuple(warnings);
}

py::dict timings_of(const Result& result) {
  py::dict timings;
  for (std::size_t i = 0; i < stillpoint::kStageCount; ++i)
    timings[to_string(static_cast<stillpoint::Stage>(i))] = result.frame.timings().ms[i];
  return timings;
}

std::string result_text(const Result& result) {
  std::string text = "<FrameResult: " + std::string(to_string(result.frame.status())) + ", keeps " +
                     std::to_string(result.frame.kept_count()) + " of " + std::to_string(result.frame.size()) +
                     " features";
  result.frame.warnings().for_each(
      [&](stillpoint::Warning warning) { text += std::string(", ") + to_string(warning); });
  return text + '>';
}

void require(bool is_right, const char* name, float value, const char* expected) {
  if (!is_right)
    throw stillpoint::Error(std::string(name) + " is " + stillpoint::option_text(value) + ", expected " + expected);
}

Detection detection_of(float x, float y, float width, float height, int mobility, float confidence,
                       const py::object& mask, std::int16_t class_index) {
  if (mobility < 0 || mobility > static_cast<int>(stillpoint::Mobility::dynamic))
    throw stillpoint::Error("mobility is " + std::to_string(mobility) + ", expected a stillpoint.Mobility");
  require(std::isfinite(x), "x", x, "a finite number of pixels");
  require(std::isfinite(y), "y", y, "a finite number of pixels");
  require(std::isfinite(width) && width >= 0, "width", width, "0 or more pixels");
  require(std::isfinite(height) && height >= 0, "height", height, "0 or more pixels");
  require(confidence >= 0 && confidence <= 1, "confidence", confidence, "a number from 0 to 1");
  Detection detection;
  detection.box = {x, y, width, height};
  detection.mobility = static_cast<stillpoint::Mobility>(mobility);
  detection.confidence = confidence;
  detection.class_index = class_index;
  if (mask.is_none()) return detection;
  const std::string expected = "a NumPy array of bool or uint8 with shape (rows, columns)";
  const py::array cells = as_array(mask, "mask", expected);
  if (!holds<bool>(cells) && !holds<std::uint8_t>(cells))
    throw py::type_error("mask has dtype " + type_text(cells) + ", expected " + expected);
  constexpr py::ssize_t kMostCells = 1 << 26;
  if (cells.ndim() != 2 || cells.size() == 0 || cells.size() > kMostCells)
    throw stillpoint::Error("mask has shape " + shape_text(cells) + ", expected (rows, columns) with 1 to " +
                            std::to_string(kMostCells) + " cells");
  const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast> packed(cells);
  stillpoint::BoxMask inside;
  inside.rows = static_cast<int>(cells.shape(0));
  inside.columns = static_cast<int>(cells.shape(1));
  inside.inside.assign(packed.data(), packed.data() + packed.size());
  detection.mask = std::make_shared<const stillpoint::BoxMask>(std::move(inside));
  return detection;
}

stillpoint::FrameView frame_of(const py::object& image, const py::object& depth, double timestamp_s,
                               const std::optional<double>& depth_factor) {
  stillpoint::FrameView frame;
  const stillpoint::ImageView view = image_of(image, "image");
  (view.format == stillpoint::PixelFormat::bgr8 ? frame.colour : frame.gray) = view;
  frame.timestamp_s = timestamp_s;
  if (depth.is_none()) return frame;
  frame.depth = stillpoint::DepthView(depth_of(depth), depth_factor.value_or(0.0));
  const bool is_raw = frame.depth.image.format == stillpoint::PixelFormat::depth16;
  if (is_raw && !stillpoint::DepthView::is_unit(frame.depth.factor))
    throw stillpoint::Error(
        "depth_factor is " + (depth_factor ? stillpoint::option_text(*depth_factor) : "missing") +
        ", expected what a depth of uint16 counts per metre, 0.001 to 1000000: 1000 for millimetres (ROS, RealSense, "
        "Azure Kinect), 5000 for the TUM benchmark");
  if (!is_raw && !frame.depth.empty() && depth_factor)
    throw stillpoint::Error("depth_factor is " + stillpoint::option_text(*depth_factor) +
                            " for a depth of float32, expected none: it is in metres");
  return frame;
}

Result filter_frame(Filter& self, const py::object& image, const py::object& depth, double timestamp_s,
                    const py::object& keypoints, const std::optional<double>& depth_factor) {
  const stillpoint::FrameView frame = frame_of(image, depth, timestamp_s, depth_factor);
  const std::vector<stillpoint::Vector2f> pixels = pixels_of(keypoints);
  return Result(self.without_gil(
      [&](stillpoint::FrameFilter<>& filter) { return FrameResult(filter.filter_frame(frame, pixels)); }));
}

py::array predicted_keep_mask(Filter& self, double timestamp_s, int margin_px) {
  ImageBuffer mask;
  self.without_gil(
      [&](stillpoint::FrameFilter<>& filter) { filter.predicted_keep_mask(timestamp_s, margin_px, mask); });
  return mask_array(mask.view());
}

void feedback(Filter& self, const py::object& world_from_camera) {
  const stillpoint::Pose pose = pose_of(world_from_camera, "world_from_camera");
  self.without_gil([&](stillpoint::FrameFilter<>& filter) { filter.feedback(pose); });
}

void expect_motion(Filter& self, const py::object& current_from_reference) {
  const stillpoint::Pose pose = pose_of(current_from_reference, "current_from_reference");
  if (!stillpoint::is_plausible_motion(pose))
    throw stillpoint::Error("current_from_reference moves by more than 100 m, expected metres from frame to frame");
  self.without_gil([&](stillpoint::FrameFilter<>& filter) { filter.expect_motion(pose); });
}

void bind_result(py::module_& module) {
  using stillpoint::Motion;
  py::class_<Motion>(module, "Motion", "How the camera moved between the reference frame and the current one.")
      .def_property_readonly("status", [](const Motion& motion) { return member("Status", motion.status); })
      .def_property_readonly(
          "current_from_reference",
          [](const Motion& motion) { return matrix_array(motion.current_from_reference.matrix()); },
          "4 x 4, metres: p_current = current_from_reference @ p_reference.")
      .def_property_readonly(
          "covariance", [](const Motion& motion) { return matrix_array(motion.covariance); },
          "6 x 6, of a small rotation (radians, first three) and translation (metres) after the pose.")
      .def_readonly("reference_timestamp_s", &Motion::reference_timestamp_s)
      .def_readonly("metric", &Motion::metric, "False: the translation has no scale.")
      .def_readonly("stationary", &Motion::stationary, "The camera did not move at all.")
      .def_property_readonly(
          "standing",
          [](const Motion& motion) {
            if (PyErr_WarnEx(PyExc_DeprecationWarning, "Motion.standing is Motion.stationary; gone in 0.4", 1) != 0)
              throw py::error_already_set();
            return motion.stationary;
          },
          "Deprecated: `stationary`.")
      .def_readonly("candidates", &Motion::candidates, "Matches that took part.")
      .def_readonly("inliers", &Motion::inliers, "Of them, those that the motion explains.");

  py::class_<Result>(module, "FrameResult",
                     "The answer for one frame: arrays with one entry per keypoint, in their order. It owns them.")
      .def_readonly("keep", &Result::keep, "True keeps the feature.")
      .def_readonly("verdicts", &Result::verdicts, "Values of Verdict.")
      .def_readonly("reasons", &Result::reasons, "Values of Reason.")
      .def_readonly("scores", &Result::scores,
                    "Disagreement with the camera's motion; NaN where the feature was not scored.")
      .def_readonly("probabilities", &Result::probabilities, "That the feature moves, 0 to 1; NaN if unknown.")
      .def_readonly("weights", &Result::weights, "Its weight in an estimate of the pose, 0 to 1.")
      .def_readonly("clusters", &Result::clusters, "Index of its cluster, -1 for none.")
      .def_readonly("depths_m", &Result::depths_m, "Its depth in metres, 0 for none.")
      .def_readonly("movers", &Result::movers,
                    "The objects that move, or moved and are parked; empty without FrameFilter(camera, movers=True).")
      .def_readonly("mover_of", &Result::mover_of, "Index in movers of the object that the feature is on, -1 for none.")
      .def_property_readonly("status", [](const Result& result) { return member("Status", result.frame.status()); })
      .def_property_readonly("warnings", &warnings_of, "What is worth knowing beside the status.")
      .def_property_readonly(
          "hint", [](const Result& result) { return std::string(result.frame.hint()); },
          "What is probably wrong with the way the filter is used, one sentence; empty where nothing is.")
      .def_property_readonly(
          "motion", [](const Result& result) { return result.frame.motion(); },
          "The camera's motion that the verdicts assumed.")
      .def_property_readonly("timings_ms", &timings_of, "Milliseconds that each stage took.")
      .def_property_readonly("kept_count", [](const Result& result) { return result.frame.kept_count(); })
      .def_property_readonly(
          "keep_floor_kept", [](const Result& result) { return result.frame.keep_floor_kept(); },
          "How many dynamic features the keep-floor kept.")
      .def("mask", &mask_of, "Of the image's size: 255 keeps, 0 within radius_px of a dropped feature.",
           py::arg("radius_px") = 12)
      .def("__len__", [](const Result& result) { return result.frame.size(); })
      .def("__repr__", &result_text);
}

}  // namespace

void bind_filter(py::module_& module) {
  bind_result(module);

  py::class_<Detection>(
      module, "Detection",
      "What a detector saw: a box in pixels, corner (x, y) at the top left, and perhaps a mask that is\n"
      "stretched over it.")
      .def(py::init(&detection_of), py::arg("x"), py::arg("y"), py::arg("width"), py::arg("height"),
           py::arg("mobility") = static_cast<int>(stillpoint::Mobility::dynamic), py::arg("confidence") = 1.0f,
           py::arg("mask") = py::none(), py::arg("class_index") = -1);

  py::class_<Filter, std::shared_ptr<Filter>>(module, "FrameFilter",
                                              "Tells which of a frame's features stand still, with DefaultPolicies. "
                                              "One filter for one camera. Threads may share\n"
                                              "it: calls wait for each other, and other threads run meanwhile.")
      .def(py::init<const stillpoint::Camera&, bool>(),
           "With movers, results also say which objects move, and how (docs/movers.md).", py::arg("camera"),
           py::arg("movers") = false)
      .def("filter_frame", &filter_frame,
           "Judges the keypoints of a frame. Call it before the tracker, with frames in the order of time.\n\n"
           "image         uint8, (height, width) gray or (height, width, 3) BGR; not copied\n"
           "depth         uint16 with depth_factor, or float32 in metres, aligned to the image; or None; not copied\n"
           "timestamp_s   seconds, growing\n"
           "keypoints     float32 (N, 2) in pixels of the image as it is, or a list of cv2.KeyPoint\n"
           "depth_factor  what a depth of uint16 counts per metre: 1000 for millimetres, 5000 for TUM's files\n\n"
           "A frame that can't be judged has a status that says why, and keeps everything.",
           py::arg("image"), py::arg("depth"), py::arg("timestamp_s"), py::arg("keypoints"),
           py::arg("depth_factor") = py::none())
      .def("predicted_keep_mask", &predicted_keep_mask,
           "Where the coming frame should be looked at: of the camera's size, 255 keeps, 0 drops.",
           py::arg("timestamp_s"), py::arg("margin_px") = 8)
      .def("feedback", &feedback, "The tracker's own pose of the frame that was filtered last, 4 x 4.",
           py::arg("world_from_camera"))
      .def("expect_motion", &expect_motion, "What an IMU or wheels say of the coming motion, 4 x 4; for one frame.",
           py::arg("current_from_reference"))
      .def(
          "detected",
          [](Filter& self, double timestamp_s, const std::vector<Detection>& detections) {
            self.without_gil(
                [&](stillpoint::FrameFilter<>& filter) { filter.prior.detected(timestamp_s, detections); });
          },
          "A detector's answer for the frame of that time, the coming one or one that is past. An empty list says "
          "that\n"
          "it saw nothing.",
          py::arg("timestamp_s"), py::arg("detections"))
      .def(
          "reset", [](Filter& self) { self.without_gil([](stillpoint::FrameFilter<>& filter) { filter.reset(); }); },
          "Forgets all frames: where the images jump to another place, as when a recording begins again. Not for a\n"
          "relocalisation or a new map of the host: the images go on. Options stay.")
      .def_property_readonly("options", &options_of, "The options of all stages, as attributes.")
      .def(
          "read_options",
          [](Filter& self, const std::filesystem::path& file) {
            self.with_options([&](auto& filter) { stillpoint::read_options(file, filter); });
          },
          "Sets the options that a YAML file names; the others stay.", py::arg("file"))
      .def(
          "write_options",
          [](Filter& self, const std::filesystem::path& file) {
            self.with_options([&](auto& filter) { stillpoint::write_options(file, filter); });
          },
          "Writes all options as YAML.", py::arg("file"));
}

}  // namespace stillpoint_python
