// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// What a host says to the shim and what it is told. C++11, plain data: it is laid out alike whatever the standard and
// the instruction set that either side is compiled for.

#include <cstddef>
#include <vector>

/// Marks what libstillpoint_shim exports; nothing else of it can be seen from outside.
#if defined(_WIN32) && defined(STILLPOINT_SHIM_IS_BUILT)
#define STILLPOINT_SHIM_API __declspec(dllexport)
#elif defined(_WIN32)
#define STILLPOINT_SHIM_API __declspec(dllimport)
#else
#define STILLPOINT_SHIM_API __attribute__((visibility("default")))
#endif

/// The front of stillpoint for hosts that are compiled as C++11 or C++14.
namespace stillpoint_shim {

/// The lens model of a camera.
enum class Lens : int {
  pinhole,        ///< none: images are undistorted
  brown_conrady,  ///< k1 k2 p1 p2 k3, as OpenCV and ORB-SLAM have them
  fisheye,        ///< k1 k2 k3 k4, equidistant (Kannala and Brandt), as in cv::fisheye
};

/// Intrinsics of the images that are handed over.
struct Camera {
  double fx = 0, fy = 0;      ///< focal lengths, pixels
  double cx = 0, cy = 0;      ///< principal point, pixels; the centre of the first pixel is 0
  int width = 0, height = 0;  ///< of the image, pixels
  Lens lens = Lens::pinhole;
  double distortion[5] = {0, 0, 0, 0, 0};  ///< in the order of the lens model; what it does not have stays 0
};

/// How wrong a depth is, as a function of the depth.
enum class DepthNoise : int {
  kinect,          ///< structured light, 1.2 mm + 1.9 mm (z / m - 0.4)²
  stereo,          ///< depth from disparity: needs `stereo_baseline_m`
  time_of_flight,  ///< 5 mm + 2 mm per metre
};

/// Settings of a filter; the defaults are those of the library.
struct Settings {
  /// Units of a 16-bit depth image per metre: 1000 for millimetres (ROS, RealSense, Azure Kinect), 5000 for TUM's
  /// files. There is no default: with 0, a frame with 16-bit depth is not judged. A float image is in metres and needs
  /// none.
  double depth_factor = 0;
  DepthNoise depth_noise = DepthNoise::kinect;
  double stereo_baseline_m = 0;            ///< for `DepthNoise::stereo` alone
  double stereo_disparity_sigma_px = 0.3;  ///< likewise
  double false_positive_rate = 0.01;       ///< share of the static features that may be dropped, 1e-6 to 0.5
  int fewest_features = 30;                ///< so many are left whatever moves; ORB-SLAM wants more than 500 to start
};

/// What is known of an object's class.
enum class Mobility : int {
  unknown,  ///< its box says nothing
  fixed,    ///< wall, table
  movable,  ///< chair, bottle: moves when it is moved
  dynamic,  ///< people, animals, cars
};

/// One answer of a detector: a rectangle with its corner (x, y) at the top left, pixels.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;
  Mobility mobility = Mobility::unknown;
  float confidence = 1;  ///< 0 to 1
};

/// The answer for one frame.
struct Result {
  std::vector<unsigned char> keep;     ///< one byte per keypoint, in their order: 1 keep, 0 drop
  std::size_t kept_count = 0;          ///< how many are 1
  bool judged = false;                 ///< false: the frame could not be judged, everything is kept
  const char* status = "first_frame";  ///< why: `to_string` of core/status.hpp, or "failed"; never freed
  bool keep_floor = false;             ///< so much was dynamic that the floor kept some of it
  const char* hint = "";               ///< what is probably used wrongly, one sentence; empty else; never freed
};

namespace detail {

/// An image of OpenCV without its class.
struct Image {
  const void* data;
  int columns, rows;
  std::size_t stride_bytes;
  int type;  ///< CV_8UC1, ...
};

/// Two floats x, y every `stride_bytes`.
struct Points {
  const void* data;
  std::size_t stride_bytes, count;
};

/// A gray image of the host's to write to.
struct Pixels {
  unsigned char* data;
  std::size_t stride_bytes;
};

/// What is said of a frame, as in `Result`.
struct Answer {
  const char *status, *hint;
  bool judged, keep_floor;
};

/// The filter behind the border; its type is complete in the library alone.
class Engine;

// The compiled border: plain data only, and no exception.

/// Null with a message where the settings are wrong.
STILLPOINT_SHIM_API Engine* create(const Camera& camera, const Settings& settings, char* message,
                                   std::size_t message_size) noexcept;
STILLPOINT_SHIM_API void destroy(Engine* engine) noexcept;
/// False with a message where the settings are wrong; then none has changed.
STILLPOINT_SHIM_API bool change_settings(Engine& engine, const Settings& settings, char* message,
                                         std::size_t message_size) noexcept;
/// Writes `points.count` bytes.
STILLPOINT_SHIM_API Answer filter_frame(Engine& engine, const Image& image, const Image& depth, double timestamp_s,
                                        const Points& points, unsigned char* keep) noexcept;
/// Of the last frame; `size` is its number of keypoints.
STILLPOINT_SHIM_API void copy_weights(const Engine& engine, float* weights, std::size_t size) noexcept;
/// Of the camera's size: 255 keeps, 0 drops.
STILLPOINT_SHIM_API void paint_mask(Engine& engine, int radius_px, const Pixels& pixels) noexcept;
STILLPOINT_SHIM_API void paint_predicted_keep_mask(Engine& engine, double timestamp_s, int margin_px,
                                                   const Pixels& pixels) noexcept;
/// @param timestamp_s  of the frame that was looked at; null: the coming one
STILLPOINT_SHIM_API void set_boxes(Engine& engine, const Box* boxes, std::size_t count,
                                   const double* timestamp_s) noexcept;
/// 4 x 4, row by row; false if it is no rigid motion.
STILLPOINT_SHIM_API bool feedback(Engine& engine, const double* world_from_camera) noexcept;
STILLPOINT_SHIM_API bool expect_motion(Engine& engine, const double* current_from_reference) noexcept;
STILLPOINT_SHIM_API void reset(Engine& engine) noexcept;
STILLPOINT_SHIM_API Mobility mobility_of(const char* class_name) noexcept;

}  // namespace detail
}  // namespace stillpoint_shim
