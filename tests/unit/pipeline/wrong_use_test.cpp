// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// What a host may get wrong, on a synthetic room: each must be said. The table is docs/statuses.md's.

#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"
#include "unit/pipeline/scene_run.hpp"

namespace stillpoint::wrong_use_test {
namespace {

/// What the host hands over; rendered depth is 16 bit in TUM's unit.
struct Handed {
  cv::Mat gray, depth;  ///< depth in millimetres, 16 bit
  double time_s = 0;
  std::vector<Vector2f> keypoints;
  DepthView view() const { return DepthView::millimetres(depth); }
};

struct Said {
  Status status = Status::ok;
  Warnings warnings;
  std::string hint;
};

std::vector<Vector2f> keypoints_of(const cv::Mat& gray) {
  std::vector<cv::KeyPoint> found;
  cv::ORB::create(300)->detect(gray, found);
  std::vector<Vector2f> keypoints;
  for (const cv::KeyPoint& keypoint : found) keypoints.emplace_back(keypoint.pt.x, keypoint.pt.y);
  return keypoints;
}

/// @param hand  hands over what it likes of a correct frame, and says what the filter answered
/// @return      after the last frame
Said after(const synthetic::Scene& scene, const std::function<const FrameResult&(FrameFilter<>&, Handed)>& hand) {
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  FrameFilter<> filter(scene.camera);
  Said said;
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    Handed handed;
    handed.gray = as_mat(frame.gray.view()).clone();
    as_mat(frame.depth.view()).convertTo(handed.depth, CV_16U, 1000.0 / frame.depth_factor);
    handed.time_s = frame.timestamp_s;
    handed.keypoints = keypoints_of(handed.gray);
    const FrameResult& result = hand(filter, handed);
    said = {result.status(), result.warnings(), result.hint()};
  }
  return said;
}

Said after_a_second(const std::function<const FrameResult&(FrameFilter<>&, Handed)>& hand) {
  return after(synthetic::static_room(scene_run::small(26)), hand);
}

void expect_hint(const Said& said, const char* word) {
  EXPECT_NE(said.hint.find(word), std::string::npos) << "hint: " << said.hint;
}

TEST(WrongUse, RightUseHasNoHint) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::ok);
  EXPECT_TRUE(said.warnings.empty());
  EXPECT_EQ(said.hint, "");
}

// The camera turns fast enough for it to be seen: by some four pixels per frame.
TEST(WrongUse, DepthOfTheFrameBefore) {
  cv::Mat before;
  const Said said =
      after(synthetic::pure_rotation(scene_run::small(120), true),
            [&before](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
              const cv::Mat late = before.empty() ? frame.depth : before;
              before = frame.depth;
              return filter.filter_frame({frame.gray, DepthView::millimetres(late), frame.time_s}, frame.keypoints);
            });
  EXPECT_EQ(said.status, Status::ok);
  EXPECT_TRUE(said.warnings.has(Warning::depth_unsynchronised));
  expect_hint(said, "pair them by time");
}

TEST(WrongUse, DepthOfAWiderSensor) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    const cv::Mat wide = frame.depth.rowRange(frame.depth.rows / 8, frame.depth.rows * 7 / 8);
    return filter.filter_frame({frame.gray, DepthView::millimetres(wide), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::depth_shape_differs));
  expect_hint(said, "aligned");
}

// What a driver publishes of its full resolution, beside images of half of it.
TEST(WrongUse, IntrinsicsOfTwiceTheResolution) {
  bool is_given = false;
  const Said said = after_a_second([&is_given](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    const Camera& own = filter.camera;
    if (!is_given)
      filter.camera = Camera(2 * own.fx(), 2 * own.fy(), 2 * own.cx(), 2 * own.cy(), own.width(), own.height());
    is_given = true;
    return filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::principal_point_aside));
  expect_hint(said, "intrinsics");
}

TEST(WrongUse, SixteenBitDepthWithoutItsUnit) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, frame.depth, frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::depth_unit_missing);
  expect_hint(said, "DepthView::millimetres");
}

// What is 2.4 to 4.5 m away is said to be 0.5 to 0.9 m away.
TEST(WrongUse, MillimetresDeclaredAsTumsUnit) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, DepthView::tum(frame.depth), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::depth_too_near));
  expect_hint(said, "millimetres");
}

TEST(WrongUse, MirroredDepth) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    cv::Mat mirrored;
    cv::flip(frame.depth, mirrored, 1);
    return filter.filter_frame({frame.gray, DepthView::millimetres(mirrored), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::depth_turned_over));
  expect_hint(said, "mirrored");
}

TEST(WrongUse, FloatDepthInMillimetres) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    cv::Mat millimetres;
    frame.depth.convertTo(millimetres, CV_32F);
    return filter.filter_frame({frame.gray, millimetres, frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::implausible_depth);
  expect_hint(said, "millimetres");
}

