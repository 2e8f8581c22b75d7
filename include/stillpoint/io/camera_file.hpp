// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The camera of a sequence: from camera.yaml, or for an original folder of the TUM benchmark from the folder's name.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/io/yaml_file.hpp"

namespace stillpoint {

/// A camera and the unit of its depth images.
struct RgbdCamera {
  Camera camera;
  double depth_factor = 5000.0;                     ///< what a 16-bit depth image counts per metre
  std::optional<double> baseline_m = std::nullopt;  ///< of depth from two cameras, where it is known
};

/// A camera without depth images, the left one of a rectified pair where there is a baseline.
struct ImageCamera {
  Camera camera;
  std::optional<double> baseline_m;  ///< from the left camera to the right one
};

namespace detail {

/// Whether a field has the name of a coefficient, of this lens or another: k or p, and a number.
inline bool is_coefficient(std::string_view name) {
  return name.size() > 1 && (name[0] == 'k' || name[0] == 'p') &&
         name.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

/// Whether a field names a lens in another way: K1, D, a list of coefficients.
inline bool is_foreign_lens(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_capital = is_coefficient(name) && name[0] == 'k';  // P1 may be a projection matrix
  return is_capital || name == "d" || name == "dist" || name == "distortion" || name.find("coef") != std::string::npos;
}

/// Refuses every coefficient but those of the model.
inline void require_coefficients_of(const YamlFile& fields, std::string_view model,
                                    std::initializer_list<std::string_view> own, const char* expected) {
  for (const YamlNode& field : fields.root().entries)
    if (is_coefficient(field.name) && std::find(own.begin(), own.end(), field.name) == own.end())
      fields.fail(field.name, "is given with model " + std::string(model), expected);
}

inline AnyDistortion read_distortion(const YamlFile& fields) {
  static constexpr const char* kModels = "pinhole, brown_conrady or equidistant";
  const auto coefficient = [&fields](const char* name) {
    return fields.number(name, "a coefficient of the lens model");
  };
  std::string given;
  for (const YamlNode& field : fields.root().entries) {
    if (is_coefficient(field.name)) {
      if (given.empty()) given = field.name;
    } else if (is_foreign_lens(field.name)) {
      fields.fail(field.name, "is not read", "k1 k2 p1 p2 and optionally k3, or model: equidistant and k1 k2 k3 k4");
    }
  }

  std::string model = "pinhole";
  if (fields.has("model")) {
    model = fields.text("model", kModels);
  } else if (fields.has("p1")) {
    model = "brown_conrady";  // the only one of the three with tangential coefficients
  } else if (!given.empty()) {
    fields.fail(given, "is given without a model", std::string("model: ") + kModels);
  }
  if (model == "pinhole") {
    require_coefficients_of(fields, model, {}, "a pinhole to have no coefficients");
    return {NoDistortion{}};
  }
  if (model == "brown_conrady") {
    require_coefficients_of(fields, model, {"k1", "k2", "p1", "p2", "k3"}, "k1 k2 p1 p2 and optionally k3");
    const double k3 = fields.has("k3") ? coefficient("k3") : 0.0;
    return {BrownConrady{coefficient("k1"), coefficient("k2"), coefficient("p1"), coefficient("p2"), k3}};
  }
  if (model == "equidistant") {
    require_coefficients_of(fields, model, {"k1", "k2", "k3", "k4"}, "k1 k2 k3 k4");
    return {EquidistantFisheye{coefficient("k1"), coefficient("k2"), coefficient("k3"), coefficient("k4")}};
  }
  fields.fail("model", "is '" + model + "'", kModels);
}

/// `fx fy cx cy width height` and the lens.
inline Camera read_intrinsics(const YamlFile& fields) {
  const char* const focal_length = "a positive focal length in pixels";
  const char* const principal_point = "a finite principal point in pixels";
  const double fx = fields.positive("fx", focal_length);
  const double fy = fields.positive("fy", focal_length);
  const double cx = fields.number("cx", principal_point);
  const double cy = fields.number("cy", principal_point);
  const int width = fields.size("width");
  const int height = fields.size("height");
  return Camera(fx, fy, cx, cy, width, height, read_distortion(fields));
}

inline std::optional<double> read_baseline(const YamlFile& fields) {
  if (!fields.has("baseline_m")) return std::nullopt;
  return fields.positive("baseline_m", "the positive distance of the two cameras in metres");
}

}  // namespace detail

/// Reads camera.yaml, with or without the first line of OpenCV's FileStorage: `fx fy cx cy` in pixels, `width height`,
/// `depth_factor`; optionally `model` (pinhole, brown_conrady with k1 k2 p1 p2 and optionally k3, or equidistant with
/// k1 to k4; without it, p1 means brown_conrady and no coefficient a pinhole), and `baseline_m`, the distance in metres
/// of the two cameras that the depth is from.
/// Other fields are for other programs and are not looked at.
/// @throws Error naming file and field, if one is missing or not a number that makes sense, the model is none of the
///         three, or coefficients are given that the model does not have or that are spelled otherwise (`K1`, `D`,
///         `distortion`, `dist_coeffs`).
inline RgbdCamera read_camera(const std::filesystem::path& file) {
  const YamlFile fields(file);
  const Camera camera = detail::read_intrinsics(fields);
  const double factor = fields.positive("depth_factor", "the positive number that a depth image counts per metre");
  if (!DepthView::is_unit(factor))
    fields.fail("depth_factor", "is " + option_text(factor), "what a depth image counts per metre: 0.001 to 1000000");
  return {camera, factor, detail::read_baseline(fields)};
}

/// Reads the same file for images without depth: `depth_factor` may be missing and is not looked at.
/// @throws Error as `read_camera`, and for a baseline that is not positive.
inline ImageCamera read_image_camera(const std::filesystem::path& file) {
  const YamlFile fields(file);
  return {detail::read_intrinsics(fields), detail::read_baseline(fields)};
}

/// The camera of an original folder of the TUM RGB-D benchmark, told by `freiburg1`, `freiburg2` or `freiburg3` in the
/// folder's name. Source: the benchmark's published calibration of the colour cameras (Sturm et al., IROS 2012).
/// @return        empty where the name says nothing.
inline std::optional<RgbdCamera> camera_of_tum_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(folder, ignored).lexically_normal();
  const std::string name = (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
  const auto says = [&name](const char* word) { return name.find(word) != std::string::npos; };
  constexpr double kDepthFactor = 5000.0;
  if (says("freiburg1"))
    return RgbdCamera{
        Camera(517.3, 516.5, 318.6, 255.3, 640, 480, {BrownConrady{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}}),
        kDepthFactor};
  if (says("freiburg2"))
    return RgbdCamera{
        Camera(520.9, 521.0, 325.1, 249.7, 640, 480, {BrownConrady{0.2312, -0.7849, -0.0033, -0.0001, 0.9172}}),
        kDepthFactor};
  if (says("freiburg3")) return RgbdCamera{Camera(535.4, 539.2, 320.1, 247.6, 640, 480), kDepthFactor};
  return std::nullopt;
}

}  // namespace stillpoint
