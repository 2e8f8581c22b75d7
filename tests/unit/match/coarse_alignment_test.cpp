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

  static constexpr int kImageWidth = 640, kShift_px = 24;

  /// The first frame, of which a patch went to the right.
  void shift_patch(int left, int width, Image& image) {
    render(0, image);
    const cv::Mat as_it_was = as_mat(image.frame.gray.view());
    cv::Mat shifted = as_it_was.clone();
    as_it_was.colRange(left, left + width).copyTo(shifted.colRange(left + kShift_px, left + kShift_px + width));
    image.pyramid.build(ImageView(shifted), 4);
  }

  /// Between two columns of the reference frame the static prior is `prior`; at 0 the features are dropped.
  void set_prior(int left, int right, float prior) {
    const Camera& camera = sequence_.camera();
    std::vector<Vector2f> pixels;
    for (int v = 12; v < camera.height(); v += 24)
      for (int u = 12; u < camera.width(); u += 24) pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
    Matches matches;
    matches.begin(pixels);
    Observations observations = test::observations_of(matches);
    std::vector<Label> labels(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool is_between = pixels[i].x() >= static_cast<float>(left) && pixels[i].x() < static_cast<float>(right);
      labels[i].keep = !is_between || prior > 0;
      if (is_between) observations.remembered.static_prior[i] = prior;
    }
    alignment_.reference_weights.assign(observations, labels, camera.width(), camera.height());
  }

  SyntheticSequence sequence_{synthetic::pure_rotation()};
  CoarseAlignment alignment_;
};

// 1280 / 16 = 80 px on the longer side, as 640 / 8; 1920 / 16 and 3840 / 32 are 120. Upright images are as small as
// those that lie.
TEST(CoarseAlignment, ItsImagesAreAsSmallForLargeFrames) {
  for (const auto& [longer_px, levels] : {std::pair(160, 4), std::pair(640, 4), std::pair(960, 4), std::pair(1280, 5),
                                          std::pair(1920, 5), std::pair(3840, 6)}) {
    ImageView lies, stands;
    lies.width = stands.height = longer_px;
    lies.height = stands.width = 3 * longer_px / 4;
    EXPECT_EQ(CoarseAlignment::pyramid_levels(lies), static_cast<std::size_t>(levels)) << longer_px;
    EXPECT_EQ(CoarseAlignment::pyramid_levels(stands), static_cast<std::size_t>(levels)) << longer_px;
  }
}

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
  render(6, current);
  const double plain = error_px(reference, current, Pose::Identity());
  EXPECT_LT(plain, 8.0) << "of " << distance_px(current, Pose::Identity(), truth(reference, current));
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

// The current image is turned over: some motion fits a little better than what is expected, and none fits.
TEST_F(CoarseAlignmentTest, WhatIsExpectedStaysWhereNothingFits) {
  for (int first = 0; first < 120; first += 30) {
    Image reference, current;
    render(first, reference);
    render(first, current);
    cv::Mat turned;
    cv::rotate(as_mat(current.frame.gray.view()), turned, cv::ROTATE_180);
    current.pyramid.build(ImageView(turned), 4);
    alignment_.add_frame(reference.pyramid);
    alignment_.add_frame(current.pyramid);
    const FrameView view = current.frame.view();
    const Pose found = alignment_.align(view.depth, view.gray, Pose::Identity(), sequence_.camera());
    EXPECT_EQ(found.matrix(), Pose::Identity().matrix()) << first;
  }
}

// Both frames are the same but for a patch of 40 % of the width, which went 24 px to the right. Where the weights say
// that it moves, the camera has not.
TEST_F(CoarseAlignmentTest, WhatMovesHasNoSay) {
  Image reference, current;
  render(0, reference);
  const int left = kImageWidth / 4, width = 2 * kImageWidth / 5;
  shift_patch(left, width, current);
  set_prior(left, left + width + kShift_px, 0.0f);
  EXPECT_LT(error_px(reference, current, Pose::Identity()), 1.0);
}

// A patch of 70 % of the width, of which half is believed to stand, has a weight of 0.7 / 2 and the room's 0.3. Squared
// it is 0.7 / 4: the room wins.
TEST_F(CoarseAlignmentTest, AreaDoesNotMakeUpForTheStaticPrior) {
  Image reference, current;
  render(0, reference);
  const int left = kImageWidth / 8, width = 7 * kImageWidth / 10;
  shift_patch(left, width, current);
  EXPECT_GT(error_px(reference, current, Pose::Identity()), 0.5 * kShift_px) << "else the test asks nothing";
  set_prior(left, left + width + kShift_px, 0.5f);
  EXPECT_LT(error_px(reference, current, Pose::Identity()), 1.0);
}

// The cost at the truth, at a motion that puts everything some 50 px beside it, and where nothing can be compared.
TEST_F(CoarseAlignmentTest, TheCostTellsTheTruthFromAnother) {
  EXPECT_EQ(alignment_.cost(Pose::Identity(), sequence_.camera()), 0.0) << "no frame yet";
  for (int first = 0; first + 6 < 120; first += 15) {
    Image reference, current;
    render(first, reference);
    render(first + 6, current);
    error_px(reference, current, Pose::Identity());
    const Pose motion = truth(reference, current);
    EXPECT_LT(alignment_.cost(motion, sequence_.camera()), 0.4) << first;
    const Pose wrong = motion * make_pose(rotation_from_vector(Vector3d(0.1, 0, 0)), Vector3d::Zero());
    EXPECT_GT(alignment_.cost(wrong, sequence_.camera()), 0.6) << first;
    const FrameView view = current.frame.view();
    const cv::Mat nothing = cv::Mat::zeros(view.gray.height, view.gray.width, CV_16UC1);
    alignment_.align(DepthView(nothing, 5000.0), view.gray, motion, sequence_.camera());
    EXPECT_EQ(alignment_.cost(wrong, sequence_.camera()), 0.0) << "no depth";
  }
}

// Two fifths of the room's contrast are left, and before it a patch of full contrast went 24 px to the right. It
// covers a third of the width: the room, which is larger, has not moved, and says so although it is dim.
TEST_F(CoarseAlignmentTest, ADimRoomOutvotesABrightPatch) {
  Image reference, current;
  render(0, reference);
  render(0, current);
  const cv::Mat bright = as_mat(current.frame.gray.view()).clone();
  const int left = kImageWidth / 4, width = kImageWidth / 3;
  const cv::Mat patch = bright.colRange(left, left + width);
  const auto dim_with_patch_at = [&](int column) {
    cv::Mat image = bright * 0.4 + cv::Scalar(60);
    patch.copyTo(image.colRange(column, column + width));
    return image;
  };
  const cv::Mat before = dim_with_patch_at(left), after = dim_with_patch_at(left + kShift_px);
  reference.pyramid.build(ImageView(before), 4);
  current.pyramid.build(ImageView(after), 4);
  EXPECT_LT(error_px(reference, current, Pose::Identity()), 2.0);
}

}  // namespace
}  // namespace stillpoint::coarse_alignment_test
