// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/pipeline/frame_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "stillpoint/core/camera.hpp"
#include "stillpoint/opencv.hpp"

namespace stillpoint::frame_check_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class FrameCheckTest : public testing::Test {
 protected:
  Status check(const FrameView& frame, std::optional<double> last_s = 1.0) const {
    return FrameCheck{}(frame, last_s, camera_);
  }
  Status check(const cv::Mat& image, const DepthView& depth) const { return check(FrameView(image, depth, 1.1)); }

  Camera camera_{5, 5, 4, 3, 8, 6};
  cv::Mat gray_ = cv::Mat(6, 8, CV_8UC1, cv::Scalar(0));
  cv::Mat colour_ = cv::Mat(6, 8, CV_8UC3, cv::Scalar(0));
  cv::Mat depth_ = cv::Mat(6, 8, CV_16UC1, cv::Scalar(0));
};

TEST_F(FrameCheckTest, TakesGrayAndColourWithAnyDepth) {
  const cv::Mat float_depth(3, 4, CV_32FC1, cv::Scalar(2.0));
  for (const cv::Mat& image : {gray_, colour_}) {
    EXPECT_EQ(check(image, DepthView::tum(depth_)), Status::ok);
    EXPECT_EQ(check(image, DepthView::tum(float_depth)), Status::ok) << "another size is fine";
    EXPECT_EQ(check(image, DepthView()), Status::ok);
  }
}

TEST_F(FrameCheckTest, NamesImagesItCannotRead) {
  EXPECT_EQ(check(cv::Mat(), DepthView::tum(depth_)), Status::no_image);
  EXPECT_EQ(check(FrameView()), Status::no_image);
  for (const int type : {CV_16SC3, CV_32FC1, CV_16UC1, CV_8UC4, CV_8SC1})
    EXPECT_EQ(check(cv::Mat(6, 8, type, cv::Scalar(0)), DepthView::tum(depth_)), Status::unsupported_image) << type;
}

TEST_F(FrameCheckTest, NamesRowsThatOverlapOrLieAtOddAddresses) {
  const auto depth = [&](std::size_t stride, std::size_t shift = 0) {
    return DepthView::millimetres(ImageView(depth_.data + shift, 7, 4, stride, PixelFormat::depth16));
  };
  EXPECT_EQ(check(gray_, depth(16)), Status::ok);
  EXPECT_EQ(check(gray_, depth(14)), Status::ok);
  EXPECT_EQ(check(gray_, depth(7)), Status::unsupported_image) << "a stride in pixels";
  EXPECT_EQ(check(gray_, depth(0)), Status::unsupported_image);
  EXPECT_EQ(check(gray_, depth(15)), Status::unsupported_image) << "every second row at an odd address";
  EXPECT_EQ(check(gray_, depth(16, 1)), Status::unsupported_image);
  for (const auto& [stride, status] : {std::pair(23u, Status::unsupported_image), std::pair(25u, Status::ok)}) {
    const ImageView colour(colour_.data, 8, 5, stride, PixelFormat::bgr8);
    camera_ = Camera(5, 5, 4, 3, 8, 5);
    EXPECT_EQ(check(FrameView(colour, DepthView(), 1.1)), status) << stride;
  }
}

TEST_F(FrameCheckTest, NamesDepthsItCannotRead) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_64FC1, CV_32FC3, CV_16SC1})
    EXPECT_EQ(check(gray_, DepthView(cv::Mat(6, 8, type, cv::Scalar(0)))), Status::unsupported_image) << type;
  for (const double factor : {0.0, -5000.0, kNaN, 1e-300, 1e300})
    EXPECT_EQ(check(gray_, DepthView(depth_, factor)), Status::depth_unit_missing) << factor;
  EXPECT_EQ(check(gray_, DepthView(depth_)), Status::depth_unit_missing) << "16 bit has no default";
  EXPECT_EQ(check(gray_, DepthView::millimetres(depth_)), Status::ok);
  EXPECT_EQ(check(gray_, DepthView(cv::Mat(6, 8, CV_32FC1, cv::Scalar(2)))), Status::ok)
      << "float metres have no factor";
}

