// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The code of docs/adopting.md, line by line, run with types that look like the hosts'.

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

// clang-format off
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/adapters/orb_slam.hpp>
#include <stillpoint/adapters/stella_vslam.hpp>
#include <stillpoint/adapters/openvins.hpp>
#include <stillpoint/adapters/rtabmap.hpp>
#include <map>
#include <set>
#include <stillpoint/adapters/vins.hpp>
#include <opencv2/video/tracking.hpp>
#include <stillpoint/adapters/opencv_tracker.hpp>
// clang-format on

#include "unit/adapters/look_alikes.hpp"
#include "unit/adapters/tagged_arrays.hpp"

namespace {

// clang-format off
/// Behind the extractor, before the tracker. The arrays are the host's, one entry per keypoint.
void filter_features(stillpoint::FrameFilter<>& filter, const cv::Mat& gray, const cv::Mat& depth_mm, double time_s,
                     std::vector<cv::KeyPoint>& keypoints, cv::Mat& descriptors) {
  const auto depth = stillpoint::DepthView::millimetres(depth_mm);   // 16 bit; float images are metres
  const auto& result = filter.filter_frame({gray, depth, time_s}, keypoints);
  stillpoint::compact(result.keep(), keypoints, descriptors);
}

/// After ComputeStereoFromRGBD. Frame is the host's: filter_orb_frame(*filter, *this, imGray, imDepth, timeStamp).
template <class Frame>
void filter_orb_frame(stillpoint::FrameFilter<>& filter, Frame& frame, const cv::Mat& gray, const cv::Mat& depth_m,
                      double time_s) {
  const auto& result = filter.filter_frame({gray, depth_m, time_s}, frame.mvKeys);
  stillpoint::orb_slam::compact_after_depth(result.keep(), frame);
}

/// `frame` is what create_RGBD_frame returned.
template <class Frame>
void filter_stella_frame(stillpoint::FrameFilter<>& filter, Frame& frame, const cv::Mat& gray,
                         const stillpoint::DepthView& depth, std::vector<int>& old_to_new) {
  const auto& result = filter.filter_frame({gray, depth, frame.timestamp_}, frame.frm_obs_.undist_keypts_);
  stillpoint::stella_vslam::compact_observation(result.keep(), frame.frm_obs_, old_to_new);
}

/// Before feed_measurement_camera. An empty mask drops nothing in its image.
template <class CameraData>
void mask_openvins_message(CameraData& message, const stillpoint::ImageView& left, const stillpoint::ImageView& right) {
  stillpoint::openvins::set_masks_255_drops(message, {left, right});
}

/// `data` is the host's SensorData.
template <class SensorData>
void set_filtered_features(const stillpoint::FrameResult& result, std::vector<cv::KeyPoint> keypoints,
                           std::vector<cv::Point3f> keypoints3D, cv::Mat descriptors, SensorData& data) {
  stillpoint::rtabmap::compact_features(result.keep(), keypoints, keypoints3D, descriptors);
  data.setFeatures(keypoints, keypoints3D, descriptors);
}

/// Between trackImage and inputFeature. `ids` in the order of the keypoints that were filtered.
template <class FrameFeatures>
void erase_moving(const stillpoint::FrameResult& result, const std::vector<int>& ids,
                  std::map<int, FrameFeatures>& feature_frame) {
  std::set<int> dropped;
  stillpoint::vins::dropped_ids(result.keep(), ids, dropped);
  stillpoint::vins::erase_features(dropped, feature_frame);
}

/// Follows points into the next image and keeps those that were found and stand still.
void follow(stillpoint::FrameFilter<>& filter, const cv::Mat& last, const cv::Mat& gray,
            const stillpoint::DepthView& depth, double time_s, std::vector<cv::Point2f>& previous, std::vector<cv::Point2f>& current) {
  std::vector<unsigned char> status;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(last, gray, previous, current, status, error);
  const auto& result = filter.filter_frame({gray, depth, time_s}, current);
  std::vector<std::uint8_t> keep(result.keep().begin(), result.keep().end());
  stillpoint::opencv_tracker::drop_lost(status, keep);
  stillpoint::opencv_tracker::compact_tracks(keep, previous, current);
}
// clang-format on

const stillpoint::Camera kCamera(260, 260, 159.5, 119.5, 320, 240);

/// A first frame, of which the filter keeps everything.
struct FirstFrame {
  cv::Mat gray = cv::Mat(240, 320, CV_8UC1, cv::Scalar(100)), depth_m = cv::Mat(240, 320, CV_32FC1, cv::Scalar(2.0));
  stillpoint::FrameFilter<> filter = stillpoint::FrameFilter<>(kCamera);

