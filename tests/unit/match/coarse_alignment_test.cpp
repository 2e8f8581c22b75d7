// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/match/coarse_alignment.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/match/pyramid.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/observations_of.hpp"

namespace stillpoint::coarse_alignment_test {
namespace {

/// Frames of a turning camera in a room, some time apart, and what the alignment says of their motion.
class CoarseAlignmentTest : public testing::Test {
 protected:
  struct Image {
    SyntheticFrame frame;
    Pyramid pyramid;
  };

  void render(int index, Image& image) {
    sequence_.render(index, image.frame);
    image.pyramid.build(image.frame.gray.view(), 4);
  }

  /// @return mean distance in pixels between where the truth and the alignment put points of the current frame
  double error_px(const Image& reference, const Image& current, const Pose& expected) {
    alignment_.add_frame(reference.pyramid);
    alignment_.add_frame(current.pyramid);
    const FrameView view = current.frame.view();
    const Pose found = alignment_.align(view.depth, view.gray, expected, sequence_.camera());
    return distance_px(current, found, truth(reference, current));
  }

  static Pose truth(const Image& reference, const Image& current) {
    return reference.frame.world_from_camera.inverse() * current.frame.world_from_camera;
  }

  double distance_px(const Image& current, const Pose& a, const Pose& b) const {
    const Camera& camera = sequence_.camera();
    double sum = 0;
    int count = 0;
    for (int v = 20; v < camera.height(); v += 40)
      for (int u = 20; u < camera.width(); u += 40) {
        const double depth_m = static_cast<double>(current.frame.view().depth.metres(u, v));
        if (!(depth_m > 0)) continue;
        const Vector3d point = camera.back_project(camera.undistort(Vector2d(u, v)), depth_m);
        sum += (camera.project(a * point) - camera.project(b * point)).norm();
        ++count;
      }
    return sum / count;
  }

  SyntheticSequence sequence_{synthetic::pure_rotation()};
  CoarseAlignment alignment_;
};

// Corners reach 45 px from where they begin. Frames of a fifth of a second of a fast turn are farther apart than that;
// the alignment brings every pair within reach, and most much nearer.
TEST_F(CoarseAlignmentTest, BringsFramesFarApartWithinReachOfTheCorners) {
  double largest_before = 0;
  for (int first = 0; first + 6 < 120; first += 15) {
    Image reference, current;
    render(first, reference);
    render(first + 6, current);
    const double before = distance_px(current, Pose::Identity(), truth(reference, current));
    largest_before = std::max(largest_before, before);
    EXPECT_LT(error_px(reference, current, Pose::Identity()), std::max(8.0, 0.25 * before)) << first;
  }
  EXPECT_GT(largest_before, 45.0) << "else the test asks nothing";
}

// Half of the contrast and more light: the images are compared without gain and offset.
TEST_F(CoarseAlignmentTest, ExposureDoesNotMatter) {
  Image reference, current;
  render(0, reference);
  render(30, current);
  const double plain = error_px(reference, current, Pose::Identity());
  cv::Mat darker = as_mat(reference.frame.gray.view()) * 0.5 + cv::Scalar(60);
  reference.pyramid.build(ImageView(darker), 4);
  EXPECT_NEAR(error_px(reference, current, Pose::Identity()), plain, 2.0);
}

TEST_F(CoarseAlignmentTest, WhatIsExpectedStaysWhereNothingIsBetter) {
  Image frame;
  render(0, frame);
  Pose expected = Pose::Identity();
  expected.translation() = Vector3d(0.3, 0, 0);
  const FrameView view = frame.frame.view();
  alignment_.add_frame(frame.pyramid);
  EXPECT_EQ(alignment_.align(view.depth, view.gray, expected, sequence_.camera()).matrix(), expected.matrix())
      << "no older frame";
  alignment_.add_frame(frame.pyramid);
  const cv::Mat nothing = cv::Mat::zeros(view.gray.height, view.gray.width, CV_16UC1);
  EXPECT_EQ(alignment_.align(DepthView(nothing, 5000.0), view.gray, expected, sequence_.camera()).matrix(),
            expected.matrix())
      << "no depth";
  alignment_.reset();
  EXPECT_EQ(alignment_.align(view.depth, view.gray, expected, sequence_.camera()).matrix(), expected.matrix());
}

// Both frames are the same but for a patch of 40 % of the width, which went 24 px to the right. Where the weights say
// that it moves, the camera has not.
TEST_F(CoarseAlignmentTest, WhatMovesHasNoSay) {
  Image reference, current;
  render(0, reference);
  render(0, current);
  cv::Mat image = as_mat(current.frame.gray.view()).clone();
  const int left = image.cols / 4, width = 2 * image.cols / 5, shift = 24;
  as_mat(reference.frame.gray.view())
      .colRange(left, left + width)
      .copyTo(image.colRange(left + shift, left + shift + width));
  current.pyramid.build(ImageView(image), 4);
  Matches matches;
  std::vector<Vector2f> pixels;
  for (int v = 12; v < image.rows; v += 24)
    for (int u = 12; u < image.cols; u += 24) pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
  matches.begin(pixels);
  std::vector<Label> labels(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    labels[i].keep =
        !(pixels[i].x() >= static_cast<float>(left) && pixels[i].x() < static_cast<float>(left + width + shift));
  alignment_.reference_weights.assign(test::observations_of(matches), labels, image.cols, image.rows);
  EXPECT_LT(error_px(reference, current, Pose::Identity()), 1.0);
}

}  // namespace
}  // namespace stillpoint::coarse_alignment_test
