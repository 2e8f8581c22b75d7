// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/evaluation/noise_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/core/random.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint {
namespace {

/// Points before a camera that moves along its axis, whose depths are wrong by the noise of a model.
template <class Noise>
CalibratedNoise calibrate(const Noise& noise, double nearest_m, double farthest_m, const AnyDepthNoise& assumed,
                          double outliers = 0.0) {
  const Camera camera(500, 500, 319.5, 239.5, 640, 480);
  Random random(7);
  NoiseCalibration calibration;
  for (int frame = 0; frame < 40; ++frame) {
    Motion motion;
    motion.status = Status::ok;
    motion.pixel_sigma = 0.1 + 0.01 * frame;
    motion.current_from_reference.translation().z() = -0.02;
    Matches matches;
    matches.resize(500);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const double z = random.uniform(nearest_m, farthest_m);
      const Vector2d pixel(random.uniform(0, 640), random.uniform(0, 480));
      const double moved = random.uniform() < outliers ? 0.5 : 0.0;
      matches.state[i] = MatchState::matched;
      matches.reference.undistorted[i] = matches.current.undistorted[i] = pixel;
      matches.reference.set_depth(i, z + noise.sigma(z) * random.gaussian(), 0.01, camera);
      matches.current.set_depth(i, z - 0.02 + moved + noise.sigma(z) * random.gaussian(), 0.01, camera);
    }
    calibration.add(test::observations_of(matches), motion);
  }
  return calibration.result(assumed);
}

// 20 000 samples in about eight bins: the median of 1000 |x| has a standard error of 1.17 · σ · √(π / 2) / √2000 ≈ 4 %;
// a factor that is a mean over eight bins of 1.4 %.
TEST(NoiseCalibration, ScaleOfTheModelIsFound) {
  for (const double scale : {0.5, 1.0, 2.5}) {
    AnyDepthNoise truth = KinectNoise{};
    truth.scale = scale;
    const CalibratedNoise found = calibrate(truth, 0.8, 5.0, KinectNoise{});
    ASSERT_EQ(found.depth_noise.model.index(), 0u) << "kinect";
    EXPECT_NEAR(found.depth_noise.scale, scale, 0.06 * scale);
    EXPECT_LT(found.misfit, 0.1);
    for (const DepthNoiseBin& bin : found.depth)
      EXPECT_NEAR(bin.sigma_m, truth.sigma(bin.depth_m), 0.2 * truth.sigma(bin.depth_m)) << bin.depth_m;
  }
}

TEST(NoiseCalibration, FamilyIsFound) {
  StereoNoise stereo;
  stereo.baseline_m = 0.2;
  stereo.disparity_sigma_px = 0.5;
  const CalibratedNoise pair = calibrate(stereo, 0.8, 8.0, KinectNoise{});
  ASSERT_EQ(pair.depth_noise.model.index(), 1u) << "stereo";
  EXPECT_NEAR(pair.depth_noise.sigma(3.0), stereo.sigma(3.0), 0.06 * stereo.sigma(3.0));

  TimeOfFlightNoise tof;
  tof.constant_m = 0.01;
  tof.per_metre = 0.001;
  const CalibratedNoise time = calibrate(tof, 0.8, 8.0, KinectNoise{});
  ASSERT_EQ(time.depth_noise.model.index(), 2u) << "time of flight";
  for (const double depth_m : {1.0, 4.0, 7.0})
    EXPECT_NEAR(time.depth_noise.sigma(depth_m), tof.sigma(depth_m), 0.06 * tof.sigma(depth_m)) << depth_m;
}

TEST(NoiseCalibration, StereoKeepsItsBaseline) {
  StereoNoise stereo;
  stereo.focal_px = 435;
  stereo.baseline_m = 0.11;
  const CalibratedNoise found = calibrate(stereo, 0.8, 8.0, stereo);
  const auto* const model = std::get_if<StereoNoise>(&found.depth_noise.model);
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->baseline_m, 0.11);
  EXPECT_NEAR(found.depth_noise.scale, 1.0, 0.06);
}

// A tenth of outliers moves the median of |x| from the 50th to the 55.6th percentile: 0.6745 to 0.766 σ, by 14 %.
TEST(NoiseCalibration, AMoverHardlyMatters) {
  const CalibratedNoise found = calibrate(KinectNoise{}, 0.8, 5.0, KinectNoise{}, 0.1);
  EXPECT_NEAR(found.depth_noise.sigma(2.0), KinectNoise{}.sigma(2.0), 0.25 * KinectNoise{}.sigma(2.0));
}

// 0.10, 0.11, …, 0.49: the lower median is the 20th, the 95th percentile the 38th.
TEST(NoiseCalibration, PixelNoiseIsThatOfTheFrames) {
  const CalibratedNoise found = calibrate(KinectNoise{}, 0.8, 5.0, KinectNoise{});
  EXPECT_EQ(found.frames, 40u);
  EXPECT_NEAR(found.median_pixel_sigma, 0.29, 1e-12);
  EXPECT_NEAR(found.worst_pixel_sigma, 0.47, 1e-12);
}

TEST(NoiseCalibration, WithoutDepthsTheAssumedModelStays) {
  const CalibratedNoise found = NoiseCalibration().result(TimeOfFlightNoise{});
  EXPECT_FALSE(found.has_depth());
  EXPECT_EQ(found.depth_noise.model.index(), 2u);
  EXPECT_EQ(found.frames, 0u);
}

TEST(NoiseCalibration, OnlyLikelyStaticMatchesWithDepthAndMotionsCount) {
  const Camera camera(500, 500, 319.5, 239.5, 640, 480);
  NoiseCalibration calibration;
  calibration.options.fewest_samples = 1;
  Motion motion;
  Matches matches;
  matches.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    matches.state[i] = MatchState::matched;
    matches.reference.undistorted[i] = matches.current.undistorted[i] = Vector2d(319.5, 239.5);
    matches.reference.set_depth(i, 2.0, 0.01, camera);
    matches.current.set_depth(i, 2.01, 0.01, camera);
  }
  matches.space_static_prior[0] = 0.5f;
  matches.current.set_depth(1, 0.0, 0.01, camera);
  motion.status = Status::no_consensus;
  calibration.add(test::observations_of(matches), motion);
  EXPECT_FALSE(calibration.result(KinectNoise{}).has_depth());
  motion.status = Status::ok;
  calibration.add(test::observations_of(matches), motion);
  const CalibratedNoise found = calibration.result(KinectNoise{});
  ASSERT_EQ(found.depth.size(), 1u);
  EXPECT_EQ(found.depth[0].samples, 1u);
  EXPECT_NEAR(found.depth[0].sigma_m, 1.4826 * 0.01 / std::sqrt(2.0), 1e-9);
}

}  // namespace
}  // namespace stillpoint
