// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How did the camera move, roughly?   The whole frame at once, small and blurred: a basin of a tenth of the image's
// width, for corners that only reach a few pixels on each level of their pyramid.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/frame.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/small_linear_algebra.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/depth/depth_lookup.hpp"
#include "stillpoint/depth/depth_scale.hpp"
#include "stillpoint/match/blurred_image.hpp"
#include "stillpoint/match/pyramid.hpp"
#include "stillpoint/match/static_weights.hpp"

namespace stillpoint {

/// Direct alignment of gray values by robust Gauss-Newton steps, coarse to fine, over pixels whose depth is known;
/// those without one are taken at the median depth. Gain and offset of the exposure cancel. Source: Klein and Murray,
/// "Improving the Agility of Keyframe-Based SLAM", ECCV 2008 (small blurry images); Kerl, Sturm and Cremers, "Robust
/// Odometry Estimation for RGB-D Cameras", ICRA 2013 (weights).
class CoarseAlignment {
 public:
  /// Builds the small images of the current frame. Call once for each frame, before `align`.
  void add_frame(const Pyramid& pyramid) {
    std::swap(reference_, current_);
    std::size_t level = 0;
    while (level + 1 < pyramid.size() && pyramid[level].longer_side_px() > kLongest_px) ++level;
    current_[1].assign(pyramid[level], std::size_t{1} << level, kBlur_px / 2);
    current_[1].equalize_contrast(kContrastReach_px);
    current_[0].assign_half(current_[1], kBlur_px / 2);
  }

  /// @param expected  reference_from_current, where the search begins; it begins at no motion, too, where that is
  ///                  outside of its basin
  /// @return          reference_from_current; `expected` where nothing better is found, or nothing that looks like a
  ///                  motion (`kContradiction`). O(pixels of the small images).
  template <class Camera>
  Pose align(const DepthView& depth, const ImageView& gray, const Pose& expected, const Camera& camera) {
    points_.clear();
    if (reference_[1].empty() || reference_[1].width() != current_[1].width()) return expected;
    Estimate best{expected};
    for (std::size_t level = 0; level < current_.size(); ++level) {
      collect_points(current_[level], depth, gray, camera);
      if (points_.size() < kFewestPoints) return expected;
      const Estimate found = descend(best.reference_from_current, reference_[level], camera);
      if (level == 0) {
        best = found;
        if (!(image_motion_px(expected, camera) > static_cast<double>(reference_[0].scale()))) continue;
        const Estimate resting = descend(Pose::Identity(), reference_[0], camera);
        if (resting.cost < best.cost) best = resting;
      } else {
        if (!(found.cost < cost_at(
                               expected, reference_[level], camera, [](auto&&...) {})))
          return expected;
        best = found;
      }
    }
    return best.cost > kContradiction ? expected : best.reference_from_current;
  }

  static constexpr double kContradiction = 0.6;  ///< cost: 0.2 in the median at true motions, 0.73 at others

  /// How badly a motion explains the two frames, where they stood still.
  /// @return mean loss from 0 to 1 after `align`: some 0.2 at the true motion, some 0.75 at any; 0 where nothing can be
  ///         compared
  template <class Camera>
  double cost(const Pose& reference_from_current, const Camera& camera) const {
    return points_.size() < kFewestPoints ? 0.0
                                          : cost_at(reference_from_current, reference_[1], camera, [](auto&&...) {});
  }

  /// Levels of a pyramid that has the small images of a frame: at least four, for what is no longer than 960 px.
  static std::size_t pyramid_levels(const ImageView& gray) noexcept {
    std::size_t levels = 4;
    while ((gray.longer_side_px() >> (levels - 1)) > kLongest_px) ++levels;
    return levels;
  }

  StaticWeights reference_weights;  ///< how much of the reference frame stood still

  /// Median depth of the current frame, metres.
  double typical_depth_m() const noexcept { return typical_depth_m_; }

  void reset() noexcept {
    for (auto* images : {&reference_, &current_})
      for (BlurredImage& image : *images) image.clear();
    reference_weights.clear();
    typical_depth_m_ = kRoom_m;
  }

 private:
  static constexpr double kRoom_m = 2.0;       // where no depth is known
  static constexpr int kLongest_px = 120;      // side of the finer image: 80 x 60 of 640 x 480, 60 x 80 of 480 x 640
  static constexpr float kBlur_px = 2.5f;      // standard deviation in the coarser one, as Klein and Murray's
  static constexpr int kContrastReach_px = 8;  // of the finer image
  static constexpr float kGuessWeight = 0.25f;
  static constexpr std::size_t kFewestPoints = 60;
  static constexpr int kMostSteps = 12;
  static constexpr float kCutoff = 0.6f;  // of a gray-value difference, in standard deviations of the surroundings

  struct Point {
    Vector3d point;  ///< in the current camera, metres
    float value;     ///< of the current image, normalised
    float weight;    ///< less where the depth is a guess
  };
  struct Estimate {
    Pose reference_from_current = Pose::Identity();
    double cost = 1.0;  ///< mean loss, 0 to 1
  };

  template <class Camera>
  void collect_points(const BlurredImage& image, const DepthView& depth, const ImageView& gray, const Camera& camera) {
    points_.clear();
    depths_m_.clear();
    const int step = std::max(image.width(), image.height()) > kLongest_px / 2 ? 2 : 1;
    const DepthScale to_depth(gray, depth.image);
    for (int v = 1; v + 1 < image.height(); v += step)
      for (int u = 1; u + 1 < image.width(); u += step) {
        const Vector2f pixel = image.to_full(Vector2f(static_cast<float>(u), static_cast<float>(v)));
        const double depth_m = RoundedDepth{}.at(depth, to_depth(pixel));
        if (depth_m > 0) depths_m_.push_back(depth_m);
        points_.push_back({point_at_depth(camera, pixel, 1.0) * (depth_m > 0 ? depth_m : -1.0), image.at(u, v),
                           depth_m > 0 ? 1.0f : kGuessWeight});
      }
    if (depths_m_.empty()) return points_.clear();
    typical_depth_m_ = median_in_place(span<double>(depths_m_));
    for (Point& point : points_)
      if (point.point.z() < 0) point.point *= -typical_depth_m_;
  }

