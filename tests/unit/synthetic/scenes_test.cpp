// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/scenes.hpp"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>

#include <cmath>
#include <vector>

#include "stillpoint/synthetic/renderer.hpp"

namespace stillpoint::synthetic::scenes_test {
namespace {

SceneOptions small() {
  SceneOptions options;
  options.seed = 3;
  options.width = 320;
  options.height = 240;
  return options;
}

/// Shares of the picture, 0 to 1.
struct Shares {
  double movers = 0, moving = 0, at_rest = 0;
};

Shares shares(SyntheticSequence& sequence, int index) {
  SyntheticFrame frame;
  sequence.render(index, frame);
  Shares result;
  const double pixel = 1.0 / (frame.labels.view().width * frame.labels.view().height);
  for (int v = 0; v < frame.labels.view().height; ++v)
    for (int u = 0; u < frame.labels.view().width; ++u) {
      const int label = frame.labels.view().row<std::uint8_t>(v)[u];
      result.movers += frame.mover_ids.view().row<std::uint8_t>(v)[u] != 0 ? pixel : 0;
      result.moving += label == kMoving ? pixel : 0;
      result.at_rest += label == kAtRest ? pixel : 0;
    }
  return result;
}

TEST(Scenes, StaticRoomHasNoMover) {
  SyntheticSequence sequence(static_room(small()));
  for (const int index : {0, 70, 140}) EXPECT_EQ(shares(sequence, index).movers, 0.0);
}

TEST(Scenes, WalkingPeopleCoverMuchOfTheViewAndPause) {
  SyntheticSequence sequence(walking_people(small()));
  double covered = 0;
  int with_rest = 0, with_motion = 0;
  for (int index = 0; index < 150; index += 10) {
    const Shares now = shares(sequence, index);
    covered += now.movers / 15;
    with_rest += now.at_rest > 0.02;
    with_motion += now.moving > 0.02;
  }
  EXPECT_GT(covered, 0.14);
  EXPECT_LT(covered, 0.35);
  EXPECT_GE(with_rest, 3);
  EXPECT_GE(with_motion, 8);
}

TEST(Scenes, PushedBoxMovesAndPausesUnderANameNoDetectorKnows) {
  SyntheticSequence sequence(pushed_box(small()));
  EXPECT_GT(shares(sequence, 48).moving, 0.06);
  EXPECT_EQ(shares(sequence, 72).moving, 0.0);
  EXPECT_GT(shares(sequence, 72).at_rest, 0.06);
  EXPECT_EQ(sequence.scene().movers[0].class_name, kUnknownClass);
}

TEST(Scenes, SlowMoverMovesTwoCentimetresPerSecond) {
  Scene scene = slow_mover(small());
  for (double t = 0; t < 4; t += 0.5) {
    const Vector3d step =
        scene.movers[0].world_from_object(t + 1).translation() - scene.movers[0].world_from_object(t).translation();
    EXPECT_NEAR(step.norm(), 0.02, 1e-9);
  }
  SyntheticSequence by_default(scene);
  EXPECT_EQ(shares(by_default, 100).moving, 0.0);  // 3.3 mm in 5 frames
  scene.motion_rule.window_frames = 30;            // 20 mm
  SyntheticSequence patient(scene);
  EXPECT_GT(shares(patient, 100).moving, 0.07);
}

TEST(Scenes, WavingHandMovesALittlePartOfAPersonAtRest) {
  SyntheticSequence sequence(waving_hand(small()));
  EXPECT_EQ(shares(sequence, 20).moving, 0.0);
  const Shares waving = shares(sequence, 62);
  EXPECT_GT(waving.moving, 0.003);
  EXPECT_LT(waving.moving, 0.03);
  EXPECT_GT(waving.at_rest, 8 * waving.moving);
}

TEST(Scenes, AlongTheRayKeepsItsPixelAndChangesItsDepth) {
  const Scene scene = along_the_ray(small());
  const auto centre = [&](double t) {
    const Pose camera_from_mover =
        scene.camera_path.world_from_camera(t).inverse() * scene.movers[0].world_from_object(t);
    return Vector3d(camera_from_mover * Vector3d(0, -0.25, 0));
  };
  for (double t = 0; t < 5; t += 0.2) {
    const Vector2d pixel = scene.camera.project(centre(t));
    EXPECT_LT((pixel - Vector2d(scene.camera.cx(), scene.camera.cy())).norm(), 1e-6);
  }
  EXPECT_NEAR(centre(0.0).z(), 2.6, 1e-9);
  EXPECT_NEAR(centre(2.6).z(), 1.3, 1e-9);  // 0.3 s, then 1.3 m at 0.6 m/s
}

TEST(Scenes, CrowdedViewIsCoveredByThreeQuartersAtLeast) {
  SyntheticSequence sequence(crowded_view(small()));
  for (int index = 0; index < 150; index += 15) {
    EXPECT_GE(shares(sequence, index).movers, 0.75) << index;
    EXPECT_LE(shares(sequence, index).movers, 0.92) << index;
  }
  EXPECT_GT(shares(sequence, 10).moving, 0.7);
}

TEST(Scenes, PureRotationTurnsWithoutMoving) {
  const Scene scene = pure_rotation(small());
  const Pose start = scene.camera_path.world_from_camera(0);
  double largest = 0;
  for (double t = 0; t < 5; t += 0.1) {
    const Pose now = scene.camera_path.world_from_camera(t);
    EXPECT_LT((now.translation() - start.translation()).norm(), 1e-12);
    largest = std::max(largest, rotation_angle(start.linear().transpose() * now.linear()));
  }
  EXPECT_GT(largest, 0.3);
  EXPECT_EQ(pure_rotation(small(), true).movers.size(), 2u);
}

TEST(Scenes, StationaryCameraStands) {
  const Scene scene = stationary_camera(small());
  EXPECT_EQ(scene.camera_path.world_from_camera(0).matrix(), scene.camera_path.world_from_camera(3.3).matrix());
  EXPECT_EQ(scene.movers.size(), 2u);
}

TEST(Scenes, BoxesEncloseAllOfTheirMover) {
  for (const Scene& scene : {walking_people(small()), demo(small()), waving_hand(small())}) {
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    sequence.render(40, frame);
    ASSERT_FALSE(frame.boxes.empty());
    const ImageView ids = frame.mover_ids.view();
    for (int v = 0; v < ids.height; ++v)
      for (int u = 0; u < ids.width; ++u)
        for (const TruthBox& box : frame.boxes)
          if (ids.row<std::uint8_t>(v)[u] == box.mover + 1) {
            ASSERT_TRUE(u >= box.x && v >= box.y && u < box.x + box.width && v < box.y + box.height);
          }
  }
}

TEST(Scenes, CamerasMoveAtTheSpeedOfAHand) {
  for (const Scene& scene : {static_room(small()), demo(small())})
    for (double t = 0; t < 7; t += 1 / 30.0) {
      const Pose step =
          scene.camera_path.world_from_camera(t).inverse() * scene.camera_path.world_from_camera(t + 1 / 30.0);
      EXPECT_LT(step.translation().norm() * 30, 0.8);      // m/s
      EXPECT_LT(rotation_angle(step.linear()) * 30, 0.7);  // rad/s
    }
}

TEST(Scenes, DemoGivesOrbAThousandFeaturesAllOverTheView) {
  SyntheticSequence sequence(demo());
  EXPECT_EQ(sequence.size(), 60);
  SyntheticFrame frame;
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000);
  for (const int index : {0, 30, 59}) {
    sequence.render(index, frame);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(cv::Mat(480, 640, CV_8UC1, frame.gray.row<std::uint8_t>(0)), keypoints);
    EXPECT_GE(keypoints.size(), 990u);
    std::vector<int> counts(4 * 3);  // cells of 160 px
    int on_movers = 0;
    for (const cv::KeyPoint& keypoint : keypoints) {
      const int u = static_cast<int>(std::lround(keypoint.pt.x)), v = static_cast<int>(std::lround(keypoint.pt.y));
      ++counts[static_cast<std::size_t>(v / 160 * 4 + u / 160)];
      on_movers += frame.mover_ids.view().row<std::uint8_t>(v)[u] != 0;
    }
    EXPECT_GT(on_movers, 100);
    EXPECT_LT(on_movers, 600);
    for (const int count : counts) EXPECT_GT(count, 10) << index;
  }
}

TEST(Scenes, RefuseTinyPictures) {
  SceneOptions options;
  options.width = 8;
  EXPECT_THROW(static_room(options), Error);
}

}  // namespace
}  // namespace stillpoint::synthetic::scenes_test
