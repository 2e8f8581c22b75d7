// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How badly does a feature disagree with the camera's motion, when there is no depth?   By its distance from the
// epipolar line, and by where on that line it is.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stillpoint/core/capabilities.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/options.hpp"
#include "stillpoint/core/score.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"

namespace stillpoint {

/// A log-likelihood ratio, moving against static, nats. A static point lies on its epipolar line (Sampson's
/// distance, one degree of freedom) and on that side of the point at infinity on which it is before the camera. What
/// moves along its line towards nearer depths looks like something near: it is not found. Where the camera only turned
/// there are no lines; a point is expected where the rotation takes it, give or take a little parallax.
class SampsonScore {
 public:
  using Needs = Capabilities<capability::feature_matches, capability::subpixel_motion>;
  using Provides = Capabilities<capability::log_likelihoods>;

  struct Options {
    double least_pixel_sigma = 0.5;   ///< of a match, pixels; measured in each frame on likely static matches
    double most_pixel_sigma = 1.0;    ///< where it is more, the motion does not explain the frame: nothing is scored
    double turned_parallax_px = 1.0;  ///< what a step that was too small for a direction may still move a near point
    double most_evidence = 8.0;       ///< −log of the share of bad matches: no pair of frames decides alone
    double expected = 0.5;            ///< what a static point scores on average: half a squared sigma
    float least_static_prior = 0.5f;  ///< of a match by which noise is measured
  };
  Options options;

  /// Scores the features that are matched; the others keep NaN.
  template <class Camera>
  void score(const Observations& observations, const Motion& motion, const Camera& camera, span<FeatureScore> scores) {
    const Matches& matches = observations.matches;
    const Geometry<Camera> geometry(motion, camera);
    distances_.clear();
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (matches.matched(i) && observations.remembered.static_prior[i] >= options.least_static_prior)
        distances_.push_back(geometry.pair(matches, i).distance_px());
    if (distances_.size() < kFewestMatches) return;
    const double measured_px = kMadToSigma * median_in_place(span<double>(distances_));
    if (!(measured_px <= options.most_pixel_sigma)) return;
    const double sigma_px = std::max(measured_px, options.least_pixel_sigma);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.matched(i)) continue;
      const auto pair = geometry.pair(matches, i);
      double distance_px = pair.distance_px();
      if (!geometry.has_lines()) distance_px = std::max(distance_px - options.turned_parallax_px, 0.0);
      const double variance_px = sigma_px * sigma_px + pair.pose_variance_px();
      const double behind = pair.sigmas_behind(std::sqrt(variance_px));
      const double squared = distance_px * distance_px / variance_px + behind * behind;
      if (!std::isfinite(squared)) continue;  // at the epipole there is no line
      scores[i].value = static_cast<float>(std::min(0.5 * squared, options.most_evidence) - options.expected);
    }
  }

 private:
  static constexpr std::size_t kFewestMatches = 20;

  /// Two views without a scale.
  template <class Camera>
  class Geometry {
   public:
    Geometry(const Motion& motion, const Camera& camera)
        : camera_(camera),
          focal_px_(0.5 * (camera.fx() + camera.fy())),
          rotation_(motion.current_from_reference.linear()),
          direction_(motion.current_from_reference.translation()),
          covariance_(motion.covariance) {
      const double length = direction_.norm();
      has_lines_ = !motion.warnings.has(Warning::rotation_only) && length > 0;
      if (has_lines_) direction_ /= length;
    }

    bool has_lines() const noexcept { return has_lines_; }

    /// A match as rays (z = 1), the reference's turned into the current camera, with the epipolar lines of both.
    class EpipolarPair {
     public:
      EpipolarPair(const Geometry& geometry, const Vector3d& reference_ray, const Vector3d& current_ray)
          : geometry_(geometry),
            turned_(geometry.rotation_ * reference_ray),
            seen_(current_ray),
            across_(seen_.cross(geometry.direction_)),
            line_(geometry.direction_.cross(turned_)) {
        const Vector3d reference_line = geometry.rotation_.transpose() * across_;
        slope_sq_ = line_.head<2>().squaredNorm() + reference_line.head<2>().squaredNorm();
      }

      /// From the epipolar line (Sampson, 1982), or from where the rotation takes the point. Pixels.
      double distance_px() const {
        const double focal_px = geometry_.focal_px_;
        if (!geometry_.has_lines_)
          return turned_.z() > 0 ? focal_px * (turned_.head<2>() / turned_.z() - seen_.head<2>()).norm() : kFar_px;
        return focal_px * std::abs(seen_.dot(line_)) / std::sqrt(slope_sq_);
      }

      /// What the motion's own uncertainty moves that distance, squared pixels. The derivative of c · (t × R p) by a
      /// small rotation and translation after the motion is ((t × R p) × c, R p × c).
      double pose_variance_px() const {
        const double focal_px = geometry_.focal_px_;
        const Matrix6d& covariance = geometry_.covariance_;
        if (!geometry_.has_lines_) return focal_px * focal_px * covariance.topLeftCorner<3, 3>().trace() / 3.0;
        Vector6d derivative;
        derivative << line_.cross(seen_), turned_.cross(seen_);
        return focal_px * focal_px * derivative.dot(covariance * derivative) / slope_sq_;
      }

      /// How many standard deviations its inverse depth is below zero; 0 for a point before the camera.
      double sigmas_behind(double sigma_px) const {
        if (!geometry_.has_lines_) return 0.0;
        // seen × (turned + ρ t) = 0
        const double inverse_depth = -seen_.cross(turned_).dot(across_) / across_.squaredNorm();
        const double sigma = std::sqrt(2.0) * sigma_px / geometry_.focal_px_ / across_.norm();
        return std::max(-inverse_depth / sigma, 0.0);
      }

     private:
      static constexpr double kFar_px = 1e3;

      const Geometry& geometry_;
      Vector3d turned_, seen_, across_, line_;  // across: seen × t
      double slope_sq_;                         // of the error seen · line, by both rays
    };

    EpipolarPair pair(const Matches& matches, std::size_t i) const {
      return {*this, camera_.back_project(matches.reference.undistorted[i], 1.0),
              camera_.back_project(matches.current.undistorted[i], 1.0)};
    }

   private:
    const Camera& camera_;
    double focal_px_;
    Matrix3d rotation_;
    Vector3d direction_;
    Matrix6d covariance_;
    bool has_lines_;
  };

  std::vector<double> distances_;
};

template <class Visit>
void each_option(SampsonScore& stage, Visit& visit) {
  visit("least_pixel_sigma", stage.options.least_pixel_sigma, OptionRange{0.01, 100});
  visit("most_pixel_sigma", stage.options.most_pixel_sigma, OptionRange{0.01, 100});
  visit("turned_parallax_px", stage.options.turned_parallax_px, OptionRange{0, 100});
  visit("most_evidence", stage.options.most_evidence, OptionRange{0, 100});
  visit("expected", stage.options.expected, OptionRange{0, 100});
  visit("least_static_prior", stage.options.least_static_prior, OptionRange{0, 1});
}

}  // namespace stillpoint