// A room in millimetres: half a metre is 500. One far wall among near things is none.
TEST_F(FrameCheckTest, NamesDepthsBeyondAKilometre) {
  cv::Mat depth(6, 8, CV_32FC1, cv::Scalar(2000));
  EXPECT_EQ(check(gray_, DepthView(depth)), Status::implausible_depth);
  depth.colRange(0, 4).setTo(2);
  EXPECT_EQ(check(gray_, DepthView(depth)), Status::ok) << "half, not more";
  depth.setTo(0);
  EXPECT_EQ(check(gray_, DepthView(depth)), Status::ok) << "none at all";
}

// A gray image in the place of the colour one would be read three times as wide as it is.
TEST_F(FrameCheckTest, NamesImagesInTheWrongPlace) {
  FrameView frame;
  frame.timestamp_s = 1.1;
  frame.colour = gray_;
  EXPECT_EQ(check(frame), Status::unsupported_image);
  frame.gray = gray_;
  EXPECT_EQ(check(frame), Status::unsupported_image);
  frame.colour = colour_;
  EXPECT_EQ(check(frame), Status::ok);
  frame.gray = colour_;
  EXPECT_EQ(check(frame), Status::unsupported_image);
  frame.gray = gray_;
  const cv::Mat other_size(3, 4, CV_8UC3, cv::Scalar(0));
  frame.colour = other_size;
  EXPECT_EQ(check(frame), Status::size_changed);
}

TEST_F(FrameCheckTest, NamesAnotherSize) {
  EXPECT_EQ(check(cv::Mat(6, 7, CV_8UC1, cv::Scalar(0)), DepthView()), Status::size_changed);
  EXPECT_EQ(check(cv::Mat(8, 6, CV_8UC1, cv::Scalar(0)), DepthView()), Status::size_changed);
}

TEST_F(FrameCheckTest, NamesTimesThatDoNotFollow) {
  const auto at = [this](double time_s, std::optional<double> last_s) {
    return check(FrameView(gray_, DepthView(), time_s), last_s);
  };
  EXPECT_EQ(at(1.0, std::nullopt), Status::first_frame);
  EXPECT_EQ(at(1.1, 1.0), Status::ok);
  EXPECT_EQ(at(2.0, 1.0), Status::ok) << "exactly the longest gap";
  EXPECT_EQ(at(2.001, 1.0), Status::time_gap);
  EXPECT_EQ(at(1.0, 1.0), Status::duplicate_frame);
  EXPECT_EQ(at(0.999, 1.0), Status::out_of_order);
  EXPECT_EQ(at(-100.0, 1.0), Status::out_of_order);
  for (const double no_time : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(at(no_time, 1.0), Status::invalid_time);
    EXPECT_EQ(at(no_time, std::nullopt), Status::invalid_time);
  }
  FrameCheck patient;
  patient.options.longest_gap_s = 10.0;
  EXPECT_EQ(patient(FrameView(gray_, DepthView(), 11.0), 1.0, camera_), Status::ok);
}

TEST_F(FrameCheckTest, RejectsWhatIsNoFrame) {
  for (const Status status :
       {Status::no_image, Status::unsupported_image, Status::depth_unit_missing, Status::implausible_depth,
        Status::size_changed, Status::invalid_time, Status::invalid_options, Status::duplicate_frame})
    EXPECT_TRUE(FrameCheck::rejects(status)) << to_string(status);
  for (const Status status : {Status::ok, Status::first_frame, Status::out_of_order, Status::time_gap})
    EXPECT_FALSE(FrameCheck::rejects(status)) << to_string(status);
}

}  // namespace
}  // namespace stillpoint::frame_check_test
