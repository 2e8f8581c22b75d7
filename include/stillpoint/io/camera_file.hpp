// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The camera of a sequence: from camera.yaml, or for an original folder of the TUM benchmark from the folder's name.

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/distortion.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/io/number_format.hpp"

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

/// The fields of one camera file, each checked on the way out.
class CameraFields {
 public:
  explicit CameraFields(const std::filesystem::path& file) : file_(file.string()) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) throw Error(file_ + ": no such file");
    if (!std::filesystem::is_regular_file(file, ignored)) throw Error(file_ + ": expected a file");
    try {
      if (storage_.open(file_, cv::FileStorage::READ)) return;
    } catch (const cv::Exception& error) {
      fail_to_parse(error, 0, "YAML as OpenCV's FileStorage writes it, beginning with %YAML:1.0");
    }
    throw Error(file_ + ": cannot be read");
  }

  /// @param text  YAML as it stands in the file, without the first line that FileStorage asks for
  CameraFields(const std::filesystem::path& file, const std::string& text) : file_(file.string()) {
    try {
      if (storage_.open("%YAML:1.0\n---\n" + text, cv::FileStorage::READ | cv::FileStorage::MEMORY)) return;
    } catch (const cv::Exception& error) {
      fail_to_parse(error, 2, "YAML");
    }
    throw Error(file_ + ": cannot be read, expected YAML");
  }

  bool has(const char* field) const { return !storage_[field].empty(); }
  cv::FileNode operator[](const char* field) const { return storage_[field]; }

  double number(const char* field, const char* expected) const {
    const cv::FileNode node = storage_[field];
    if (node.empty()) fail(field, "is missing", expected);
    if (!node.isReal() && !node.isInt()) fail(field, "is not a number", expected);
    const double value = node.real();
    if (!std::isfinite(value)) fail(field, "is not finite", expected);
    return value;
  }

  double positive(const char* field, const char* expected) const {
    const double value = number(field, expected);
    if (!(value > 0)) fail(field, "is " + std::to_string(value), expected);
    return value;
  }

  int size(const char* field) const {
    constexpr double kLargest = 65535;  // what PNG and JPEG can hold, too
    const char* const expected = "a whole number of pixels from 1 to 65535";
    const double value = positive(field, expected);
    if (!(value <= kLargest) || value != std::floor(value)) fail(field, "is " + std::to_string(value), expected);
    return static_cast<int>(value);
  }

  std::string text(const char* field, const char* expected) const {
    const cv::FileNode node = storage_[field];
    if (!node.isString()) fail(field, "is not a word", expected);
    return node.string();
  }

  [[noreturn]] void fail(const std::string& field, const std::string& found, const std::string& expected) const {
    throw Error(file_ + ": " + field + " " + found + ", expected " + expected);
  }

 private:
  /// Says in which line it is: FileStorage puts "(LINE): reason" where others have the name of a function.
  /// @param lines_before  that are not in the file
  [[noreturn]] void fail_to_parse(const cv::Exception& error, int lines_before, const std::string& expected) const {
    const std::size_t end = error.func.find("): "), begin = error.func.rfind('(', end);
    std::optional<double> line;
    if (end != std::string::npos && begin != std::string::npos)
      line = parse_number(std::string_view(error.func).substr(begin + 1, end - begin - 1));
    if (!line) throw Error(file_ + ": " + error.err + ", expected " + expected);
    throw Error(file_ + ':' + std::to_string(std::max(1, static_cast<int>(*line) - lines_before)) + ": " +
                error.func.substr(end + 3) + ", expected " + expected);
  }

  std::string file_;
  cv::FileStorage storage_;
};

inline AnyDistortion read_distortion(const CameraFields& fields) {
  static constexpr const char* kModels = "pinhole, brown_conrady or equidistant";
  const auto coefficient = [&fields](const char* name) {
    return fields.number(name, "a coefficient of the lens model");
  };
  std::string given;
  for (const char* name : {"k1", "k2", "p1", "p2", "k3", "k4"})
    if (given.empty() && fields.has(name)) given = name;

  std::string model = "pinhole";
  if (fields.has("model")) {
    model = fields.text("model", kModels);
  } else if (fields.has("p1")) {
    model = "brown_conrady";  // the only one of the three with tangential coefficients
  } else if (!given.empty()) {
    fields.fail(given, "is given without a model", std::string("model: ") + kModels);
  }
  if (model == "pinhole") {
    if (!given.empty()) fields.fail(given, "is given with model pinhole", "a pinhole to have no coefficients");
    return {NoDistortion{}};
  }
  if (model == "brown_conrady") {
    if (fields.has("k4")) fields.fail("k4", "is given with model brown_conrady", "k1 k2 p1 p2 and optionally k3");
    const double k3 = fields.has("k3") ? coefficient("k3") : 0.0;
    return {BrownConrady{coefficient("k1"), coefficient("k2"), coefficient("p1"), coefficient("p2"), k3}};
  }
  if (model == "equidistant") {
    for (const char* name : {"p1", "p2"})
      if (fields.has(name)) fields.fail(name, "is given with model equidistant", "k1 k2 k3 k4");
    return {EquidistantFisheye{coefficient("k1"), coefficient("k2"), coefficient("k3"), coefficient("k4")}};
  }
  fields.fail("model", "is '" + model + "'", kModels);
}

/// `fx fy cx cy width height` and the lens.
inline Camera read_intrinsics(const CameraFields& fields) {
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

inline std::optional<double> read_baseline(const CameraFields& fields) {
  if (!fields.has("baseline_m")) return std::nullopt;
  return fields.positive("baseline_m", "the positive distance of the two cameras in metres");
}

}  // namespace detail

/// Reads camera.yaml (OpenCV's FileStorage): `fx fy cx cy` in pixels, `width height`, `depth_factor`; optionally
/// `model` (pinhole, brown_conrady with k1 k2 p1 p2 and optionally k3, or equidistant with k1 to k4; without it, p1
/// means brown_conrady and no coefficient a pinhole), and `baseline_m`, the distance in metres of the two cameras that
/// the depth is from.
/// @throws Error naming file and field, if one is missing or not a number that makes sense, the model is none of the
///         three, or coefficients are given that the model does not have.
inline RgbdCamera read_camera(const std::filesystem::path& file) {
  const detail::CameraFields fields(file);
  const Camera camera = detail::read_intrinsics(fields);
  return {camera, fields.positive("depth_factor", "the positive number that a depth image counts per metre"),
          detail::read_baseline(fields)};
}

/// Reads the same file for images without depth: `depth_factor` may be missing and is not looked at.
/// @throws Error as `read_camera`, and for a baseline that is not positive.
inline ImageCamera read_image_camera(const std::filesystem::path& file) {
  const detail::CameraFields fields(file);
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
