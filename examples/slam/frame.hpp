// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// A frame as tracking and mapping see it: features, where they lie, how far they are, and what of the map they show.

#include <opencv2/core/matx.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../backends/orb_features.hpp"
#include "../backends/spread_orb.hpp"
#include "feature_grid.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/depth/depth_noise.hpp"

namespace examples::slam {

using stillpoint::Pose;
using stillpoint::Vector2d;
using stillpoint::Vector3d;

using KeyframeId = int;
using PointId = int;
constexpr int kNone = -1;

/// An object that a detector has seen: part of what a place looks like.
struct SeenObject {
  int class_index = 0;
  double u = 0.0, v = 0.0;  ///< centre, as shares of the image's width and height
};

/// Size of a pixel of a level of ORB's pyramid.
inline double octave_scale(int octave) { return std::pow(SpreadOrb::kScale, octave); }
inline double octave_at(double scale) { return std::log(scale) / std::log(SpreadOrb::kScale); }

struct Frame {
  double timestamp_s = 0.0;
  OrbFeatures features;
  std::vector<Vector2d> pixel;         ///< undistorted
  std::vector<double> lens_stretch;    ///< undistorted pixels to one of the image there; empty without a lens
  std::vector<double> depth_m;         ///< 0 where there is none
  std::vector<PointId> point;          ///< of the map, kNone where none was found
  std::vector<cv::Vec3b> colour;       ///< BGR
  std::vector<std::uint8_t> deviates;  ///< 1: it shows a point where the map says that it can't be
  std::vector<SeenObject> objects;
  FeatureGrid grid;
  Pose camera_from_world = Pose::Identity();

  std::size_t size() const { return pixel.size(); }
  /// Nothing deviates before tracking.
  bool is_deviating(std::size_t i) const { return !deviates.empty() && deviates[i] != 0; }
  int octave(int feature) const { return features.keypoints[static_cast<std::size_t>(feature)].octave; }
  /// Undistorted pixels to one of the level of the pyramid in which the feature was found.
  double pixel_size(int feature) const {
    return octave_scale(octave(feature)) *
           (lens_stretch.empty() ? 1.0 : lens_stretch[static_cast<std::size_t>(feature)]);
  }
  const std::uint8_t* descriptor(int feature) const { return features.descriptors.ptr(feature); }
};

/// How much of a frame the map explains, 0 to 1: of the features with depth that do not deviate from it, those that
/// show a point; 1 if there are none. Squared weights are counted: a person who stands still for now may fill the
/// image, and all of it is explained. When the person goes, the map must know what was behind.
inline double explained_share(const Frame& frame) {
  double all = 0.0, explained = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (frame.is_deviating(i) || !(frame.depth_m[i] > 0)) continue;
    const double squared_weight = frame.features.weights[i] * frame.features.weights[i];
    all += squared_weight;
    if (frame.point[i] != kNone) explained += squared_weight;
  }
  return all > 0 ? explained / all : 1.0;
}

struct Keyframe : Frame {
  KeyframeId id = kNone;
};

/// How wrong a feature's pixel and depth are, one standard deviation.
struct MeasurementNoise {
  double pixel_sigma = 0.5;         ///< at full size; measured on pairs of frames whose poses are known
  double depth_sigma_factor = 3.0;  ///< times KinectNoise: depth and colour are not taken at the same moment
  stillpoint::KinectNoise depth_noise;

  /// Of a feature, undistorted pixels.
  double pixel(const Frame& frame, int feature) const { return pixel_sigma * frame.pixel_size(feature); }
  /// Of the offset between a feature and a point that so many features have placed: each of them is as wrong as it is.
  double pixel_to_point(const Frame& frame, int feature, std::size_t observations) const {
    return pixel(frame, feature) * std::sqrt(1.0 + 1.0 / static_cast<double>(std::max<std::size_t>(observations, 1)));
  }
  double depth_m(double metres) const { return depth_sigma_factor * depth_noise.sigma(metres); }
};

}  // namespace examples::slam