// RealSense's depth scales, metres per unit, in place of units per metre; and a factor of 1.
TEST(WrongUse, MetresPerUnitInPlaceOfUnitsPerMetre) {
  for (const double factor : {0.00025, 0.001, 1.0}) {
    const Said said = after_a_second([factor](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
      return filter.filter_frame({frame.gray, DepthView(frame.depth, factor), frame.time_s}, frame.keypoints);
    });
    EXPECT_EQ(said.status, factor < 0.001 ? Status::depth_unit_missing : Status::implausible_depth) << factor;
    expect_hint(said, "units per metre");
  }
}

TEST(WrongUse, NoImage) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({cv::Mat(), frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::no_image);
  expect_hint(said, "empty");
}

TEST(WrongUse, ImageOfAnotherKind) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    cv::Mat real;
    frame.gray.convertTo(real, CV_32F, 1.0 / 255);
    return filter.filter_frame({real, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::unsupported_image);
  expect_hint(said, "8-bit");
}

TEST(WrongUse, AnOptionOutOfItsRange) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    filter.gate.options.false_positive_rate = 5;
    return filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::invalid_options);
  expect_hint(said, "options_error()");
}

TEST(WrongUse, FramesThatRunBackwards) {
  double time_s = 100;
  const Said said = after_a_second([&time_s](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, frame.view(), time_s -= 0.033}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::out_of_order);
  EXPECT_TRUE(said.warnings.has(Warning::times_far_apart));
  expect_hint(said, "does it grow");
}

TEST(WrongUse, TimeInNanoseconds) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, frame.view(), 1e9 * (1.7e9 + frame.time_s)}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::invalid_time);
  expect_hint(said, "seconds");
}

TEST(WrongUse, TimeInMicroseconds) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray, frame.view(), 1e6 * frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::time_gap);
  EXPECT_TRUE(said.warnings.has(Warning::times_far_apart));
  expect_hint(said, "seconds");
}

TEST(WrongUse, KeypointsOfAnImageOfHalfTheSize) {
  const Said said = after_a_second([](FrameFilter<>& filter, Handed frame) -> const FrameResult& {
    for (Vector2f& pixel : frame.keypoints) pixel *= 0.5f;
    return filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::keypoints_in_one_quarter));
  expect_hint(said, "quarter");
}

TEST(WrongUse, KeypointsOfAnImageOfTwiceTheSize) {
  const Said said = after_a_second([](FrameFilter<>& filter, Handed frame) -> const FrameResult& {
    for (Vector2f& pixel : frame.keypoints) pixel *= 2.0f;
    return filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_TRUE(said.warnings.has(Warning::keypoints_outside));
  expect_hint(said, "outside");
}

TEST(WrongUse, ImageOfAnotherSize) {
  const Said said = after_a_second([](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    return filter.filter_frame({frame.gray(cv::Rect(0, 0, 160, 120)), frame.view(), frame.time_s}, frame.keypoints);
  });
  EXPECT_EQ(said.status, Status::size_changed);
  expect_hint(said, "size");
}

// The host's poses are in metres; its depths were five times too small.
TEST(WrongUse, AScaleThatIsNotTheHosts) {
  Pose world_from_camera = Pose::Identity();
  const Said said = after_a_second([&](FrameFilter<>& filter, const Handed& frame) -> const FrameResult& {
    const FrameResult& result = filter.filter_frame({frame.gray, frame.view(), frame.time_s}, frame.keypoints);
    Pose step = result.motion().current_from_reference.inverse();
    step.translation() *= 5.0;
    world_from_camera = world_from_camera * step;
    filter.feedback(world_from_camera);
    return result;
  });
  EXPECT_TRUE(said.warnings.has(Warning::scale_differs));
  expect_hint(said, "unit");
}

// Doubt outlives a reset: two filters see the same frames, and only one of them has a hint.
TEST(WrongUse, AHintChangesNoVerdict) {
  const synthetic::Scene scene = synthetic::walking_people(scene_run::small(36));
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  FrameFilter<> doubting(scene.camera), fresh(scene.camera);
  std::size_t hints = 0, dropped = 0;
  const auto render = [&](int f) {
    sequence.render(f, frame);
    return keypoints_of(as_mat(frame.gray.view()));
  };
  for (int f = 0; f < sequence.size(); ++f) {
    std::vector<Vector2f> in_one_quarter = render(f);
    for (Vector2f& keypoint : in_one_quarter) keypoint *= 0.49f;
    doubting.filter_frame(frame.view(), in_one_quarter);
  }
  doubting.reset();
  for (int f = 0; f < sequence.size(); ++f) {
    const std::vector<Vector2f> keypoints = render(f);
    const FrameResult& with_hint = doubting.filter_frame(frame.view(), keypoints);
    const FrameResult& without = fresh.filter_frame(frame.view(), keypoints);
    hints += *with_hint.hint() != '\0';
    EXPECT_STREQ(without.hint(), "");
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      ASSERT_EQ(with_hint.label(i).log_odds, without.label(i).log_odds) << "frame " << f << ", feature " << i;
      ASSERT_EQ(with_hint.keep()[i], without.keep()[i]);
      dropped += without.keep()[i] == 0;
    }
  }
  EXPECT_GE(hints, 5u);
  EXPECT_GE(dropped, 100u);
}

}  // namespace
}  // namespace stillpoint::wrong_use_test