  /// How far a point of the image's middle moves, or turns, pixels.
  template <class Camera>
  double image_motion_px(const Pose& motion, const Camera& camera) const {
    const Vector3d ahead(0, 0, typical_depth_m_);
    const Vector3d there = motion * ahead;
    if (!(there.z() > kNearest_m)) return std::numeric_limits<double>::infinity();
    return (camera.project(there) - camera.project(ahead)).norm();
  }

  /// The cost at a pose, and the step of Gauss and Newton from there.
  struct Step {
    double cost = 1.0;
    Vector6d increment = Vector6d::Zero();  ///< rotation vector, translation, from the left
  };

  /// Mean loss at a pose.
  /// @param visit  called for each point with a say: its place in the reference camera, the slope there, the gray-value
  ///               difference, the weight
  template <class Camera, class Visit>
  double cost_at(const Pose& pose, const BlurredImage& image, const Camera& camera, const Visit& visit) const {
    float costs = 0, weights = 0;
    for (const Point& point : points_) {
      const Vector3d there = pose * point.point;
      float value = 0;
      Vector2f pixel, slope;
      const bool is_seen = there.z() > kNearest_m && image.sample(pixel = image_pixel(camera, there), value, slope);
      if (!is_seen) {
        costs += point.weight * kUnseen;
        weights += point.weight;
        continue;
      }
      // Squared: people who fill the view have 2.8 times the room's area, at a fifth of its weight.
      const float still = reference_weights.at(pixel), prior = point.weight * still * still;
      const float residual = value - point.value;
      const float rest = std::max(1.0f - residual * residual / (kCutoff * kCutoff), 0.0f);
      costs += prior * (1.0f - rest * rest * rest);  // Tukey's loss, scaled to 1 at the cutoff and beyond
      weights += prior;
      if (rest > 0.0f) visit(there, slope, residual, rest * rest * prior);
    }
    return weights > 0 ? static_cast<double>(costs / weights) : 1.0;
  }

  template <class Camera>
  Step step_at(const Pose& pose, const BlurredImage& image, const Camera& camera) const {
    // Of each point a column: its six derivatives, its residual below. Σ weight column columnᵀ holds the normal matrix
    // and the gradient. Eight rows are two registers.
    constexpr std::size_t kUnknowns = 6, kRows = 8;
    float sums[kUnknowns][kRows] = {};
    const auto fx = static_cast<float>(camera.fx()), fy = static_cast<float>(camera.fy());
    const auto add = [&](const Vector3d& there, const Vector2f& slope, float residual, float weight) {
      // ∂value / ∂there by the chain rule; there moves by ω × there + v.
      const auto x = static_cast<float>(there.x()), y = static_cast<float>(there.y()),
                 z = static_cast<float>(there.z());
      const float gx = slope.x() * fx / z, gy = slope.y() * fy / z, gz = -(gx * x + gy * y) / z;
      const float column[kRows] = {y * gz - z * gy, z * gx - x * gz, x * gy - y * gx, gx, gy, gz, residual, 0.0f};
      for (std::size_t i = 0; i < kUnknowns; ++i)
        for (std::size_t row = 0; row < kRows; ++row) sums[i][row] += (weight * column[i]) * column[row];
    };
    Step step;
    step.cost = cost_at(pose, image, camera, add);
    Matrix6d normal;
    Vector6d gradient;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) normal(i, j) = static_cast<double>(sums[j][i]);
      gradient(i) = static_cast<double>(sums[i][kUnknowns]);
    }
    step.increment = -Cholesky<6>(damped(normal, kHold)).solve(gradient);
    return step;
  }

  template <class Camera>
  Estimate descend(const Pose& start, const BlurredImage& image, const Camera& camera) const {
    Estimate estimate{start};
    Pose pose = start;
    for (int iteration = 0; iteration < kMostSteps; ++iteration) {
      const Step step = step_at(pose, image, camera);
      const bool settled = !(step.cost < kSettled * estimate.cost) && iteration > 0;
      if (iteration == 0 || step.cost < estimate.cost) estimate = {pose, step.cost};
      const Vector3d turn = rotation_part(step.increment), shift = translation_part(step.increment);
      const double length = std::max(turn.norm(), shift.norm());
      if (settled || !(length > kShortestStep)) break;
      const double share = length > kLongestStep ? kLongestStep / length : 1.0;
      pose = orthonormalized(composed(make_pose(rotation_from_vector(share * turn), share * shift), pose));
    }
    return estimate;
  }

  static constexpr double kNearest_m = 0.1;
  static constexpr float kUnseen = 0.5f;         // loss of a point that leaves the image: neither gain nor loss
  static constexpr double kHold = 1e-3;          // keeps what nothing is known of
  static constexpr double kLongestStep = 0.15;   // radians, metres
  static constexpr double kShortestStep = 5e-4;  // radians, metres: a quarter of a pixel
  static constexpr double kSettled = 0.995;      // of the last cost: a step that gains less is the last

  std::array<BlurredImage, 2> reference_, current_;  // coarse, fine
  std::vector<Point> points_;
  std::vector<double> depths_m_;
  double typical_depth_m_ = kRoom_m;  // the last that was known
};

}  // namespace stillpoint
