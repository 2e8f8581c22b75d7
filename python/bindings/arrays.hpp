// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// NumPy's arrays as the library's types: images as views without a copy, everything else as values.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/pipeline/motion_expectation.hpp"

namespace stillpoint_python {

namespace py = pybind11;

/// As in "(480, 640)".
inline std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }
inline std::string type_text(const py::array& array) { return py::str(array.dtype()); }

/// @throws TypeError naming the argument unless it is a NumPy array
inline py::array as_array(const py::handle& object, const std::string& name, const std::string& expected) {
  if (!py::isinstance<py::array>(object))
    throw py::type_error(name + " is " + type_name(object) + ", expected " + expected);
  return py::reinterpret_borrow<py::array>(object);
}

/// True for elements of type T in the machine's byte order.
template <class T>
bool holds(const py::array& array) {
  return py::isinstance<py::array_t<T>>(array);
}

/// The rows of an array as an image: rows may have gaps between them, pixels of a row may not.
/// @param channels  of a pixel
/// @throws Error if OpenCV could not take the array as it is either
inline stillpoint::ImageView view_of(const py::array& array, const std::string& name, stillpoint::PixelFormat format,
                                     py::ssize_t channels) {
  const auto pixel_bytes = static_cast<py::ssize_t>(stillpoint::bytes_per_pixel(format));
  const py::ssize_t rows = array.shape(0), columns = array.shape(1);
  if (rows > std::numeric_limits<int>::max() || columns > std::numeric_limits<int>::max())
    throw stillpoint::Error(name + " has shape " + shape_text(array) + ", expected a side below 2^31 pixels");
  if (array.size() == 0) return {};
  const bool has_close_pixels =
      (columns == 1 || array.strides(1) == pixel_bytes) && (channels == 1 || array.strides(2) == array.itemsize());
  const bool has_rows =
      rows == 1 || (array.strides(0) >= columns * pixel_bytes && array.strides(0) % array.itemsize() == 0);
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(array.data()) % static_cast<std::size_t>(array.itemsize()) == 0;
  if (!has_close_pixels || !has_rows || !is_aligned)
    throw stillpoint::Error(
        name + " has strides " + std::string(py::str(array.attr("strides"))) +
        ", expected rows of pixels without gaps, one below the other: pass numpy.ascontiguousarray(" + name + ")");
  return {array.data(), static_cast<int>(columns), static_cast<int>(rows),
          rows == 1 ? static_cast<std::size_t>(columns * pixel_bytes) : static_cast<std::size_t>(array.strides(0)),
          format};
}

/// An 8-bit image, gray or BGR.
inline stillpoint::ImageView image_of(const py::handle& object, const std::string& name) {
  const std::string expected = "a NumPy array of uint8 with shape (height, width), or (height, width, 3) for BGR";
  const py::array array = as_array(object, name, expected);
  if (!holds<std::uint8_t>(array))
    throw py::type_error(name + " has dtype " + type_text(array) + ", expected " + expected);
  const bool is_bgr = array.ndim() == 3 && array.shape(2) == 3;
  if (array.ndim() != 2 && !is_bgr)
    throw stillpoint::Error(name + " has shape " + shape_text(array) +
                            ", expected (height, width), or (height, width, 3)");
  return view_of(array, name, is_bgr ? stillpoint::PixelFormat::bgr8 : stillpoint::PixelFormat::gray8, is_bgr ? 3 : 1);
}

/// Depth, 16 bit or float.
inline stillpoint::ImageView depth_of(const py::handle& object) {
  const std::string expected = "a NumPy array of uint16, or of float32 in metres, with shape (height, width)";
  const py::array array = as_array(object, "depth", expected);
  const bool is_raw = holds<std::uint16_t>(array);
  if (!is_raw && !holds<float>(array))
    throw py::type_error("depth has dtype " + type_text(array) + ", expected " + expected);
  if (array.ndim() != 2) throw stillpoint::Error("depth has shape " + shape_text(array) + ", expected (height, width)");
  return view_of(array, "depth", is_raw ? stillpoint::PixelFormat::depth16 : stillpoint::PixelFormat::depth32f, 1);
}

