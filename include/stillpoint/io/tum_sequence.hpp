// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A sequence in the layout of the TUM RGB-D benchmark: a folder with images, a camera, and what is known of them.

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/core/image.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/io/camera_file.hpp"
#include "stillpoint/io/image_file.hpp"
#include "stillpoint/io/trajectory_file.hpp"
#include "stillpoint/io/tum_frames.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint {

/// The images of one frame.
struct RgbdImages {
  cv::Mat colour;  ///< CV_8UC3, BGR; of a gray file all three channels are equal
  cv::Mat depth;   ///< CV_16UC1, `depth_factor` units a metre; another size than `colour` may be, another shape not
};

/// Opens a folder of the benchmark's layout and hands out its frames. Copies share nothing; const calls are
/// thread-safe.
class TumSequence {
 public:
  /// Reads the lists, the camera and, if it is there, groundtruth.txt; images are read by `load`.
  /// @param camera  the camera where the caller knows it. Without: camera.yaml of the folder, else the camera that an
  ///                original folder's name tells.
  /// @throws Error if the folder, a list, or the camera is missing or broken: see `read_tum_frames`, `read_camera`,
  ///         `read_trajectory`.
  explicit TumSequence(std::filesystem::path folder, std::optional<RgbdCamera> camera = std::nullopt)
      : folder_(std::move(folder)),
        list_(list_tum_frames(folder_)),
        camera_(camera ? *std::move(camera) : find_camera(folder_)) {
    if (is_there("groundtruth.txt")) ground_truth_ = read_trajectory(folder_ / "groundtruth.txt");
  }

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<TumFrame>& frames() const { return list_.frames; }
  /// Images that the lists name and that are not there: a tenth at most, and their frames are left out.
  std::size_t missing_files() const { return list_.missing_files; }
  /// Images of rgb.txt that no depth image is near in time: they are no frames.
  std::size_t images_without_depth() const { return list_.images_without_depth; }
  const Camera& camera() const { return camera_.camera; }
  double depth_factor() const { return camera_.depth_factor; }
  /// Of the two cameras that the depth is from; empty where the camera's file does not say.
  std::optional<double> baseline_m() const { return camera_.baseline_m; }

  /// Reference poses, world_from_camera; empty where the folder has none.
  const std::optional<Trajectory>& ground_truth() const { return ground_truth_; }

  /// Whether the folder has label images.
  bool has_labels() const { return is_there("labels"); }

  /// Reads the images of a frame, as they are in the file: not turned by what a camera noted in it.
  /// @param index  below `frames().size()`.
  /// @throws Error if an image cannot be read, the colour image is not of the camera's size, or the depth image is not
  ///         16 bit with one channel or of another shape than the colour image (by more than 1 %).
  RgbdImages load(std::size_t index) const {
    const TumFrame& frame = frame_at(index);
    RgbdImages images;
    images.colour = read_image(frame.colour_file, cv::IMREAD_COLOR);
    require_size(frame.colour_file, images.colour, camera());

    images.depth = read_image(frame.depth_file, cv::IMREAD_UNCHANGED);
    require_type(frame.depth_file, images.depth, CV_16UC1);
    if (!have_same_shape(images.depth, images.colour))
      throw Error(frame.depth_file.string() + ": found " + size_of(images.depth) +
                  " pixels, expected the shape of the colour image, " + size_of(images.colour));
    return images;
  }

  /// Reads labels/T.png of a frame, T being the colour file's name: CV_8UC1 of the camera's size, values of PixelLabel.
  /// @throws Error if it cannot be read or is of another type or size.
  cv::Mat load_labels(std::size_t index) const {
    const std::filesystem::path file =
        folder_ / "labels" / frame_at(index).colour_file.filename().replace_extension(".png");
    const cv::Mat labels = read_image(file, cv::IMREAD_UNCHANGED);
    require_type(file, labels, CV_8UC1);
    require_size(file, labels, camera());
    return labels;
  }

 private:
  static RgbdCamera find_camera(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "camera.yaml";
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return read_camera(file);
    if (auto camera = camera_of_tum_folder(folder)) return *std::move(camera);
    throw Error(folder.string() +
                ": found no camera, expected camera.yaml with fx fy cx cy width height depth_factor in it, freiburg1, "
                "freiburg2 or freiburg3 in its name, or a camera file given beside it");
  }

  bool is_there(const char* name) const {
    std::error_code ignored;
    return std::filesystem::exists(folder_ / name, ignored);
  }

  const TumFrame& frame_at(std::size_t index) const {
    if (index >= frames().size())
      throw Error(folder_.string() + ": frame " + std::to_string(index) + " is asked for, expected one below " +
                  std::to_string(frames().size()));
    return frames()[index];
  }

  static void require_type(const std::filesystem::path& file, const cv::Mat& image, int type) {
    if (image.type() == type) return;
    const auto describe = [](int channels, std::size_t bytes) {
      return std::to_string(channels) + " channel(s) of " + std::to_string(8 * bytes) + " bit";
    };
    throw Error(file.string() + ": found " + describe(image.channels(), image.elemSize1()) + ", expected " +
                describe(CV_MAT_CN(type), type == CV_16UC1 ? 2u : 1u));
  }

  static std::string size_of(const cv::Mat& image) {
    return std::to_string(image.cols) + " x " + std::to_string(image.rows);
  }

  std::filesystem::path folder_;
  TumFrames list_;
  RgbdCamera camera_;
  std::optional<Trajectory> ground_truth_;
};

}  // namespace stillpoint
