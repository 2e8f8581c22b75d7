// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The code of docs/ at work; that of README.md is part of examples/. That each block compiles, as it stands there, is
// tested by tests/documents.

#include <gtest/gtest.h>

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

// clang-format off
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/detectors/async_detector.hpp>
#include <stillpoint/stereo/rectification.hpp>
#include <stillpoint/stereo/stereo_depth.hpp>
// clang-format on

namespace {

struct StationaryCamera {
  template <class Camera>
  stillpoint::Motion estimate(const stillpoint::Observations& observations, const Camera&,
                              const stillpoint::MotionPrior&, stillpoint::Workspace&) const {
    stillpoint::Motion motion;  // the identity, without any doubt
    motion.status = stillpoint::Status::ok;
    motion.candidates = motion.inliers = static_cast<int>(observations.size());
    return motion;
  }
};

struct TripodPolicies : stillpoint::DefaultPolicies {
  using EgoMotion = StationaryCamera;
};

/// A textured wall two metres away.
struct Wall {
  cv::Mat gray = cv::Mat(240, 320, CV_8UC1), depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(10000));
  std::vector<cv::KeyPoint> keypoints;

  Wall() {
    stillpoint::Random random(1);
    for (int v = 0; v < gray.rows; ++v)
      for (int u = 0; u < gray.cols; ++u) gray.at<unsigned char>(v, u) = static_cast<unsigned char>(random.index(256));
    for (int v = 20; v < 220; v += 20)
      for (int u = 20; u < 300; u += 20) keypoints.emplace_back(static_cast<float>(u), static_cast<float>(v), 31.0f);
  }
};

const stillpoint::Camera kDocumentCamera(260, 260, 159.5, 119.5, 320, 240);

TEST(Documents, AStereoPairBeforeTheFilter) {
  const stillpoint::Camera &left_camera = kDocumentCamera, &right_camera = kDocumentCamera;
  stillpoint::Pose right_from_left = stillpoint::Pose::Identity();
  right_from_left.translation().x() = -0.1;
  Wall wall;
  const cv::Mat &left = wall.gray, &right = wall.gray;
  cv::Mat rectified_left, rectified_right, depth;
  const std::vector<cv::KeyPoint>& keypoints = wall.keypoints;
  const double time = 1.0;
  // clang-format off
stillpoint::StereoRectification rectification(left_camera, right_camera, right_from_left);
stillpoint::StereoDepth stereo(rectification.camera(), rectification.baseline_m());
stillpoint::FrameFilter<> filter(rectification.camera());
filter.depth_noise = stereo.noise();
rectification.rectify(left, right, rectified_left, rectified_right);
stereo.compute(rectified_left, rectified_right, depth);               // gray → float metres
const auto& result = filter.filter_frame({rectified_left, depth, time}, keypoints);
  // clang-format on
  EXPECT_EQ(result.status(), stillpoint::Status::first_frame);
}

TEST(Documents, TheTripodsPoliciesRun) {
  stillpoint::FrameFilter<TripodPolicies> filter(kDocumentCamera);
  const Wall wall;
  for (int i = 0; i < 5; ++i) {
    const auto& result = filter.filter_frame(
        {wall.gray, stillpoint::DepthView::millimetres(wall.depth), 1.0 + 0.03 * i}, wall.keypoints);
    if (i == 0) continue;
    EXPECT_EQ(result.status(), stillpoint::Status::ok);
    EXPECT_EQ(result.kept_count(), wall.keypoints.size()) << "nothing moves";
  }
}

struct MyDetector {
  void detect(const stillpoint::ImageView&, std::vector<stillpoint::Detection>& detections) const {
    detections.push_back({{100, 80, 60, 120}, stillpoint::Mobility::dynamic, 0.9f});
  }
};

TEST(Documents, TheDetectorsLoopRuns) {
  stillpoint::FrameFilter<> filter(kDocumentCamera);
  const Wall wall;
  const cv::Mat &gray = wall.gray, &depth = wall.depth;
  const std::vector<cv::KeyPoint>& keypoints = wall.keypoints;
  std::vector<stillpoint::Detection> detections;
  MyDetector{}.detect(gray, detections);
  const double timestamp_s = 1.0;
  // clang-format off
filter.prior.detections = detections;   // taken with the next frame; write nothing where there is no new answer
filter.prior.detected(timestamp_s, detections);
stillpoint::AsyncDetector<MyDetector> detector(MyDetector{});   // stillpoint/detectors/async_detector.hpp
stillpoint::DetectorAnswer answer;
  for (int i = 0; i < 3; ++i) {
  const double time = 1.0 + 0.03 * i;
detector.offer(gray, time);   // copies the image; a newer one takes its place if it has to wait
if (detector.take(answer)) filter.prior.detected(answer.timestamp_s, answer.detections);
const auto& result = filter.filter_frame({gray, stillpoint::DepthView::millimetres(depth), time}, keypoints);
    // clang-format on
    EXPECT_EQ(result.size(), keypoints.size());
    detector.wait();
  }
  EXPECT_EQ(filter.prior.objects().size(), 1u) << "one thing, seen in every frame";
}

}  // namespace
