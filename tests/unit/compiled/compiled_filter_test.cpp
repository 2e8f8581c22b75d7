// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The filter of stillpoint::compiled: what a host calls on it reaches the pipeline in the library.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "stillpoint/motion/rigid/support_motion.hpp"
#include "stillpoint/movers/mover_tracking.hpp"
#include "stillpoint/options/options_file.hpp"
#include "stillpoint/policies/with_movers.hpp"
#include "stillpoint/stillpoint.hpp"

namespace stillpoint::compiled_filter_test {

static_assert(std::is_same_v<FrameFilter<>, FrameFilter<CompiledPolicies>>, "the target says STILLPOINT_COMPILED");
static_assert(std::is_nothrow_move_constructible_v<FrameFilter<>>);
static_assert(std::is_same_v<WithMovers<>, WithMovers<CompiledPolicies>>);

Camera camera() { return Camera(200, 200, 159.5, 119.5, 320, 240); }

std::uint8_t texture(int u, int v) {
  return static_cast<std::uint8_t>((u / 4 * 73856093 ^ v / 4 * 19349663) >> 7 & 255);
}

/// A wall at 2 m and before it, at 1.5 m, a square that moves 6 pixels to the right from frame to frame.
struct Scene {
  explicit Scene(int frame)
      : square(40 + 6 * frame, 60, 80, 80),
        gray(240, 320, CV_8UC1),
        depth_m(240, 320, CV_32FC1, cv::Scalar(2.0)),
        time_s(1.0 + frame / 30.0) {
    depth_m(square).setTo(1.5);
    for (int v = 0; v < gray.rows; ++v)
      for (int u = 0; u < gray.cols; ++u)
        gray.at<std::uint8_t>(v, u) =
            square.contains(cv::Point(u, v)) ? texture(u - square.x + 4000, v - square.y) : texture(u, v);
    for (int v = 20; v < 220; v += 10)
      for (int u = 20; u < 300; u += 10) keypoints.emplace_back(static_cast<float>(u), static_cast<float>(v), 7.0f);
  }

  FrameView frame() const { return {gray, depth_m, time_s}; }
  std::size_t kept_on_square(const FrameResult& result) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < keypoints.size(); ++i)
      count += square.contains(keypoints[i].pt) && result.keep()[i] != 0 ? 1u : 0u;
    return count;
  }

  cv::Rect square;
  cv::Mat gray, depth_m;
  double time_s;
  std::vector<cv::KeyPoint> keypoints;
};

constexpr int kFrames = 6;

const FrameResult& run(FrameFilter<>& filter) {
  for (int frame = 0; frame + 1 < kFrames; ++frame) {
    const Scene scene(frame);
    filter.filter_frame(scene.frame(), scene.keypoints);
  }
  const Scene last(kFrames - 1);
  return filter.filter_frame(last.frame(), last.keypoints);
}

TEST(CompiledFilter, DropsWhatMovesAlsoOnceItWasMoved) {
  FrameFilter<> made(camera());
  made.keep_floor.options.fewest_features = 10;
  FrameFilter<> filter = std::move(made);
  const FrameResult& result = run(filter);
  const Scene last(kFrames - 1);
  EXPECT_EQ(result.status(), Status::ok);
  EXPECT_LT(last.kept_on_square(result), 16u);  // of 64
  EXPECT_GT(result.kept_count(), 439u);         // on the wall, beyond the square's surroundings

  ImageBuffer mask;
  filter.predicted_keep_mask(last.time_s + 1 / 30.0, 8, mask);
  const ImageView view = mask.view();
  ASSERT_EQ(view.width, 320);
  EXPECT_EQ(view.row<std::uint8_t>(last.square.y + 40)[last.square.x + 46], 0);
  EXPECT_EQ(view.row<std::uint8_t>(230)[10], 255);
}

TEST(CompiledFilter, TakesEveryTypeOfKeypoint) {
  FrameFilter<> filter(camera());
  const Scene scene(0);
  const std::vector<cv::Point2f> points = {{20, 20}, {40, 40}};
  const std::vector<Vector2f> pixels = {{20, 20}};
  EXPECT_EQ(filter.filter_frame(scene.frame(), points).size(), 2u);
  EXPECT_EQ(filter.filter_frame(Scene(1).frame(), pixels).size(), 1u);
}

TEST(CompiledFilter, StagesAreThoseOfTheLibrary) {
  FrameFilter<> filter(camera());
  filter.gate.options.false_positive_rate = 5;
  EXPECT_NE(filter.options_error().find("gate.false_positive_rate is 5"), std::string::npos);
  const Scene scene(0);
  EXPECT_EQ(filter.filter_frame(scene.frame(), scene.keypoints).status(), Status::invalid_options);
  filter.gate.options.false_positive_rate = 0.01;
  EXPECT_EQ(filter.options_error(), "");
}

TEST(CompiledFilter, OptionsAreThoseOfDefaultPolicies) {
  FrameFilter<> filter(camera());
  FrameFilter<DefaultPolicies> of_headers(camera());
  EXPECT_EQ(options_as_yaml(filter), options_as_yaml(of_headers));
  EXPECT_NE(options_as_yaml(filter).find("mask_prediction:"), std::string::npos);  // the last stage
}

TEST(CompiledFilter, HasMoversWhereTheyAreAskedFor) {
  FrameFilter<> without(camera());
  FrameFilter<WithMovers<>> made(camera());
  FrameFilter<WithMovers<>> with = std::move(made);
  with.movers.options.least_path_m = 0.01;
  const FrameResult &verdicts = run(without), &result = run(with);
  EXPECT_TRUE(verdicts.movers().empty());
  ASSERT_EQ(result.movers().size(), 1u);
  EXPECT_GT(result.movers()[0].velocity.x(), 0.5);  // 6 pixels a frame at 1.5 m: 1.35 m/s to the right
  EXPECT_EQ(options_as_yaml(without).find("movers:"), std::string::npos);
  EXPECT_NE(options_as_yaml(with).find("movers:\n  fewest_features: 8\n  least_path_m: 0.01"), std::string::npos);
  for (std::size_t i = 0; i < result.size(); ++i) EXPECT_EQ(result.keep()[i], verdicts.keep()[i]);

  with.movers.is_enabled = false;
  const Scene next(kFrames);
  EXPECT_TRUE(with.filter_frame(next.frame(), next.keypoints).movers().empty());
}

TEST(CompiledFilter, ResetBeginsAnew) {
  FrameFilter<> filter(camera());
  EXPECT_EQ(run(filter).status(), Status::ok);
  filter.reset();
  const Scene next(kFrames);
  const Status first = FrameFilter<>(camera()).filter_frame(next.frame(), next.keypoints).status();
  EXPECT_EQ(filter.filter_frame(next.frame(), next.keypoints).status(), first);
}

}  // namespace stillpoint::compiled_filter_test
