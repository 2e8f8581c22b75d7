// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint_shim/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/stillpoint.hpp"

namespace {

using Flags = std::vector<unsigned char>;

/// Before a wall two metres away a square moves to the right.
struct Scene {
  static constexpr int kWidth = 320, kHeight = 240;
  cv::Mat texture = cv::Mat(2 * kHeight, kWidth, CV_8UC1);
  cv::Mat gray, depth;
  std::vector<cv::KeyPoint> keypoints;
  double timestamp_s = 0;

  Scene() {
    stillpoint::Random random(1);
    for (int v = 0; v < texture.rows; v += 4)
      for (int u = 0; u < texture.cols; u += 4)
        texture(cv::Rect(u, v, 4, 4)).setTo(static_cast<double>(random.index(256)));
    for (int v = 20; v < 220; v += 10)
      for (int u = 20; u < 300; u += 10) keypoints.emplace_back(static_cast<float>(u), static_cast<float>(v), 31.0f);
  }

  void show(int frame) {
    const cv::Rect square(40 + 6 * frame, 60, 80, 80);
    texture(cv::Rect(0, 0, kWidth, kHeight)).copyTo(gray);
    texture(cv::Rect(0, kHeight, square.width, square.height)).copyTo(gray(square));
    depth = cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(2000));  // millimetres
    depth(square).setTo(1500);
    timestamp_s = 1.0 + frame / 30.0;
  }
};

stillpoint_shim::Camera camera() {
  stillpoint_shim::Camera camera;
  camera.fx = camera.fy = 200;
  camera.cx = 159.5;
  camera.cy = 119.5;
  camera.width = Scene::kWidth;
  camera.height = Scene::kHeight;
  return camera;
}

stillpoint_shim::Settings millimetres() {
  stillpoint_shim::Settings settings;
  settings.depth_factor = 1000;
  return settings;
}