/// Pixels of an N x 2 array, or N x 1 x 2 as OpenCV's trackers give them, or of a sequence of cv2.KeyPoint.
inline std::vector<stillpoint::Vector2f> pixels_of(const py::handle& keypoints) {
  std::vector<stillpoint::Vector2f> pixels;
  if (!py::isinstance<py::array>(keypoints)) {
    if (!py::isinstance<py::sequence>(keypoints) || py::isinstance<py::str>(keypoints))
      throw py::type_error("keypoints are " + type_name(keypoints) +
                           ", expected a NumPy array of float32 with shape (N, 2), or a list of cv2.KeyPoint");
    for (const py::handle& keypoint : py::reinterpret_borrow<py::sequence>(keypoints)) {
      const py::object pixel = py::getattr(keypoint, "pt", py::none());
      if (!py::isinstance<py::tuple>(pixel) || py::len(pixel) != 2)
        throw py::type_error("keypoints[" + std::to_string(pixels.size()) + "] is " + type_name(keypoint) +
                             ", expected a cv2.KeyPoint; pixels are handed over as a NumPy array with shape (N, 2)");
      const auto [x, y] = pixel.cast<std::pair<double, double>>();
      pixels.emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
    return pixels;
  }
  const auto array = py::reinterpret_borrow<py::array>(keypoints);
  if (!holds<float>(array) && !holds<double>(array))
    throw py::type_error("keypoints have dtype " + type_text(array) + ", expected float32 or float64");
  if (array.size() == 0) return pixels;
  const bool is_list = array.ndim() == 2 && array.shape(1) == 2;
  const bool is_tracked = array.ndim() == 3 && array.shape(1) == 1 && array.shape(2) == 2;
  if (!is_list && !is_tracked)
    throw stillpoint::Error("keypoints have shape " + shape_text(array) + ", expected (N, 2)");
  const py::array_t<float, py::array::c_style | py::array::forcecast> packed(array);
  const float* const xy = packed.data();
  for (py::ssize_t i = 0; i < array.shape(0); ++i) pixels.emplace_back(xy[2 * i], xy[2 * i + 1]);
  return pixels;
}

/// A 4 x 4 matrix as a pose.
/// @throws Error if it is not finite, its last row is not 0 0 0 1 (it would be transposed, or of another kind), or its
///         3 x 3 part is no rotation
inline stillpoint::Pose pose_of(const py::handle& object, const std::string& name) {
  const py::array array = as_array(object, name, "a NumPy array with shape (4, 4)");
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
    throw stillpoint::Error(name + " has shape " + shape_text(array) + ", expected (4, 4)");
  const py::array_t<double, py::array::c_style | py::array::forcecast> packed(array);
  stillpoint::Pose pose = stillpoint::Pose::Identity();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const double number = packed.at(row, column);
      if (!std::isfinite(number))
        throw stillpoint::Error(name + " holds " + stillpoint::option_text(number) + " in row " + std::to_string(row) +
                                ", column " + std::to_string(column) + ", expected finite numbers");
      pose.matrix()(row, column) = number;
    }
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw stillpoint::Error(name + " has another last row than 0 0 0 1: is it transposed?");
  if (!stillpoint::is_rigid(pose))
    throw stillpoint::Error(name + " holds no rotation: the determinant of its 3 x 3 part is " +
                            stillpoint::option_text(pose.linear().determinant()) +
                            ", expected orthogonal columns of length 1 and a determinant of 1");
  return pose;
}

/// An array of its own with the elements `of(0)` to `of(count - 1)`.
template <class T, class Of>
py::array_t<T> array_of(std::size_t count, Of&& of) {
  py::array_t<T> array(static_cast<py::ssize_t>(count));
  T* const elements = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) elements[i] = static_cast<T>(of(i));
  return array;
}
inline py::array_t<double> array_of(const std::vector<double>& values) {
  return array_of<double>(values.size(), [&](std::size_t i) { return values[i]; });
}

template <class Matrix>
py::array_t<double> matrix_array(const Matrix& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) array.mutable_at(row, column) = matrix(row, column);
  return array;
}

/// A copy of a mask.
inline py::array_t<std::uint8_t> mask_array(const stillpoint::ImageView& mask) {
  py::array_t<std::uint8_t> array({mask.height, mask.width});
  for (int v = 0; v < mask.height; ++v)
    std::memcpy(array.mutable_data(v, 0), mask.row<std::uint8_t>(v), static_cast<std::size_t>(mask.width));
  return array;
}

}  // namespace stillpoint_python
