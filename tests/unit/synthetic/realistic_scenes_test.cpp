// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

#include "stillpoint/synthetic/realistic_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/truth.hpp"

namespace stillpoint::synthetic::realistic_scenes_test {
namespace {

constexpr std::uint64_t kSeeds[] = {1, 2, 3};

SceneOptions small(std::uint64_t seed, int frames = 150) {
  SceneOptions options;
  options.seed = seed;
  options.width = 320;
  options.height = 240;
  options.frames = frames;
  return options;
}

SceneOptions small_at_5_hz(std::uint64_t seed) {
  SceneOptions options = small(seed, 40);
  options.frame_rate_hz = 5.0;
  return options;
}

int id_at(const ImageBuffer& ids, int u, int v) { return ids.view().row<std::uint8_t>(v)[u]; }

/// Share of an image's pixels that have a value.
double share(const ImageBuffer& image, int value) {
  const ImageView view = image.view();
  int count = 0;
  for (int v = 0; v < view.height; ++v)
    count += static_cast<int>(std::count(view.row<std::uint8_t>(v), view.row<std::uint8_t>(v) + view.width,
                                         static_cast<std::uint8_t>(value)));
  return static_cast<double>(count) / (view.width * view.height);
}

double share_without_depth(const SyntheticFrame& frame) {
  const ImageView depth = frame.depth.view();
  int count = 0;
  for (int v = 0; v < depth.height; ++v)
    count += static_cast<int>(
        std::count(depth.row<std::uint16_t>(v), depth.row<std::uint16_t>(v) + depth.width, std::uint16_t{0}));
  return static_cast<double>(count) / (depth.width * depth.height);
}

TEST(LabelsOf, AreTheLabelsOfNamedFurnitureAlone) {
  Scene scene;
  scene.furniture.resize(2);
  scene.furniture[1].name = "book";
  SyntheticFrame frame;
  for (ImageBuffer* image : {&frame.labels, &frame.furniture_ids}) image->resize(4, 1, PixelFormat::gray8);
  const std::uint8_t labels[] = {kStatic, kStatic, kIgnored, kMoving}, ids[] = {1, 2, 2, 0};
  std::copy_n(labels, 4, frame.labels.row<std::uint8_t>(0));
  std::copy_n(ids, 4, frame.furniture_ids.row<std::uint8_t>(0));
  ImageBuffer found;
  labels_of(scene, "book", frame, found);
  const std::uint8_t expected[] = {kIgnored, kStatic, kIgnored, kIgnored};
  EXPECT_TRUE(std::equal(expected, expected + 4, found.row<std::uint8_t>(0)));
}

TEST(FirstMovingFrame, FollowsTheRule) {
  Scene scene;
  scene.frame_count = 100;
  Mover mover;
  mover.parts.push_back({});
  scene.movers = {mover, mover, mover};
  // 30 Hz. 0.3 m/s from 1 s on: 10 mm a frame, from frame 31 on.
  scene.movers[0].path = Path({{1.0, {0, 0, 0}}, {2.0, {0.3, 0, 0}}}, Blend::linear);
  // 0.08 m/s: 2.7 mm a frame is not enough; more than 10 mm in the window of 5 frames are 4 frames: 34.
  scene.movers[1].path = Path({{1.0, {0, 0, 0}}, {2.0, {0.08, 0, 0}}}, Blend::linear);
  EXPECT_EQ(first_moving_frame(scene, 0), 31);
  EXPECT_EQ(first_moving_frame(scene, 1), 34);
  EXPECT_EQ(first_moving_frame(scene, 2), std::nullopt);
}

TEST(FivePeople, CrossTheViewOfAStationaryCameraAtFiveHertz) {
  const Scene by_default = five_people();
  EXPECT_EQ(by_default.frame_rate_hz, 5.0);
  EXPECT_EQ(by_default.frame_count, 40);
  for (const std::uint64_t seed : kSeeds) {
    const Scene scene = five_people(small_at_5_hz(seed));
    ASSERT_EQ(scene.movers.size(), 5u);
    const Pose camera_from_world = scene.camera_path.world_from_camera(0).inverse();
    EXPECT_EQ(camera_from_world.matrix(), scene.camera_path.world_from_camera(7.3).inverse().matrix());
    for (const Mover& person : scene.movers) {
      EXPECT_EQ(person.class_name, "person");
      double leftmost = 1e9, rightmost = -1e9, fastest = 0;
      for (int i = 0; i < 40; ++i) {
        const Vector3d there = camera_from_world * person.world_from_object(0.2 * i).translation();
        const double u = scene.camera.fx() * there.x() / there.z() + scene.camera.cx();
        leftmost = std::min(leftmost, u);
        rightmost = std::max(rightmost, u);
        fastest = std::max(fastest, (person.world_from_object(0.2 * i + 0.2).translation() -
                                     person.world_from_object(0.2 * i).translation())
                                        .norm());
      }
      EXPECT_LT(leftmost, 20);  // px of 320: from side to side
      EXPECT_GT(rightmost, 300);
      EXPECT_GT(fastest, 0.74 * 0.2);
      EXPECT_LT(fastest, 0.96 * 0.2);
    }
  }
}

TEST(FivePeople, AreLabelledMovingWhileTheyWalk) {
  for (const std::uint64_t seed : kSeeds) {
    const Scene scene = five_people(small_at_5_hz(seed));
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    std::set<int> seen;
    double moving = 0;
    for (int i = 0; i < 40; i += 3) {
      sequence.render(i, frame);
      std::vector<bool> walks = {false};
      for (const Mover& person : scene.movers)
        walks.push_back(i > 0 && (person.world_from_object(0.2 * i).translation() -
                                  person.world_from_object(0.2 * (i - 1)).translation())
                                         .norm() > 0.011);
      for (int v = 0; v < 240; ++v)
        for (int u = 0; u < 320; ++u) {
          const int label = id_at(frame.labels, u, v), id = id_at(frame.mover_ids, u, v);
          if (label == kIgnored) continue;
          ASSERT_EQ(label == kStatic, id == 0);
          if (id == 0) continue;
          if (walks[static_cast<std::size_t>(id)]) {
            ASSERT_EQ(label, kMoving) << "frame " << i << " mover " << id;
          }
          if (i == 0) {
            ASSERT_EQ(label, kAtRest);
          }
          seen.insert(id);
        }
      moving += share(frame.labels, kMoving) / 14;
      EXPECT_LT(share(frame.labels, kMoving), 0.6);
      // Shadows, hair, shoes and the screen.
      EXPECT_GT(share_without_depth(frame), 0.015);
      EXPECT_LT(share_without_depth(frame), 0.15);
    }
    EXPECT_EQ(seen.size(), 5u);
    EXPECT_GT(moving, 0.08);
  }
}

/// Half of the edges of the box around a cuboid that may be turned, along the world's axes.
Vector3d half_of_bounds(const Solid& solid) { return solid.object_from_solid.linear().cwiseAbs() * solid.half_extents; }

// The gap between box and book along the axis that separates them most; negative would be an overlap.
double gap_m(const Mover& box, double time_s, const Solid& book) {
  const Solid& solid = box.parts[0].solid;
  const Vector3d centre = box.world_from_part(box.parts[0], time_s).translation();
  const Vector3d between = (centre - book.object_from_solid.translation()).cwiseAbs();
  return (between - solid.half_extents - half_of_bounds(book)).maxCoeff();
}

TEST(BoxAmongBooks, TouchesNoBookAndLeavesThreeMillimetresToMany) {
  for (const std::uint64_t seed : kSeeds) {
    const Scene scene = box_among_books(small(seed));
    ASSERT_EQ(scene.movers.size(), 1u);
    EXPECT_EQ(scene.movers[0].class_name, kUnknownClass);
    int books = 0, near = 0;
    for (const Solid& book : scene.furniture) {
      if (book.name != kBook) continue;
      ++books;
      double least_m = 1e9;
      for (double time_s = 0; time_s < 5; time_s += 0.05)
        least_m = std::min(least_m, gap_m(scene.movers[0], time_s, book));
      EXPECT_GT(least_m, 0.002) << books;
      near += least_m < 0.014;
    }
    EXPECT_GE(books, 18);
    EXPECT_GE(near, 15);  // both stacks, the row, the magazine
  }
}

TEST(BoxAmongBooks, BooksAreVisibleStaticAndWhereTheySay) {
  for (const std::uint64_t seed : kSeeds) {
    const Scene scene = box_among_books(small(seed));
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    ImageBuffer labels;
    for (const int i : {0, 40, 80, 120}) {
      sequence.render(i, frame);
      labels_of(scene, kBook, frame, labels);
      EXPECT_GT(share(labels, kStatic), 0.08) << i;
      EXPECT_EQ(share(labels, kAtRest) + share(labels, kMoving), 0.0);
      std::set<int> visible;
      for (int v = 0; v < 240; ++v)
        for (int u = 0; u < 320; ++u) {
          const int id = id_at(frame.furniture_ids, u, v);
          ASSERT_EQ(id == 0, id_at(frame.mover_ids, u, v) != 0);
          if (id == 0 || scene.furniture[static_cast<std::size_t>(id - 1)].name != kBook) continue;
          visible.insert(id);
          // What is seen there lies on that book's surface, in every frame.
          const Solid& book = scene.furniture[static_cast<std::size_t>(id - 1)];
          const double depth_m = static_cast<double>(frame.exact_depth.row<float>(v)[u]);
          const Vector3d p_world = frame.world_from_camera * scene.camera.back_project(Vector2d(u, v), depth_m);
          const Vector3d p_book = book.object_from_solid.inverse() * p_world;
          ASSERT_NEAR((p_book.cwiseAbs() - book.half_extents).maxCoeff(), 0.0, 1e-4) << u << ' ' << v;
        }
      EXPECT_GE(visible.size(), 15u) << i;
    }
  }
}

TEST(BoxAmongBooks, BoxIsPushedToAndFroWithAPause) {
  // 0.4 s at rest, 0.5 m at 0.25 m/s: 2 s, to frame 72; 0.5 s at rest, to frame 87; 1.28 s back, to 125.4.
  SyntheticSequence sequence(box_among_books(small(1)));
  SyntheticFrame frame;
  for (const auto& [index, label] :
       {std::pair(10, kAtRest), {40, kMoving}, {60, kMoving}, {82, kAtRest}, {105, kMoving}, {135, kAtRest}}) {
    sequence.render(index, frame);
    EXPECT_GT(share(frame.labels, label), 0.04) << index;
    EXPECT_EQ(share(frame.labels, label == kMoving ? kAtRest : kMoving), 0.0) << index;
  }
}

// The person starts at 1 s. At 30 Hz frame 30 is the last that stands; 0.1 m/s are 3.3 mm a frame, more than the rule's
// 3 mm: frame 31 is the first.
TEST(SlowWalker, TruthKnowsTheFrameOfTheFirstStep) {
  for (const std::uint64_t seed : kSeeds) {
    const Scene scene = slow_walker(small(seed, 60));
    EXPECT_EQ(first_moving_frame(scene, 0), 31);
    SyntheticSequence sequence(scene);
    SyntheticFrame frame;
    for (const int i : {5, 29, 30}) {
      sequence.render(i, frame);
      EXPECT_EQ(share(frame.labels, kMoving), 0.0) << i;
      EXPECT_GT(share(frame.labels, kAtRest), 0.04) << i;
    }
    sequence.render(31, frame);
    EXPECT_GT(share(frame.labels, kMoving), 0.01);
    sequence.render(36, frame);  // the origin has moved by more than 10 mm: all of the person counts
    EXPECT_GT(share(frame.labels, kMoving), 0.04);
    EXPECT_EQ(share(frame.labels, kAtRest), 0.0);
  }
  SceneOptions slower = small(1, 60);
  slower.frame_rate_hz = 10;
  EXPECT_EQ(first_moving_frame(slow_walker(slower), 0), 11);
}

TEST(SlowWalker, GoesATenthOfAMetrePerSecondTwoMetresAway) {
  const Scene scene = slow_walker(small(1, 90));
  const auto place = [&](double t) { return Vector3d(scene.movers[0].world_from_object(t).translation()); };
  EXPECT_EQ(place(0.0), place(1.0));
  for (double t = 1.0; t < 2.9; t += 0.2) EXPECT_NEAR((place(t + 0.1) - place(t)).norm(), 0.01, 1e-9);
  for (double t = 0.0; t < 3.0; t += 0.2) {
    const Vector3d from_camera = scene.camera_path.world_from_camera(t).inverse() * (place(t) - Vector3d(0, 1.2, 0));
    EXPECT_NEAR(from_camera.z(), 2.0, 0.25) << t;
  }
}

}  // namespace
}  // namespace stillpoint::synthetic::realistic_scenes_test