/// What the constructor says of wrong settings.
std::string refusal_of(const stillpoint_shim::Camera& camera, const stillpoint_shim::Settings& settings = {}) {
  try {
    stillpoint_shim::Filter filter(camera, settings);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

/// The weights of the shim, a library, beside those of the same filter compiled with this file. Where the processor
/// adds to a product in one rounding (FMA: arm64, or -march of newer x86), a compiler does so in one build and not in
/// the other, and last digits differ; else none does.
void expect_same_weights(const stillpoint_shim::Filter& shim, const stillpoint::FrameResult& expected, int frame) {
#ifdef __FP_FAST_FMA
  constexpr float kRounding = 1e-3F;
#else
  constexpr float kRounding = 0.0F;
#endif
  std::vector<float> weights, expected_weights;
  shim.weights(weights);
  stillpoint::weights(expected, expected_weights);
  ASSERT_EQ(weights.size(), expected_weights.size()) << frame;
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(weights[i], expected_weights[i], kRounding) << "feature " << i << " of frame " << frame;
}

// Every setting differs from its default and reaches the stage it is meant for: the same verdicts, weights and masks as
// without the shim.
TEST(ShimFilter, AnswersAsTheLibraryDoes) {
  stillpoint_shim::Camera shim_camera = camera();
  shim_camera.lens = stillpoint_shim::Lens::brown_conrady;
  const double distortion[5] = {0.02, -0.01, 0.001, -0.002, 0.003};
  std::copy_n(distortion, 5, shim_camera.distortion);
  stillpoint_shim::Settings settings = millimetres();
  settings.depth_noise = stillpoint_shim::DepthNoise::stereo;
  settings.stereo_baseline_m = 0.12;
  settings.stereo_disparity_sigma_px = 0.2;
  settings.false_positive_rate = 0.05;
  settings.fewest_features = 520;  // more than stand still
  stillpoint_shim::Filter shim(shim_camera, settings);

  stillpoint::FrameFilter<> filter(stillpoint::Camera(200, 200, 159.5, 119.5, 320, 240,
                                                      {stillpoint::BrownConrady{0.02, -0.01, 0.001, -0.002, 0.003}}));
  filter.depth_noise = stillpoint::StereoNoise{200, 0.12, 0.2};
  filter.gate.options.false_positive_rate = 0.05;
  filter.keep_floor.options.fewest_features = 520;

  Scene scene;
  for (int frame = 0; frame < 8; ++frame) {
    scene.show(frame);
    if (frame == 3) {  // a late answer, and one of the coming frame
      shim.set_boxes({{40, 60, 80, 80, stillpoint_shim::Mobility::dynamic, 0.8f}}, 1.0 + 1 / 30.0);
      filter.prior.detected(1.0 + 1 / 30.0, {{{40, 60, 80, 80}, stillpoint::Mobility::dynamic, 0.8f}});
    } else if (frame == 5) {
      shim.set_boxes({{200, 20, 50, 50, stillpoint_shim::Mobility::movable, 0.5f}});
      filter.prior.detections = {{{200, 20, 50, 50}, stillpoint::Mobility::movable, 0.5f}};
    }
    const stillpoint_shim::Result& found =
        shim.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
    const stillpoint::FrameResult& expected =
        filter.filter_frame({scene.gray, {scene.depth, 1000.0}, scene.timestamp_s}, scene.keypoints);
    EXPECT_STREQ(found.status, stillpoint::to_string(expected.status())) << frame;
    EXPECT_EQ(found.judged, stillpoint::judged(expected.status())) << frame;
    EXPECT_EQ(found.kept_count, expected.kept_count()) << frame;
    EXPECT_EQ(found.keep, Flags(expected.keep().begin(), expected.keep().end())) << frame;

    expect_same_weights(shim, expected, frame);

    cv::Mat mask;
    stillpoint::ImageBuffer expected_mask;
    shim.mask(mask, 9);
    expected.mask(expected_mask, 9);
    EXPECT_EQ(cv::norm(mask, stillpoint::as_mat(expected_mask.view()), cv::NORM_INF), 0.0) << frame;

    shim.predicted_keep_mask(scene.timestamp_s + 1 / 30.0, mask, 7);
    filter.predicted_keep_mask(scene.timestamp_s + 1 / 30.0, 7, expected_mask);
    EXPECT_EQ(cv::norm(mask, stillpoint::as_mat(expected_mask.view()), cv::NORM_INF), 0.0) << frame;
    EXPECT_TRUE(frame != 7 || cv::countNonZero(mask == 0) > 40 * 40) << "of the square's 80 x 80";

    const stillpoint::Pose pose(Eigen::Translation3d(0.001 * frame, 0, 0));
    const double rows[16] = {1, 0, 0, 0.001 * frame, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (frame >= 5) {
      EXPECT_TRUE(shim.feedback(rows));
      filter.feedback(pose);
    }
  }
  EXPECT_TRUE(shim.result().keep_floor) << "the scene tests the keep-floor, too";
  EXPECT_EQ(shim.result().kept_count, 520u);
}

TEST(ShimFilter, AColourImageAndPlainPointsGiveTheSameAnswer) {
  stillpoint_shim::Filter with_keypoints(camera(), millimetres()), with_points(camera(), millimetres());
  Scene scene;
  std::vector<cv::Point2f> points;
  for (const cv::KeyPoint& keypoint : scene.keypoints) points.push_back(keypoint.pt);
  for (int frame = 0; frame < 5; ++frame) {
    scene.show(frame);
    cv::Mat bgr, wider(240, 400, CV_8UC3, cv::Scalar::all(0));
    cv::merge(std::vector<cv::Mat>(3, scene.gray), bgr);
    bgr.copyTo(wider(cv::Rect(30, 0, 320, 240)));  // rows with gaps
    bgr = wider(cv::Rect(30, 0, 320, 240));
    const Flags keep = with_keypoints.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints).keep;
    EXPECT_EQ(with_points.filter_frame(bgr, scene.depth, scene.timestamp_s, points).keep, keep) << frame;
  }
  EXPECT_LT(with_points.result().kept_count, points.size());
}

TEST(ShimFilter, ABadFrameKeepsEverythingAndSaysWhy) {
  stillpoint_shim::Filter filter(camera(), millimetres());
  Scene scene;
  scene.show(0);
  const auto status_of = [&](const cv::Mat& gray, const cv::Mat& depth, double timestamp_s) -> std::string {
    const stillpoint_shim::Result& result = filter.filter_frame(gray, depth, timestamp_s, scene.keypoints);
    EXPECT_FALSE(result.judged);
    EXPECT_EQ(result.keep, Flags(scene.keypoints.size(), 1));
    EXPECT_EQ(result.kept_count, scene.keypoints.size());
    return result.status;
  };
  EXPECT_EQ(status_of(scene.gray, scene.depth, 1.0), "first_frame");
  EXPECT_EQ(status_of(scene.gray, scene.depth, 1.0), "duplicate_frame");
  EXPECT_EQ(status_of(cv::Mat(), scene.depth, 1.1), "no_image");
  EXPECT_EQ(status_of(scene.gray.rowRange(0, 100), scene.depth, 1.1), "size_changed");
  EXPECT_EQ(status_of(cv::Mat(240, 320, CV_32SC1, cv::Scalar(0)), scene.depth, 1.1), "unsupported_image");
  EXPECT_EQ(status_of(scene.gray, scene.depth, std::nan("")), "invalid_time");
  EXPECT_EQ(status_of(scene.gray, scene.depth, 0.5), "out_of_order");
  EXPECT_EQ(status_of(scene.gray, cv::Mat(), 0.8), "no_depth") << "what was measured is 0.3 s old";
  scene.keypoints.clear();
  EXPECT_EQ(status_of(scene.gray, scene.depth, 0.83), "no_keypoints");
}

TEST(ShimFilter, ResetForgetsFramesAndAnswers) {
  stillpoint_shim::Filter filter(camera(), millimetres());
  cv::Mat mask;
  std::vector<float> weights(5);
  filter.mask(mask);
  filter.weights(weights);
  EXPECT_EQ(cv::countNonZero(mask != 255), 0);
  filter.predicted_keep_mask(1.0, mask);
  EXPECT_EQ(cv::countNonZero(mask != 255), 0);
  EXPECT_EQ(mask.size(), cv::Size(320, 240));
  EXPECT_TRUE(weights.empty());
  Scene scene;
  for (int frame = 0; frame < 5; ++frame) {
    scene.show(frame);
    filter.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
  }
  filter.mask(mask);
  EXPECT_GT(cv::countNonZero(mask == 0), 0);
  EXPECT_EQ(cv::countNonZero(mask == 0) + cv::countNonZero(mask == 255), 320 * 240);
  filter.reset();
  filter.mask(mask);
  EXPECT_EQ(cv::countNonZero(mask != 255), 0);
  EXPECT_TRUE(filter.result().keep.empty());
  scene.show(5);
  EXPECT_STREQ(filter.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints).status, "first_frame");
}

TEST(ShimFilter, FeedbackTakesRigidMotionsAlone) {
  stillpoint_shim::Filter filter(camera());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(filter.feedback({0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1}));
  EXPECT_FALSE(filter.feedback({nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_FALSE(filter.feedback({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1})) << "scaled";
  EXPECT_FALSE(filter.feedback({-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})) << "mirrored";
  EXPECT_FALSE(filter.feedback({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1})) << "column by column";
}

TEST(ShimFilter, SixteenBitDepthHasNoDefaultFactor) {
  stillpoint_shim::Filter filter(camera());
  Scene scene;
  cv::Mat mask, depth_m;
  for (int frame = 0; frame < 2; ++frame) {
    scene.show(frame);
    filter.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
    EXPECT_FALSE(filter.result().judged);
    EXPECT_STREQ(filter.result().status, "depth_unit_missing");
    EXPECT_STREQ(filter.result().hint,
                 "16-bit depth needs Settings::depth_factor: 1000 for millimetres, 5000 for TUM's files.");
    EXPECT_EQ(filter.result().keep, Flags(scene.keypoints.size(), 1));
  }
  filter.mask(mask);
  EXPECT_EQ(cv::countNonZero(mask != 255), 0);
  for (int frame = 2; frame < 4; ++frame) {  // metres need none; the frames before were none
    scene.show(frame);
    scene.depth.convertTo(depth_m, CV_32F, 1e-3);
    filter.filter_frame(scene.gray, depth_m, scene.timestamp_s, scene.keypoints);
    EXPECT_STREQ(filter.result().status, frame == 2 ? "first_frame" : "ok");
  }
  filter.change_settings(millimetres());
  scene.show(4);
  EXPECT_STREQ(filter.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints).status, "ok");
}

// Each setting that is changed between frames reaches its stage: the same bytes as the library, in which it is changed,
// too.
TEST(ShimFilter, SettingsChangeBetweenFrames) {
  stillpoint_shim::Settings settings = millimetres();
  settings.fewest_features = 520;  // more than stand still
  stillpoint_shim::Filter shim(camera(), settings);
  stillpoint::FrameFilter<> filter(stillpoint::Camera(200, 200, 159.5, 119.5, 320, 240));
  filter.keep_floor.options.fewest_features = 520;
  EXPECT_EQ(shim.settings().fewest_features, 520);

  Scene scene;
  double factor = 1000;
  for (int frame = 0; frame < 8; ++frame) {
    scene.show(frame);
    if (frame == 4) {  // the map has begun
      settings.fewest_features = 50;
      settings.false_positive_rate = 0.05;
      settings.depth_noise = stillpoint_shim::DepthNoise::stereo;
      settings.stereo_baseline_m = 0.12;
      filter.keep_floor.options.fewest_features = 50;
      filter.gate.options.false_positive_rate = 0.05;
      filter.depth_noise = stillpoint::StereoNoise{200, 0.12, 0.3};
    } else if (frame == 6) {
      settings.depth_factor = factor = 2000;
    }
    shim.change_settings(settings);
    scene.depth.convertTo(scene.depth, -1, factor / 1000);
    const stillpoint_shim::Result& found =
        shim.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
    const stillpoint::FrameResult& expected =
        filter.filter_frame({scene.gray, {scene.depth, factor}, scene.timestamp_s}, scene.keypoints);
    EXPECT_STREQ(found.status, stillpoint::to_string(expected.status())) << frame;
    EXPECT_EQ(found.keep, Flags(expected.keep().begin(), expected.keep().end())) << frame;
    EXPECT_EQ(found.keep_floor, expected.warnings().has(stillpoint::Warning::keep_floor)) << frame;
    EXPECT_TRUE(frame != 3 || found.keep_floor);
  }
  EXPECT_STREQ(shim.result().status, "ok") << "nothing was forgotten, and the floor is lower";
  EXPECT_LT(shim.result().kept_count, 520u);
}

TEST(ShimFilter, ARefusedChangeChangesNothing) {
  stillpoint_shim::Settings settings = millimetres();
  settings.fewest_features = 520;
  stillpoint_shim::Filter filter(camera(), settings);
  const auto refusal = [&](const stillpoint_shim::Settings& wrong) -> std::string {
    try {
      filter.change_settings(wrong);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  stillpoint_shim::Settings wrong = settings;
  wrong.depth_factor = 0;
  wrong.fewest_features = -1;
  EXPECT_EQ(refusal(wrong), refusal_of(camera(), wrong)) << "the checks are the constructor's";
  wrong.fewest_features = 5;
  wrong.depth_noise = stillpoint_shim::DepthNoise::stereo;  // without a baseline
  EXPECT_EQ(refusal(wrong), "stillpoint: settings: depth_noise.baseline_m is 0, expected a number from 0.001 to 100");
  EXPECT_EQ(filter.settings().fewest_features, 520);
  EXPECT_EQ(filter.settings().depth_factor, 1000);
  Scene scene;
  for (int frame = 0; frame < 6; ++frame) {
    scene.show(frame);
    filter.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
  }
  EXPECT_TRUE(filter.result().keep_floor);
}

// An expectation that is far off must be seen in the answer, or it does not arrive.
TEST(ShimFilter, AnExpectedMotionArrives) {
  stillpoint_shim::Filter shim(camera(), millimetres());
  stillpoint::FrameFilter<> filter(stillpoint::Camera(200, 200, 159.5, 119.5, 320, 240));
  Scene scene;
  const double rows[16] = {1, 0, 0, 0.02, 0, 1, 0, -0.01, 0, 0, 1, 0.005, 0, 0, 0, 1};
  for (int frame = 0; frame < 6; ++frame) {
    scene.show(frame);
    if (frame > 0) {
      EXPECT_TRUE(shim.expect_motion(rows));
      filter.expect_motion(stillpoint::Pose(Eigen::Translation3d(0.02, -0.01, 0.005)));
    }
    const stillpoint_shim::Result& found =
        shim.filter_frame(scene.gray, scene.depth, scene.timestamp_s, scene.keypoints);
    const stillpoint::FrameResult& expected =
        filter.filter_frame({scene.gray, {scene.depth, 1000.0}, scene.timestamp_s}, scene.keypoints);
    EXPECT_EQ(found.keep, Flags(expected.keep().begin(), expected.keep().end())) << frame;
    expect_same_weights(shim, expected, frame);
  }
  EXPECT_FALSE(shim.expect_motion({1, 0, 0, 101, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})) << "101 m in a frame";
  EXPECT_FALSE(shim.expect_motion({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1})) << "scaled";
  EXPECT_FALSE(shim.expect_motion({1, 0, 0, std::nan(""), 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(ShimFilter, WrongSettingsAreNamed) {
  EXPECT_EQ(refusal_of(camera()), "accepted");
  stillpoint_shim::Camera wrong = camera();
  wrong.fy = 0;
  EXPECT_EQ(refusal_of(wrong), "stillpoint: camera: fy is 0, expected a positive focal length in pixels");
  wrong = camera();
  wrong.distortion[1] = 0.1;
  EXPECT_EQ(refusal_of(wrong), "stillpoint: camera: distortion is 0.1, expected zeros for a pinhole; or another lens");
  wrong.lens = stillpoint_shim::Lens::fisheye;
  EXPECT_EQ(refusal_of(wrong), "accepted");
  wrong.distortion[4] = 0.1;
  EXPECT_EQ(refusal_of(wrong),
            "stillpoint: camera: distortion[4] is 0.1, expected 0: only brown_conrady has five coefficients");

  stillpoint_shim::Settings settings;
  settings.depth_factor = -1000;
  EXPECT_EQ(refusal_of(camera(), settings),
            "stillpoint: settings: depth_factor is -1000, expected 0.001 to 1000000 units per metre: 1000 for "
            "millimetres, 5000 for TUM's files; 0 without 16-bit depth");
  for (const double no_unit : {std::nan(""), 1e-300, 1e9}) {
    settings.depth_factor = no_unit;
    EXPECT_NE(refusal_of(camera(), settings), "accepted") << no_unit;
  }
  settings = {};
  settings.false_positive_rate = std::nan("");
  EXPECT_EQ(refusal_of(camera(), settings),
            "stillpoint: settings: gate.false_positive_rate is nan, expected a number from 0.000001 to 0.5");
  settings = {};
  settings.fewest_features = -1;
  EXPECT_EQ(refusal_of(camera(), settings), "stillpoint: settings: fewest_features is -1, expected 0 or more");
  settings.fewest_features = 2000000;
  EXPECT_EQ(refusal_of(camera(), settings),
            "stillpoint: settings: keep_floor.fewest_features is 2000000, expected a whole number from 0 to 1000000");
  settings = {};
  settings.depth_noise = stillpoint_shim::DepthNoise::stereo;
  EXPECT_EQ(refusal_of(camera(), settings),
            "stillpoint: settings: depth_noise.baseline_m is 0, expected a number from 0.001 to 100");
}

TEST(ShimFilter, ClassesHaveTheLibrarysMobility) {
  EXPECT_EQ(stillpoint_shim::mobility_of("person"), stillpoint_shim::Mobility::dynamic);
  EXPECT_EQ(stillpoint_shim::mobility_of("chair"), stillpoint_shim::Mobility::movable);
  EXPECT_EQ(stillpoint_shim::mobility_of("sofa"), stillpoint_shim::Mobility::fixed);
  EXPECT_EQ(stillpoint_shim::mobility_of("unheard of"), stillpoint_shim::Mobility::unknown);
}

}  // namespace
