// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Hosts with types of their own, by our look-alikes: of each one's three features the adapter must drop the second, by
// flags or by a mask.

#include <cstdio>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <stillpoint/adapters/cuvslam.hpp>
#include <stillpoint/adapters/opencv_tracker.hpp>
#include <stillpoint/adapters/openvins.hpp>
#include <stillpoint/adapters/orb_slam.hpp>
#include <stillpoint/adapters/rtabmap.hpp>
#include <stillpoint/adapters/stella_vslam.hpp>
#include <stillpoint/adapters/vins.hpp>
#include <stillpoint/filtered_tracker.hpp>
#include <vector>

#include "../../unit/adapters/finished_orb_frame.hpp"
#include "../../unit/adapters/look_alikes.hpp"
#include "tripod_policies.hpp"

using stillpoint::Vector3d;
const std::vector<std::uint8_t> kKeep = {1, 0, 1};
const std::vector<cv::KeyPoint> kKeypoints = {{0, 0, 7}, {1, 0, 7}, {2, 0, 7}};
const cv::Mat kMask = (cv::Mat_<unsigned char>(1, 3) << 255, 0, 255);
const cv::Mat kRows = (cv::Mat_<unsigned char>(3, 1) << 1, 2, 3);
std::size_t kept_count = 0, all_count = 0, wrong_count = 0;

void expect_two(const char* what, std::size_t count) {
  kept_count += count, all_count += 2;
  if (count != 2) std::printf("%zu: %s left %zu features, expected 2\n", ++wrong_count, what, count);
}
std::size_t zeros(const cv::Mat& mask) { return mask.total() - static_cast<std::size_t>(cv::countNonZero(mask)); }

void orb_slam() {
  look_alikes::FinishedOrbFrame finished(3), with_depth(3), extracted(3), fisheye(3);
  std::vector<float> of_a_fork(3);
  int mono_count = 1;
  expect_two("orb_slam, hook A", stillpoint::orb_slam::compact_after_depth(kKeep, with_depth, of_a_fork));
  expect_two("orb_slam, hook B", stillpoint::orb_slam::compact_after_extraction(kKeep, extracted));
  expect_two("orb_slam, hook C", stillpoint::orb_slam::compact_frame(kKeep, finished));
  expect_two("orb_slam, a fisheye",
             stillpoint::orb_slam::compact_mono_first(kKeep, fisheye.mvKeys, fisheye.mDescriptors, mono_count));
  std::vector<cv::KeyPoint> candidates = kKeypoints;
  stillpoint::orb_slam::erase_masked_candidates(kMask, candidates, 0, 1.0);
  expect_two("orb_slam, the extractor", candidates.size());
  const bool halves = stillpoint::orb_slam::weighted_inv_sigma2(2.0f, std::vector<float>{0.5f}, 0) < 1.5f &&
                      stillpoint::orb_slam::weighted_inv_sigma2(2.0, std::vector<float>{0.5f}, 0) < 1.5;
  expect_two("orb_slam, the optimiser", halves ? 2 : 0);
}

void stella_vslam() {
  look_alikes::StellaObservation<> observation{kRows.clone(), kKeypoints, {3, Vector3d::UnitZ()}, {}, {},
                                               {{{0, 1, 2}}}};
  std::vector<int> old_to_new;
  expect_two("stella_vslam", stillpoint::stella_vslam::compact_observation(kKeep, observation, old_to_new));
  expect_two("stella_vslam's grid", observation.keypt_indices_in_cells_[0][0].size());
  const auto pinhole =
      stillpoint::stella_vslam::camera(look_alikes::StellaPerspective{4, 2, 3, 3, 1, 1, 0, 0, 0, 0, 0});
  const auto fisheye = stillpoint::stella_vslam::camera(look_alikes::StellaFisheye{4, 2, 3, 3, 1, 1, 0, 0, 0, 0});
  expect_two("stella_vslam's cameras", static_cast<std::size_t>(pinhole.height() * fisheye.width() / 4));
}

void vins() {
  look_alikes::VinsTracker<> tracker{{}, {3, cv::Point2f()}, {0, 1, 2}, {1, 1, 1}};
  std::set<int> dropped;
  stillpoint::vins::dropped_ids(kKeep, tracker.ids, dropped);
  std::map<int, std::vector<int>> feature_frame = {{0, {}}, {1, {}}, {2, {}}};
  stillpoint::vins::erase_features(dropped, feature_frame);
  expect_two("vins, its features", feature_frame.size());
  expect_two("vins, its tracks", stillpoint::vins::compact_tracks(kKeep, tracker));
}

void masks() {
  look_alikes::OpenVinsMessage message;
  message.images = {kMask};
  stillpoint::openvins::set_masks_255_drops(message, {kMask});
  expect_two("openvins", zeros(message.masks.at(0)));
  expect_two("cuvslam", zeros(stillpoint::cuvslam::mask_nonzero_drops(kMask)));
}

void rtabmap() {
  std::vector<cv::KeyPoint> keypoints = kKeypoints;
  std::vector<cv::Point3f> points(3);
  cv::Mat descriptors = kRows.clone();
  expect_two("rtabmap", stillpoint::rtabmap::compact_features(kKeep, keypoints, points, descriptors));
}

/// A backend that offers all that `FilteredTracker` may ask for.
struct Flow {
  struct Features : stillpoint::opencv_tracker::Features<cv::Point2f> {
    void weigh(stillpoint::span<const float> weights) { expect_two("weights", weights.size()); }
  };
  std::vector<std::uint8_t> dynamic;

  Features extract(const stillpoint::FrameView&) { return {{{{20, 20}, {40, 20}}, {}, {0, 2}}}; }
  std::optional<stillpoint::Pose> track(const stillpoint::FrameView&, const Features& features) {
    expect_two("FilteredTracker", features.ids.size());
    dynamic.assign(features.ids.size(), 0);
    return stillpoint::Pose::Identity();
  }
  void expect_motion(const stillpoint::Pose&) {}
  const std::vector<std::uint8_t>& dynamic_features() const { return dynamic; }
};

void opencv_tracker() {
  std::vector<cv::Point2f> previous(3), current(3);
  std::vector<std::uint8_t> keep(3, 1);
  stillpoint::opencv_tracker::drop_lost(kKeep, keep);
  expect_two("opencv_tracker", stillpoint::opencv_tracker::compact_tracks(keep, previous, current));
  const cv::Mat gray(48, 64, CV_8UC1, cv::Scalar(100));
  using Filter = stillpoint::FrameFilter<TripodPolicies>;
  stillpoint::FilteredTracker<Filter, Flow> tracker(Filter(stillpoint::Camera(60, 60, 32, 24, 64, 48)), {});
  tracker.track({gray, cv::Mat(), 0.0});
}

int main() {
  orb_slam();
  stella_vslam();
  vins();
  masks();
  rtabmap();
  opencv_tracker();
  std::printf("kept %zu of %zu\n", kept_count, all_count);
  return wrong_count == 0 ? 0 : 1;
}
