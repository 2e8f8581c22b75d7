// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// How noisy are this camera's pixels and depths?   Measured on a recording of a scene in which nothing moves.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "stillpoint/core/motion.hpp"
#include "stillpoint/core/observations.hpp"
#include "stillpoint/core/span.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/depth/depth_noise.hpp"

namespace stillpoint {

/// The depth noise that was found within one range of depths.
struct DepthNoiseBin {
  double nearest_m = 0, farthest_m = 0;
  std::size_t samples = 0;
  double depth_m = 0;  ///< median
  double sigma_m = 0;  ///< of a single depth: the robust spread of the difference of two, over √2
};

/// What a camera's noise was found to be.
struct CalibratedNoise {
  std::size_t frames = 0;            ///< that had a motion
  double median_pixel_sigma = 0;     ///< of a followed corner, pixels
  double worst_pixel_sigma = 0;      ///< its 95th percentile over frames
  std::vector<DepthNoiseBin> depth;  ///< near to far; those with enough samples
  AnyDepthNoise depth_noise;         ///< the model that fits best, with its parameters
  double misfit = 0;                 ///< spread of log(found / model) over the bins
  bool has_depth() const noexcept { return !depth.empty(); }
};

/// Gathers, frame by frame, how far static points are from where the motion takes them. The camera must move
/// slowly: on a tripod a structured-light sensor repeats its errors, and in quick turns pixels are noisier than usual.
class NoiseCalibration {
 public:
  struct Options {
    double least_depth_m = 0.4;        ///< of the first bin; each bin reaches `bin_growth` times as far
    double bin_growth = 1.25;          ///< 0.4 to 9.3 m in 14 bins
    std::size_t fewest_samples = 100;  ///< in a bin
    float least_static_prior = 0.95f;  ///< of a match that is taken: nothing near it moved before
  };
  Options options;

  /// Takes what was observed of a frame, and the motion that was found between its ends.
  void add(const Observations& observations, const Motion& motion) {
    const Matches& matches = observations.matches;
    if (!motion.usable()) return;
    ++frames_;
    if (motion.pixel_sigma > 0) pixel_sigma_.push_back(motion.pixel_sigma);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!matches.metric(i) || !(observations.remembered.static_prior[i] >= options.least_static_prior)) continue;
      const double expected_m = (motion.current_from_reference * matches.reference.point[i]).z();
      add_depth(matches.current.depth_m[i], matches.current.depth_m[i] - expected_m);
    }
  }

  /// @param assumed  its baseline and focal length are kept where it is a stereo model; without enough depths all of it
  CalibratedNoise result(const AnyDepthNoise& assumed) const {
    CalibratedNoise found;
    found.frames = frames_;
    found.depth_noise = assumed;
    std::vector<double> sigmas = pixel_sigma_;
    if (!sigmas.empty()) {
      found.median_pixel_sigma = median_in_place(span<double>(sigmas));
      found.worst_pixel_sigma = quantile_in_place(span<double>(sigmas), 0.95);
    }
    for (std::size_t b = 0; b < kBins; ++b) {
      if (bins_[b].size() < options.fewest_samples) continue;
      std::vector<double> depths, differences;
      for (const Sample& sample : bins_[b]) {
        depths.push_back(sample.depth_m);
        differences.push_back(std::abs(sample.difference_m));
      }
      const double sigma_m = kMadToSigma * median_in_place(span<double>(differences)) / std::sqrt(2.0);
      if (!(sigma_m > 0)) continue;  // more than half repeat their value: quantised, or no noise at all
      const double nearest_m = options.least_depth_m * std::pow(options.bin_growth, static_cast<double>(b));
      found.depth.push_back(
          {nearest_m, nearest_m * options.bin_growth, bins_[b].size(), median_in_place(span<double>(depths)), sigma_m});
    }
    if (found.has_depth()) fit(assumed, found);
    return found;
  }

 private:
  static constexpr double kLeastConstant_m = 1e-6;  // no depth is without noise
  static constexpr std::size_t kBins = 14;
  static constexpr std::size_t kMostSamples = 20000;  // in a bin: a quarter of a minute
  struct Sample {
    double depth_m, difference_m;
  };

  void add_depth(double depth_m, double difference_m) {
    const double bin = std::floor(std::log(depth_m / options.least_depth_m) / std::log(options.bin_growth));
    if (!(bin >= 0 && bin < static_cast<double>(kBins)) || !std::isfinite(difference_m)) return;
    std::vector<Sample>& samples = bins_[static_cast<std::size_t>(bin)];
    if (samples.size() < kMostSamples) samples.push_back({depth_m, difference_m});
  }

  /// Takes of three families the member whose logarithm is nearest to what was found, on average over the bins.
  static void fit(const AnyDepthNoise& assumed, CalibratedNoise& found) {
    found.misfit = std::numeric_limits<double>::infinity();
    const auto consider = [&found](AnyDepthNoise model, double parameters) {
      double sum = 0, squares = 0;
      for (const DepthNoiseBin& bin : found.depth) {
        const double ratio = std::log(bin.sigma_m / model.sigma(bin.depth_m));
        sum += ratio;
        squares += ratio * ratio;
      }
      const auto bins = static_cast<double>(found.depth.size());
      const double mean = sum / bins, freedom = std::max(bins - parameters, 1.0);
      const double misfit = std::sqrt(std::max(squares - bins * mean * mean, 0.0) / freedom);
      if (!(misfit < found.misfit) || !std::isfinite(mean)) return;
      found.misfit = misfit;
      model.scale *= std::exp(mean);
      found.depth_noise = model;
    };
    consider(KinectNoise{}, 1);
    const auto* const stereo = std::get_if<StereoNoise>(&assumed.model);
    consider(stereo != nullptr ? *stereo : StereoNoise{}, 1);
    if (found.depth.size() > 2) consider(line(found.depth), 2);
  }

  /// Constant and slope that fit σ(z) best, in relative terms; the constant above zero, the slope not below.
  static TimeOfFlightNoise line(const std::vector<DepthNoiseBin>& bins) {
    double one = 0, z = 0, zz = 0, s = 0, sz = 0;
    for (const DepthNoiseBin& bin : bins) {
      const double weight = 1 / (bin.sigma_m * bin.sigma_m);
      one += weight;
      z += weight * bin.depth_m;
      zz += weight * bin.depth_m * bin.depth_m;
      s += weight * bin.sigma_m;
      sz += weight * bin.sigma_m * bin.depth_m;
    }
    TimeOfFlightNoise noise;
    noise.per_metre = (one * sz - z * s) / (one * zz - z * z);
    noise.constant_m = (s - noise.per_metre * z) / one;
    if (!(noise.per_metre >= 0)) noise = {s / one, 0.0};
    if (!(noise.constant_m > 0)) noise = {kLeastConstant_m, sz / zz};
    return noise;
  }

  std::size_t frames_ = 0;
  std::vector<double> pixel_sigma_;
  std::array<std::vector<Sample>, kBins> bins_;
};

}  // namespace stillpoint
