// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// FrameResult.movers: the moving objects, where they are and how they move.

#include <cstdint>
#include <memory>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"

namespace stillpoint_python {
namespace {

using stillpoint::FrameResult;

/// A mover of a result, which it keeps.
struct Mover {
  std::shared_ptr<const FrameResult> frame;
  const stillpoint::Mover* mover;

  const stillpoint::Mover* operator->() const { return mover; }
};

py::array mover_mask(const Mover& mover, int radius_px) {
  stillpoint::ImageBuffer mask;
  mover.frame->mask(*mover.mover, mask, radius_px);
  return mask_array(mask.view());
}

py::array mover_features(const Mover& mover) {
  const stillpoint::span<const std::uint32_t> features = mover.frame->features(*mover.mover);
  return array_of<std::int64_t>(features.size(), [&](std::size_t k) { return features[k]; });
}

py::tuple mover_box(const Mover& mover) {
  return py::make_tuple(mover->box.x, mover->box.y, mover->box.width, mover->box.height);
}

std::string mover_text(const Mover& mover) {
  const auto number = [](double value) { return stillpoint::format_fixed(value, 2); };
  const stillpoint::Vector3d& at = mover->centroid;
  return "<Mover " + std::to_string(mover->id) + ": " + to_string(mover->state) + ", at (" + number(at.x()) + ", " +
         number(at.y()) + ", " + number(at.z()) + ") m, " + number(mover->velocity.norm()) + " m/s>";
}

py::array vector_array(const stillpoint::Vector3d& vector) {
  return array_of<double>(3, [&](std::size_t i) { return vector[static_cast<Eigen::Index>(i)]; });
}

}  // namespace

py::tuple movers_of(const std::shared_ptr<const FrameResult>& frame) {
  py::list movers;
  for (const stillpoint::Mover& mover : frame->movers()) movers.append(Mover{frame, &mover});
  return py::tuple(movers);
}

void bind_movers(py::module_& module) {
  py::class_<Mover>(module, "Mover",
                    "An object that moves, or moved and is parked. Vectors are in the axes of the current camera: x "
                    "right, y\ndown, z forward.")
      .def_property_readonly(
          "id", [](const Mover& mover) { return mover->id; },
          "From 1 on; kept while the object is seen and for two seconds after.")
      .def_property_readonly(
          "state", [](const Mover& mover) { return member("MoverState", mover->state); },
          "Moving, parked, or lost: not seen in this frame, all else is predicted.")
      .def_property_readonly("box", &mover_box, "x, y, width and height around its features, pixels.")
      .def_property_readonly(
          "centroid", [](const Mover& mover) { return vector_array(mover->centroid); },
          "Of its points, in the current camera, metres.")
      .def_property_readonly(
          "extent_m", [](const Mover& mover) { return vector_array(mover->extent_m); },
          "Of its points along the camera's axes.")
      .def_property_readonly(
          "velocity", [](const Mover& mover) { return vector_array(mover->velocity); },
          "Of the centroid relative to the world, m/s, by the filter's own motion.")
      .def_property_readonly(
          "velocity_covariance", [](const Mover& mover) { return matrix_array(mover->velocity_covariance); },
          "3 x 3, (m/s)².")
      .def_property_readonly(
          "current_from_reference",
          [](const Mover& mover) { return matrix_array(mover->current_from_reference.matrix()); },
          "4 x 4, metres: where a point of the object in the last frame's camera is in the current one.")
      .def_property_readonly(
          "covariance", [](const Mover& mover) { return matrix_array(mover->covariance); },
          "6 x 6, of a small rotation (radians, first three) and translation (metres) after that pose.")
      .def_property_readonly(
          "has_rotation", [](const Mover& mover) { return mover->has_rotation; },
          "Its points move rigidly and determine a rotation; otherwise it keeps its orientation in the world.")
      .def_property_readonly(
          "class_index", [](const Mover& mover) { return mover->class_index; },
          "That of the detection that holds most of its features; -1 where none does.")
      .def_property_readonly(
          "confidence", [](const Mover& mover) { return mover->confidence; }, "Of that detection, 0 to 1.")
      .def_property_readonly("first_seen_s", [](const Mover& mover) { return mover->first_seen_s; })
      .def_property_readonly("last_seen_s", [](const Mover& mover) { return mover->last_seen_s; })
      .def_property_readonly("features", &mover_features, "Indices of its keypoints.")
      .def("mask", &mover_mask,
           "Of the image's size: 0 within radius_px of its features and of the filter's own corners on it, 255 "
           "elsewhere.",
           py::arg("radius_px") = 12)
      .def("__repr__", &mover_text);
}

}  // namespace stillpoint_python
