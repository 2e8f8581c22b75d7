// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The module stillpoint._core: errors, enums and the camera. The package stillpoint hands all of it on.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "stillpoint/io/camera_file.hpp"

namespace stillpoint_python {
namespace {

using stillpoint::Camera;

/// An enum.IntEnum of the module.
void add_enum(py::module_& module, const char* name, const py::list& names, const char* doc) {
  const py::object type =
      py::module_::import("enum").attr("IntEnum")(name, names, py::arg("module") = "stillpoint", py::arg("start") = 0);
  type.attr("__doc__") = doc;
  module.attr(name) = type;
}

/// The names of an enum's values up to the first that has none.
template <class Enum>
py::list names_of() {
  py::list names;
  for (int value = 0; std::string(to_string(static_cast<Enum>(value))) != "?"; ++value)
    names.append(to_string(static_cast<Enum>(value)));
  return names;
}

void add_enums(py::module_& module) {
  add_enum(module, "Status", names_of<stillpoint::Status>(),
           "What can be said of a frame as a whole. Every status but `ok` means: not judged, all features are kept.");
  add_enum(module, "FrameWarning", names_of<stillpoint::Warning>(),
           "What is worth knowing of a frame beside its status. No warning changes a verdict.");
  add_enum(module, "Reason", names_of<stillpoint::Reason>(), "Why a feature was kept or dropped.");
  add_enum(module, "Verdict", py::cast(std::vector<std::string>{"kept", "dynamic", "unknown"}),
           "What a feature is, as far as can be told.");
  add_enum(module, "Mobility", py::cast(std::vector<std::string>{"unknown", "fixed", "movable", "dynamic"}),
           "What is known of an object's class: a wall is fixed, a chair is movable, a person is dynamic.");
  add_enum(module, "MoverState", py::cast(std::vector<std::string>{"moving", "parked", "lost"}),
           "What an object that was seen to move does now.");
}

stillpoint::AnyDistortion lens(const std::string& model, const std::vector<double>& k) {
  const auto expect = [&](bool holds, const char* expected) {
    if (!holds)
      throw stillpoint::Error("camera: distortion has " + std::to_string(k.size()) + " coefficients with model " +
                              model + ", expected " + expected);
  };
  if (model == "pinhole") {
    expect(k.empty(), "none");
    return {stillpoint::NoDistortion{}};
  }
  if (model == "brown_conrady") {
    expect(k.size() == 4 || k.size() == 5, "k1 k2 p1 p2 and optionally k3");
    return {stillpoint::BrownConrady{k[0], k[1], k[2], k[3], k.size() > 4 ? k[4] : 0.0}};
  }
  if (model == "equidistant") {
    expect(k.size() == 4, "k1 k2 k3 k4");
    return {stillpoint::EquidistantFisheye{k[0], k[1], k[2], k[3]}};
  }
  throw stillpoint::Error("camera: model is '" + model + "', expected pinhole, brown_conrady or equidistant");
}

std::string camera_text(const Camera& camera) {
  const std::array<const char*, 3> models{"pinhole", "brown_conrady", "equidistant"};
  const auto number = [](double value) { return stillpoint::option_text(value); };
  return "Camera(fx=" + number(camera.fx()) + ", fy=" + number(camera.fy()) + ", cx=" + number(camera.cx()) +
         ", cy=" + number(camera.cy()) + ", width=" + std::to_string(camera.width()) +
         ", height=" + std::to_string(camera.height()) + ", model='" + models[camera.distortion().model.index()] + "')";
}

void bind_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera", "A camera with focal lengths and principal point in pixels.")
      .def(py::init([](double fx, double fy, double cx, double cy, int width, int height, const std::string& model,
                       const py::array_t<double, py::array::c_style | py::array::forcecast>& distortion) {
             return Camera(fx, fy, cx, cy, width, height,
                           lens(model, {distortion.data(), distortion.data() + distortion.size()}));
           }),
           "model is pinhole, brown_conrady (k1 k2 p1 p2 and optionally k3) or equidistant (k1 k2 k3 k4). "
           "distortion may be what cv2.calibrateCamera gives.",
           py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"), py::arg("width"), py::arg("height"),
           py::arg("model") = "pinhole", py::arg("distortion") = py::tuple())
      .def_property_readonly("fx", &Camera::fx)
      .def_property_readonly("fy", &Camera::fy)
      .def_property_readonly("cx", &Camera::cx)
      .def_property_readonly("cy", &Camera::cy)
      .def_property_readonly("width", &Camera::width)
      .def_property_readonly("height", &Camera::height)
      .def("__repr__", &camera_text);

  module.def(
      "read_camera",
      [](const std::filesystem::path& file) {
        const stillpoint::RgbdCamera read = stillpoint::read_camera(file);
        return py::make_tuple(read.camera, read.depth_factor);
      },
      "Reads a camera.yaml (docs/your_camera.md): the camera, and what a 16-bit depth image counts per metre.",
      py::arg("file"));
}

}  // namespace
}  // namespace stillpoint_python

PYBIND11_MODULE(_core, module) {
  using namespace stillpoint_python;
  module.attr("__version__") = STILLPOINT_VERSION;
  const py::object own_name = module.attr("__name__");
  module.attr("__name__") = "stillpoint";  // where users know the types
  py::register_exception<stillpoint::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "A wrong value: the message names it, what was found and what was expected.";
  add_enums(module);
  bind_camera(module);
  bind_options(module);
  bind_filter(module);
  bind_movers(module);
  bind_evaluation(module);
  module.attr("__name__") = own_name;
}
