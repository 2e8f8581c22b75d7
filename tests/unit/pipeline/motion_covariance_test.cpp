// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Is the covariance of the filter's own motion honest?   On recordings with reference poses.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "stillpoint/core/statistics.hpp"
#include "stillpoint/evaluation/trajectory.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"

namespace stillpoint::motion_covariance_test {
namespace {

[[maybe_unused]] std::optional<Pose> reference_pose(const TumSequence& sequence, double timestamp_s) {
  const AssociatedTrajectories pair = associate(*sequence.ground_truth(), {{timestamp_s, Pose::Identity()}});
  return pair.reference.empty() ? std::nullopt : std::optional(pair.reference[0].world_from_camera);
}

// χ² of six degrees of freedom has a median of 5.35: six times 0.89. Wrong by a factor of two in each direction would
// be outside.
TEST(MotionCovariance, IsThatOfTheErrorsOnRecordings) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "too slow under the sanitizers, and nothing in it is new to them";
#else
  for (const char* name : {"kitchen_static", "kitchen_walk", "kitchen_box"}) {
    const std::filesystem::path folder = std::filesystem::path(STILLPOINT_SHARED_DATA) / name;
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no recorded sequence in " << folder;
    const TumSequence sequence(folder);
    ASSERT_TRUE(sequence.ground_truth());
    FrameFilter<> filter(sequence.camera());
    const cv::Ptr<cv::ORB> orb = cv::ORB::create(300);
    std::optional<Pose> world_from_last;
    std::vector<double> normalised;
    for (std::size_t f = 0; f < sequence.frames().size(); ++f) {
      const RgbdImages images = sequence.load(f);
      cv::Mat gray;
      cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
      std::vector<cv::KeyPoint> keypoints;
      orb->detect(gray, keypoints);
      const double timestamp_s = sequence.frames()[f].timestamp_s;
      const Motion& motion =
          filter.filter_frame({gray, DepthView(images.depth, sequence.depth_factor()), timestamp_s}, keypoints)
              .motion();
      const std::optional<Pose> world_from_camera = reference_pose(sequence, timestamp_s);
      if (motion.usable() && !motion.stationary && world_from_last && world_from_camera) {
        const Pose truth = world_from_camera->inverse() * *world_from_last;
        const Pose off = truth * motion.current_from_reference.inverse();  // Exp(ω), v of Motion::covariance
        Vector6d error;
        error << vector_from_rotation(off.linear()), off.translation();
        normalised.push_back(error.dot(motion.covariance.ldlt().solve(error)) / 6.0);
      }
      world_from_last = world_from_camera;
    }
    ASSERT_GT(normalised.size(), 100u) << name;
    const double median = median_in_place(span<double>(normalised));
    EXPECT_GT(median, 0.7) << name;
    EXPECT_LT(median, 1.5) << name;
  }
#endif
}

}  // namespace
}  // namespace stillpoint::motion_covariance_test