  cv::Mat depth_mm() const {
    cv::Mat result;
    depth_m.convertTo(result, CV_16UC1, 1000.0);
    return result;
  }
  /// Whether the filter judged it: what is refused keeps everything, too, and the next frame would be the first.
  bool was_taken() {
    const std::vector<cv::KeyPoint> keypoints = {{100.0f, 100.0f, 31.0f}};
    return filter.filter_frame({gray, depth_m, 2.0}, keypoints).status() != stillpoint::Status::first_frame;
  }
};

TEST(AdoptingDocument, TheCallOfAnyHostRuns) {
  FirstFrame first;
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  look_alikes::fill_all(std::tie(keypoints, descriptors), 5);
  filter_features(first.filter, first.gray, first.depth_mm(), 1.0, keypoints, descriptors);
  EXPECT_EQ(keypoints.size(), 5u);
  EXPECT_TRUE(first.was_taken());
}

TEST(AdoptingDocument, TheCallInAFrameOfOrbSlamRuns) {
  FirstFrame first;
  look_alikes::OrbFrame<> frame;
  look_alikes::fill_all(std::tie(frame.mvKeys, frame.mvKeysUn, frame.mvuRight, frame.mvDepth, frame.mDescriptors), 5);
  filter_orb_frame(first.filter, frame, first.gray, first.depth_m, 1.0);
  EXPECT_EQ(frame.N, 5);
  EXPECT_TRUE(first.was_taken());
}

struct StellaFrame {
  double timestamp_ = 1.0;
  look_alikes::StellaObservation<> frm_obs_;
};

TEST(AdoptingDocument, TheCallForStellaVslamRuns) {
  FirstFrame first;
  StellaFrame frame;
  auto& observation = frame.frm_obs_;
  look_alikes::fill_all(std::tie(observation.descriptors_, observation.undist_keypts_, observation.bearings_), 5);
  std::vector<int> old_to_new;
  filter_stella_frame(first.filter, frame, first.gray, first.depth_m, old_to_new);
  EXPECT_EQ(old_to_new, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(first.was_taken());
}

TEST(AdoptingDocument, TheMasksForOpenVinsAreItsOwn) {
  look_alikes::OpenVinsMessage message;
  message.images = {cv::Mat(5, 7, CV_8UC1), cv::Mat(5, 7, CV_8UC1)};
  const cv::Mat mask(5, 7, CV_8UC1, cv::Scalar(0));
  mask_openvins_message(message, mask, {});
  EXPECT_EQ(cv::countNonZero(message.masks.at(0)), 35);
  EXPECT_EQ(cv::countNonZero(message.masks.at(1)), 0);
}

struct SensorData {
  std::vector<cv::KeyPoint> keypoints;
  void setFeatures(const std::vector<cv::KeyPoint>& k, const std::vector<cv::Point3f>&, const cv::Mat&) {
    keypoints = k;
  }
};

TEST(AdoptingDocument, RtabmapAndVinsTakeTheResult) {
  FirstFrame first;
  std::vector<cv::KeyPoint> keypoints;
  look_alikes::fill(keypoints, 3);
  const cv::Mat depth_mm = first.depth_mm();
  const auto& result =
      first.filter.filter_frame({first.gray, stillpoint::DepthView::millimetres(depth_mm), 1.0}, keypoints);
  SensorData data;
  set_filtered_features(result, keypoints, {}, cv::Mat(), data);
  EXPECT_EQ(data.keypoints.size(), 3u);
  std::map<int, double> feature_frame = {{0, 0.0}, {1, 0.0}, {2, 0.0}};
  erase_moving(result, {0, 1, 2}, feature_frame);
  EXPECT_EQ(feature_frame.size(), 3u);
  EXPECT_TRUE(first.was_taken());
}

TEST(AdoptingDocument, PointsThatAreLostAreDropped) {
  FirstFrame first;
  first.gray.setTo(0);
  first.gray(cv::Rect(100, 100, 9, 9)).setTo(255);
  std::vector<cv::Point2f> previous = {{104.0f, 104.0f}, {1000.0f, 1000.0f}}, current;
  follow(first.filter, first.gray, first.gray, first.depth_m, 1.0, previous, current);
  ASSERT_EQ(current.size(), 1u);
  EXPECT_EQ(previous, (std::vector<cv::Point2f>{{104.0f, 104.0f}}));
  EXPECT_TRUE(first.was_taken());
}

}  // namespace
