// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What single hosts need beyond the conformance suites.

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <variant>
#include <vector>

#include "stillpoint/adapters/opencv_tracker.hpp"
#include "stillpoint/adapters/openvins.hpp"
#include "stillpoint/adapters/rtabmap.hpp"
#include "stillpoint/adapters/stella_vslam.hpp"
#include "stillpoint/adapters/vins.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/null_filter.hpp"
#include "unit/adapters/look_alikes.hpp"
#include "unit/adapters/tagged_arrays.hpp"
#include "unit/error_of.hpp"

namespace {

using look_alikes::Counter;
using stillpoint::error_of;
using Flags = std::vector<std::uint8_t>;

TEST(StellaVslam, TheCellsOfTheGridHoldTheNewIndices) {
  look_alikes::StellaObservation<> observation;
  look_alikes::fill_all(std::tie(observation.descriptors_, observation.undist_keypts_, observation.bearings_), 6);
  observation.keypt_indices_in_cells_ = {{{0, 3}, {}}, {{1, 2, 5}, {4}}};
  std::vector<int> old_to_new;
  EXPECT_EQ(stillpoint::stella_vslam::compact_observation(Flags{1, 0, 1, 0, 0, 1}, observation, old_to_new), 3u);
  EXPECT_EQ(observation.keypt_indices_in_cells_,
            (std::vector<std::vector<std::vector<unsigned int>>>{{{0}, {}}, {{1, 2}, {}}}));
  EXPECT_EQ(old_to_new, (std::vector<int>{0, -1, 1, -1, -1, 2}));
}

TEST(StellaVslam, AMonocularFrameHasNoDepths) {
  look_alikes::StellaObservation<> observation;
  look_alikes::fill_all(std::tie(observation.descriptors_, observation.undist_keypts_, observation.bearings_), 3);
  std::vector<int> old_to_new;
  EXPECT_EQ(stillpoint::stella_vslam::compact_observation(Flags{1, 0, 1}, observation, old_to_new), 2u);
  EXPECT_TRUE(look_alikes::holds(observation.bearings_, {0, 2}));
  EXPECT_TRUE(observation.depths_.empty() && observation.stereo_x_right_.empty());
}

TEST(StellaVslam, AMaskOfAnotherSizeIsRefused) {
  EXPECT_EQ(error_of([] { stillpoint::stella_vslam::frame_mask_0_drops(cv::Mat(5, 7, CV_8UC1), 7, 6); }),
            "stella_vslam: the mask has 7x5 pixels, expected the image's 7x6");
}

TEST(StellaVslam, TheCameraHasTheLensOfTheHost) {
  using stillpoint::stella_vslam::camera;
  const auto brown =
      camera(look_alikes::StellaPerspective{640, 480, 500, 510, 320, 240, 0.1, -0.2, 0.003, 0.004, 0.05});
  EXPECT_EQ(brown.width(), 640);
  EXPECT_EQ(brown.height(), 480);
  EXPECT_EQ(brown.matrix(), (stillpoint::Matrix3d() << 500, 0, 320, 0, 510, 240, 0, 0, 1).finished());
  const stillpoint::BrownConrady expected{0.1, -0.2, 0.003, 0.004, 0.05};
  const stillpoint::Vector2d on_plane(0.3, -0.2);
  EXPECT_EQ(brown.distortion().distort(on_plane), expected.distort(on_plane));

  const auto none = camera(look_alikes::StellaPerspective{640, 480, 500, 510, 320, 240, 0, 0, 0, 0, 0});
  EXPECT_TRUE(std::holds_alternative<stillpoint::NoDistortion>(none.distortion().model));

  const auto fisheye = camera(look_alikes::StellaFisheye{640, 480, 500, 510, 320, 240, 0.1, -0.02, 0.003, 0.004});
  const stillpoint::EquidistantFisheye lens{0.1, -0.02, 0.003, 0.004};
  EXPECT_EQ(fisheye.distortion().distort(on_plane), lens.distort(on_plane));
}

TEST(OpenVins, EachImageHasAMask) {
  look_alikes::OpenVinsMessage message;
  message.images = {cv::Mat(5, 7, CV_8UC1), cv::Mat(6, 8, CV_8UC1)};
  const cv::Mat mask(5, 7, CV_8UC1, cv::Scalar(0));
  stillpoint::openvins::set_masks_255_drops(message, {mask, {}});
  ASSERT_EQ(message.masks.size(), 2u);
  EXPECT_EQ(cv::countNonZero(message.masks[0]), 35);
  EXPECT_EQ(message.masks[1].size(), message.images[1].size());
  EXPECT_EQ(cv::countNonZero(message.masks[1]), 0) << "no mask drops nothing";

  EXPECT_EQ(error_of([&] { stillpoint::openvins::set_masks_255_drops(message, {mask}); }),
            "openvins: 1 masks, expected one for each of the 2 images");
  EXPECT_EQ(error_of([&] {
              stillpoint::openvins::set_masks_255_drops(message, {{}, mask});
            }),
            "openvins: the mask has 7x5 pixels, expected the image's 8x6");
  EXPECT_EQ(message.masks.size(), 2u) << "unchanged";
}

TEST(Rtabmap, FloatDepthLosesWhatTheMaskDrops) {
  cv::Mat depth(5, 7, CV_32FC1, cv::Scalar(1.5f)), mask(5, 7, CV_8UC1, cv::Scalar(255));
  depth.at<float>(1, 1) = std::numeric_limits<float>::quiet_NaN();
  mask.at<unsigned char>(2, 3) = 0;
  const cv::Mat given = stillpoint::rtabmap::depth_0_drops(depth, mask);
  EXPECT_EQ(given.at<float>(2, 3), 0.0f);
  EXPECT_EQ(cv::countNonZero(given == 1.5f), 33) << "35 but the dropped one and the NaN";
  EXPECT_EQ(depth.at<float>(2, 3), 1.5f) << "the host's own is as it was";
  EXPECT_THROW(stillpoint::rtabmap::depth_0_drops(cv::Mat(), mask), stillpoint::Error);
  EXPECT_THROW(stillpoint::rtabmap::depth_0_drops(cv::Mat(5, 7, CV_64FC1), mask), stillpoint::Error);
}

TEST(Rtabmap, FeaturesWithoutPointsOrDescriptors) {
  std::vector<cv::KeyPoint> keypoints;
  look_alikes::fill(keypoints, 3);
  std::vector<cv::Point3f> points;
  cv::Mat descriptors;
  EXPECT_EQ(stillpoint::rtabmap::compact_features(Flags{0, 1, 1}, keypoints, points, descriptors), 2u);
  EXPECT_TRUE(look_alikes::holds(keypoints, {1, 2}));
  EXPECT_TRUE(points.empty() && descriptors.empty());
}

look_alikes::VinsFeatureFrame feature_frame(int count) {
  look_alikes::VinsFeatureFrame frame;
  for (int id = 0; id < count; ++id)
    frame.emplace_hint(frame.end(), id, std::vector<std::pair<int, Eigen::Matrix<double, 7, 1>>>(1));
  return frame;
}

TEST(Vins, DroppedIdsLeaveTheFeatureFrame) {
  const std::vector<int> ids = {7, 2, 5, 3};
  std::set<int> dropped = {11};
  stillpoint::vins::dropped_ids(Flags{0, 1, 0, 1}, ids, dropped);
  EXPECT_EQ(dropped, (std::set<int>{5, 7, 11}));
  auto frame = feature_frame(9);
  EXPECT_EQ(stillpoint::vins::erase_features(dropped, frame), 2u) << "11 is not there";
  EXPECT_EQ(frame.size(), 7u);
  EXPECT_EQ(frame.count(5) + frame.count(7), 0u);
  EXPECT_EQ(stillpoint::vins::erase_features(std::set<int>(), frame), 0u);
  EXPECT_EQ(stillpoint::vins::erase_features(std::vector<int>{0, 1, 2, 3, 4, 6, 8}, frame), 7u);
  EXPECT_TRUE(frame.empty());
  EXPECT_EQ(stillpoint::vins::erase_features(dropped, frame), 0u);
  EXPECT_EQ(error_of([&] { stillpoint::vins::dropped_ids(Flags(3, 1), ids, dropped); }),
            "vins: 4 ids, expected one for each of the 3 keep flags");
}

TEST(Vins, ErasingFromTheFeatureFrameSearchesNothing) {
  constexpr int count = 10000;
  auto frame = feature_frame(count);
  std::vector<int> dropped;
  for (int id = 0; id < count; id += 2) dropped.push_back(id);
  Counter::comparisons = 0;
  EXPECT_EQ(stillpoint::vins::erase_features(dropped, frame), 5000u);
  EXPECT_EQ(Counter::comparisons, 0u) << "one walk, no look-up by id";
}

TEST(Vins, PaintingLeavesTheRestOfTheHostsMask) {
  cv::Mat host_mask(5, 7, CV_8UC1, cv::Scalar(255)), mask(5, 7, CV_8UC1, cv::Scalar(255));
  host_mask.at<unsigned char>(0, 0) = 0;  // a fisheye's rim
  mask.at<unsigned char>(2, 3) = 0;
  stillpoint::vins::paint_mask_255_is_free(mask, host_mask);
  EXPECT_EQ(cv::countNonZero(host_mask == 255), 33);
  EXPECT_EQ(host_mask.at<unsigned char>(0, 0), 0);
  EXPECT_THROW(stillpoint::vins::paint_mask_255_is_free(cv::Mat(5, 8, CV_8UC1), host_mask), stillpoint::Error);
}

TEST(OpenCvTracker, WhatIsLostIsDroppedToo) {
  Flags keep = {1, 1, 0, 1};
  stillpoint::opencv_tracker::drop_lost(Flags{1, 0, 1, 255}, keep);
  EXPECT_EQ(keep, (Flags{1, 0, 0, 1}));
  EXPECT_EQ(error_of([&] { stillpoint::opencv_tracker::drop_lost(Flags{1}, keep); }),
            "opencv_tracker: status has 1 entries, expected one for each of the 4 keep flags");
}

/// A backend whose features are those of the adapter.
struct PointBackend {
  using Features = stillpoint::opencv_tracker::Features<cv::Point2f>;
  std::size_t tracked = 0;

  Features extract(const stillpoint::FrameView&) {
    Features features;
    look_alikes::fill(features.keypoints, 5);
    look_alikes::fill(features.ids, 5);
    return features;
  }
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView&, const Features& features) {
    tracked = features.keypoints.size();
    return stillpoint::Pose::Identity();
  }
};

TEST(OpenCvTracker, ItsFeaturesGoThroughTheFilteredTracker) {
  stillpoint::FilteredTracker<stillpoint::NullFilter, PointBackend> tracker({}, {});
  EXPECT_TRUE(tracker.track(stillpoint::FrameView()));
  EXPECT_EQ(tracker.backend.tracked, 5u);
}

}  // namespace
