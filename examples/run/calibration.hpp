// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// stillpoint_run --calibrate: the noise of a camera, from a recording of a scene in which nothing moves.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "backends.hpp"
#include "filters.hpp"
#include "frame_source.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "sequence_run.hpp"
#include "stillpoint/core/error.hpp"
#include "stillpoint/evaluation/noise_calibration.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/policies.hpp"
#include "words.hpp"

namespace stillpoint_run {

/// A prior by which the calibration sees what the filter sees of every frame.
struct CalibratingPrior : stillpoint::PropagatedPrior {
  stillpoint::NoiseCalibration* calibration = nullptr;

  template <class Camera>
  void observe(const stillpoint::Observations& observations, const stillpoint::Motion& motion, const Camera& camera) {
    if (calibration != nullptr) calibration->add(observations, motion);
    stillpoint::PropagatedPrior::observe(observations, motion, camera);
  }
};
struct CalibratingPolicies : stillpoint::DefaultPolicies {
  using Prior = CalibratingPrior;
};

/// What a calibration has found, and the options that follow from it.
struct CalibrationRecord {
  std::string sequence;
  stillpoint::CalibratedNoise noise;
  double dropped_share = 0.0;
  std::string yaml;
};

namespace detail {

/// Sets what the stages assume. The noise of pixels is measured in every frame, up to a limit: a camera that is noisier
/// than those by which the limits were set gets higher ones than the defaults, a better camera needs none.
template <class Policies>
void take_over(const stillpoint::CalibratedNoise& noise, stillpoint::FrameFilter<Policies>& filter) {
  constexpr double kUsual_px = 0.41;  // kitchen_static's median (docs/tuning.md)
  const double noisier = std::max(noise.median_pixel_sigma / kUsual_px, 1.0);
  filter.depth_noise = noise.depth_noise;
  filter.scorer.options.pixel_sigma = noisier * stillpoint::ReprojectionScore::Options{}.pixel_sigma;
  filter.ego_motion.constraints.pixel_sigma = noisier * stillpoint::SupportConstraints{}.pixel_sigma;
}

}  // namespace detail

/// @throws stillpoint::Error where a frame can't be read, the frames are too few or without depth, or the scene does
///         not stand still.
inline CalibrationRecord calibrate(const Options& options, FrameSource& source) {
  constexpr std::size_t kFewestFrames = 30;
  constexpr double kMostDropped = 0.1;  // ten times the rate that static features are dropped with
  auto filter = detail::default_filter<CalibratingPolicies>(options, source);
  stillpoint::NoiseCalibration calibration;
  filter.prior.calibration = &calibration;
  NoTracker extractor(options.features);
  const auto first = static_cast<std::size_t>(options.start);
  const std::optional<std::size_t> count = frame_count(options, source);
  Progress progress(count, options.quiet);
  std::size_t features = 0, dropped = 0;
  for (std::size_t i = first; !count || i < first + *count; ++i) {
    const std::optional<SourceFrame> frame = source.load(i);
    if (!frame) break;
    const auto extracted = extractor.extract(frame->view());
    const stillpoint::FrameResult& result = filter.filter_frame(frame->view(), extracted.keypoints);
    features += result.size();
    dropped += result.size() - result.kept_count();
    progress.frame_done();
    if (was_interrupted()) break;  // what was seen until then counts
  }

  CalibrationRecord record;
  record.sequence = source.name();
  record.noise = calibration.result(filter.depth_noise);
  record.dropped_share = features > 0 ? static_cast<double>(dropped) / static_cast<double>(features) : 0.0;
  if (record.noise.frames < kFewestFrames)
    throw stillpoint::Error("--calibrate: found a motion in " + std::to_string(record.noise.frames) +
                            " frames, expected " + std::to_string(kFewestFrames) +
                            " or more of a textured scene with depth");
  if (!record.noise.has_depth())
    throw stillpoint::Error("--calibrate: found no depth that varies, expected depth images of a moving camera");
  if (record.dropped_share > kMostDropped)
    throw stillpoint::Error("--calibrate: found " + percent_words(record.dropped_share) +
                            " of the features to move, expected a scene in which nothing does");
  detail::take_over(record.noise, filter);
  record.yaml = stillpoint::options_as_yaml(filter);
  return record;
}

/// A table and what it means, a line each.
inline std::vector<std::string> sentences(const CalibrationRecord& record) {
  using stillpoint::format_fixed;
  const stillpoint::CalibratedNoise& noise = record.noise;
  std::vector<std::string> lines = {"Measured " + count_words(noise.frames, "frame") + " of " + record.sequence + "; " +
                                    percent_words(record.dropped_share) + " of the features seemed to move."};
  lines.push_back("Followed corners: " + format_fixed(noise.median_pixel_sigma, 3) + " px (median over frames), " +
                  format_fixed(noise.worst_pixel_sigma, 3) + " px (95th percentile).");
  lines.emplace_back("Depth, one standard deviation:");
  lines.emplace_back("      from      to    depths    found    model");
  for (const stillpoint::DepthNoiseBin& bin : noise.depth) {
    char line[96];
    std::snprintf(line, sizeof line, "  %6.2f m %6.2f m %9zu %5.1f mm %5.1f mm", bin.nearest_m, bin.farthest_m,
                  bin.samples, 1000 * bin.sigma_m, 1000 * noise.depth_noise.sigma(bin.depth_m));
    lines.emplace_back(line);
  }
  static constexpr const char* kModels[] = {"kinect", "stereo", "time of flight"};
  lines.push_back("Best model: " + std::string(kModels[noise.depth_noise.model.index()]) + ", scale " +
                  format_fixed(noise.depth_noise.scale, 2) + ", off by a factor of " +
                  format_fixed(std::exp(noise.misfit), 2) + " in a typical row.");
  return lines;
}

}  // namespace stillpoint_run
