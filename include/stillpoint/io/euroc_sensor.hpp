// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// sensor.yaml of a EuRoC sequence: where a sensor sits on the body, and what its lens does.
//
// Layout: Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016.

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/yaml_file.hpp"

namespace stillpoint {

/// A camera on a body.
struct EurocCamera {
  Camera camera;
  Pose body_from_camera = Pose::Identity();  ///< T_BS
};

namespace detail {

/// A list of finite numbers.
inline std::vector<double> number_list(const YamlFile& fields, const char* field, const YamlNode* list,
                                       std::size_t count, const std::string& expected) {
  if (list == nullptr) fields.fail(field, "is missing", expected);
  if (list->kind != YamlNode::Kind::list) fields.fail(field, "is not a list", expected);
  const std::size_t found = list->entries.size();
  if (found != count) fields.fail(field, "has " + std::to_string(found) + " entries", expected);
  std::vector<double> numbers;
  for (const YamlNode& entry : list->entries)
    numbers.push_back(fields.finite(entry, std::string(field) + " has an entry that", expected));
  return numbers;
}

/// T_BS, four by four, row by row. What rounding left of orthonormality is made good.
inline Pose read_body_from_sensor(const YamlFile& fields) {
  constexpr double kRounding = 1e-3;  // such files have six digits or more
  const std::string expected = "a rigid transform of 4 x 4 numbers, row by row, in T_BS: data";
  const YamlNode* const matrix = fields.find("T_BS");
  if (matrix != nullptr && matrix->kind != YamlNode::Kind::map) fields.fail("T_BS", "has no data", expected);
  const auto numbers = number_list(fields, "T_BS", matrix != nullptr ? matrix->find("data") : nullptr, 16, expected);
  Pose body_from_sensor;
  body_from_sensor.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  const Matrix3d rotation = body_from_sensor.linear();
  const bool is_rigid = (rotation * rotation.transpose() - Matrix3d::Identity()).norm() < kRounding &&
                        rotation.determinant() > 0 &&
                        (body_from_sensor.matrix().row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() < kRounding;
  if (!is_rigid) fields.fail("T_BS", "is no rotation and translation", expected);
  body_from_sensor.makeAffine();
  return orthonormalized(body_from_sensor);
}

inline AnyDistortion read_sensor_lens(const YamlFile& fields) {
  const char* const models = "radial-tangential, equidistant or none";
  const std::string model = fields.text("distortion_model", models);
  if (model == "none") return {NoDistortion{}};
  const bool is_radial = model == "radial-tangential" || model == "radtan";
  if (!is_radial && model != "equidistant") fields.fail("distortion_model", "is '" + model + "'", models);
  const auto k = number_list(fields, "distortion_coefficients", fields.find("distortion_coefficients"), 4,
                             is_radial ? "the four numbers k1 k2 p1 p2" : "the four numbers k1 k2 k3 k4");
  if (is_radial) return {BrownConrady{k[0], k[1], k[2], k[3], 0.0}};
  return {EquidistantFisheye{k[0], k[1], k[2], k[3]}};
}

}  // namespace detail

/// Reads a camera's sensor.yaml: `T_BS`, `resolution`, `intrinsics` (fu fv cu cv, pixels), `distortion_model` (radial-
/// tangential, equidistant or none) and `distortion_coefficients`.
/// @throws Error naming the file, and the field or the line, for what is missing or makes no sense.
inline EurocCamera read_euroc_camera(const std::filesystem::path& file) {
  const YamlFile fields(file);
  if (fields.has("camera_model")) {
    const std::string model = fields.text("camera_model", "pinhole");
    if (model != "pinhole") fields.fail("camera_model", "is '" + model + "'", "pinhole");
  }
  const char* const size = "width and height, whole numbers of pixels from 1 to 65535";
  const auto resolution = detail::number_list(fields, "resolution", fields.find("resolution"), 2, size);
  for (const double pixels : resolution)
    if (!(pixels >= 1 && pixels <= 65535) || pixels != std::floor(pixels))
      fields.fail("resolution", "holds " + option_text(pixels), size);
  const auto f = detail::number_list(fields, "intrinsics", fields.find("intrinsics"), 4, "fu fv cu cv in pixels");
  if (!(f[0] > 0 && f[1] > 0))
    fields.fail("intrinsics", "holds " + option_text(f[0] > 0 ? f[1] : f[0]), "positive focal lengths in pixels");
  return {Camera(f[0], f[1], f[2], f[3], static_cast<int>(resolution[0]), static_cast<int>(resolution[1]),
                 detail::read_sensor_lens(fields)),
          detail::read_body_from_sensor(fields)};
}

}  // namespace stillpoint
