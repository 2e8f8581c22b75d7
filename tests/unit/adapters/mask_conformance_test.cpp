// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Every adapter that takes a mask runs through the same claims: polarity by one pixel, no value between 0 and 255, and
// what it refuses. A new one is one struct here.

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "stillpoint/adapters/cuvslam.hpp"
#include "stillpoint/adapters/opencv_tracker.hpp"
#include "stillpoint/adapters/openvins.hpp"
#include "stillpoint/adapters/orb_slam.hpp"
#include "stillpoint/adapters/rtabmap.hpp"
#include "stillpoint/adapters/stella_vslam.hpp"
#include "stillpoint/adapters/vins.hpp"
#include "unit/adapters/look_alikes.hpp"

namespace mask_conformance_test {
namespace {

constexpr int kWidth = 7, kHeight = 5;

// A case: what the host gets of a mask, how it reads that, and whether the memory is its own.

struct Stella {
  static constexpr bool kIsMask = true, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) {
    return stillpoint::stella_vslam::frame_mask_0_drops(mask, kWidth, kHeight);
  }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::stella_drops(given, u, v); }
};

struct OpenVins {
  static constexpr bool kIsMask = true, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) {
    look_alikes::OpenVinsMessage message;
    message.images.emplace_back(kHeight, kWidth, CV_8UC1);
    stillpoint::openvins::set_masks_255_drops(message, {mask});
    return message.masks.at(0);
  }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::openvins_drops(given, u, v); }
};

struct CuVslam {
  static constexpr bool kIsMask = true, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) { return stillpoint::cuvslam::mask_nonzero_drops(mask); }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::cuvslam_drops(given, u, v); }
};

struct Vins {
  static constexpr bool kIsMask = true, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) {
    cv::Mat host_mask(kHeight, kWidth, CV_8UC1, cv::Scalar(255));
    stillpoint::vins::paint_mask_255_is_free(mask, host_mask);
    return host_mask;
  }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::vins_drops(given, u, v); }
};

struct OpenCvDetector {
  static constexpr bool kIsMask = true, kOwnsPixels = false;
  static cv::Mat given(const cv::Mat& mask) { return stillpoint::opencv_tracker::detection_mask_0_drops(mask); }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::opencv_drops(given, u, v); }
};

struct RtabmapDepth {
  static constexpr bool kIsMask = false, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) {
    const cv::Mat depth(kHeight, kWidth, CV_16UC1, cv::Scalar(1500));
    return stillpoint::rtabmap::depth_0_drops(depth, mask);
  }
  static bool drops(const cv::Mat& given, int u, int v) { return look_alikes::rtabmap_drops(given, u, v); }
};

/// Candidates of the octree, one at each pixel; what is given are the counts that are left.
struct OrbCandidates {
  static constexpr bool kIsMask = false, kOwnsPixels = true;
  static cv::Mat given(const cv::Mat& mask) {
    std::vector<cv::KeyPoint> candidates;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) candidates.emplace_back(static_cast<float>(u), static_cast<float>(v), 7.0f);
    stillpoint::orb_slam::erase_masked_candidates(mask, candidates, 0, 1.0);
    cv::Mat left = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
    for (const cv::KeyPoint& c : candidates)
      ++left.at<unsigned char>(static_cast<int>(c.pt.y), static_cast<int>(c.pt.x));
    return left;
  }
  static bool drops(const cv::Mat& given, int u, int v) { return given.at<unsigned char>(v, u) == 0; }
};

template <class Case>
class AdapterMask : public testing::Test {
 protected:
  /// The filter's own: 255 keeps.
  static cv::Mat all(int value) { return cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(value)); }
};

using Cases = testing::Types<Stella, OpenVins, CuVslam, Vins, OpenCvDetector, RtabmapDepth, OrbCandidates>;
struct CaseNames {
  template <class Case>
  static std::string GetName(int index) {
    return std::vector<std::string>{"Stella",         "OpenVins",     "CuVslam",      "Vins",
                                    "OpenCvDetector", "RtabmapDepth", "OrbCandidates"}
        .at(static_cast<std::size_t>(index));
  }
};
TYPED_TEST_SUITE(AdapterMask, Cases, CaseNames);

TYPED_TEST(AdapterMask, OneDroppedPixelIsTheOnlyOneThatTheHostDrops) {
  for (int v0 = 0; v0 < kHeight; ++v0) {
    for (int u0 = 0; u0 < kWidth; ++u0) {
      cv::Mat mask = this->all(255);
      mask.at<unsigned char>(v0, u0) = 0;
      const cv::Mat given = TypeParam::given(mask);
      for (int v = 0; v < kHeight; ++v)
        for (int u = 0; u < kWidth; ++u)
          ASSERT_EQ(TypeParam::drops(given, u, v), u == u0 && v == v0) << u << ", " << v << " of " << u0 << ", " << v0;
    }
  }
}

TYPED_TEST(AdapterMask, OneKeptPixelIsTheOnlyOneThatTheHostKeeps) {
  cv::Mat mask = this->all(0);
  mask.at<unsigned char>(3, 5) = 255;
  const cv::Mat given = TypeParam::given(mask);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(TypeParam::drops(given, u, v), !(u == 5 && v == 3));
}

TYPED_TEST(AdapterMask, HoldsNothingBetween0And255) {
  if (!TypeParam::kIsMask || !TypeParam::kOwnsPixels) GTEST_SKIP() << "hands over no mask of its own";
  cv::Mat mask = this->all(255);
  mask.at<unsigned char>(0, 0) = 0;
  mask.at<unsigned char>(0, 1) = 1;  // not 0: keeps
  mask.at<unsigned char>(0, 2) = 128;
  const cv::Mat given = TypeParam::given(mask);
  EXPECT_EQ(given.type(), CV_8UC1);
  EXPECT_EQ(given.size(), mask.size());
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int value = given.at<unsigned char>(v, u);
      EXPECT_TRUE(value == 0 || value == 255) << value;
      EXPECT_EQ(TypeParam::drops(given, u, v), u == 0 && v == 0);
    }
  }
}

TYPED_TEST(AdapterMask, ThePixelsThatTheHostHoldsOnToAreItsOwn) {
  if (!TypeParam::kOwnsPixels) GTEST_SKIP() << "a view, for the time of a call";
  cv::Mat mask = this->all(255);
  const cv::Mat given = TypeParam::given(mask);
  mask.setTo(0);  // the filter's next frame, in the same buffer
  EXPECT_FALSE(TypeParam::drops(given, 2, 2));
}

TYPED_TEST(AdapterMask, ReadsRowsWithGaps) {
  cv::Mat wide(kHeight, kWidth + 6, CV_8UC1, cv::Scalar(0));
  cv::Mat mask = wide.colRange(2, 2 + kWidth);
  mask.setTo(255);
  mask.at<unsigned char>(4, 6) = 0;
  const cv::Mat given = TypeParam::given(mask);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_EQ(TypeParam::drops(given, u, v), u == 6 && v == 4);
}

TYPED_TEST(AdapterMask, RefusesAnotherFormat) {
  EXPECT_THROW(TypeParam::given(cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar())), stillpoint::Error);
  EXPECT_THROW(TypeParam::given(cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(1))), stillpoint::Error);
}

}  // namespace
}  // namespace mask_conformance_test
