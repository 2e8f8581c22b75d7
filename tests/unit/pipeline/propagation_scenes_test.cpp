// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The prior of DefaultPolicies in the whole pipeline, on a synthetic scene: are carried boxes where the people are?

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stillpoint/core/random.hpp"
#include "stillpoint/core/statistics.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/policies.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint {
namespace {

std::vector<Detection> true_boxes(const SyntheticFrame& frame) {
  std::vector<Detection> boxes;
  for (const synthetic::TruthBox& box : frame.boxes)
    boxes.push_back({{static_cast<float>(box.x), static_cast<float>(box.y), static_cast<float>(box.width),
                      static_cast<float>(box.height)},
                     Mobility::dynamic,
                     1.0f});
  return boxes;
}

/// How well the best of some boxes covers each true one: median intersection over union, and the share that none
/// covers.
struct Coverage {
  std::vector<float> overlaps;

  template <class Boxes, class GetBox>
  void add(const std::vector<Detection>& truth, const Boxes& boxes, GetBox&& get_box) {
    for (const Detection& there : truth) {
      float best = 0;
      for (const auto& box : boxes) best = std::max(best, intersection_over_union(there.box, get_box(box)));
      overlaps.push_back(best);
    }
  }
  float median() { return median_in_place(span<float>(overlaps)); }
  double uncovered() const {
    const auto none = [](float overlap) { return overlap < 0.2f; };
    return static_cast<double>(std::count_if(overlaps.begin(), overlaps.end(), none)) /
           static_cast<double>(overlaps.size());
  }
};

/// A camera in the hand walks past two people; every frame `answer(frame index, true boxes, filter)` may tell the
/// prior.
template <class Answer>
void run(int first_counted, Coverage& carried, Answer&& answer) {
  synthetic::SceneOptions options;
  options.width = 320;
  options.height = 240;
  options.frames = 60;
  const synthetic::Scene scene = synthetic::walking_people(options);
  std::vector<Vector2f> pixels;
  for (float v = 10; v < 240; v += 20)
    for (float u = 10; u < 320; u += 20) pixels.emplace_back(u, v);
  FrameFilter<> filter(scene.camera);
  SyntheticSequence sequence(scene);
  SyntheticFrame frame;
  for (int f = 0; f < sequence.size(); ++f) {
    sequence.render(f, frame);
    const std::vector<Detection> truth = true_boxes(frame);
    answer(f, frame.timestamp_s, truth, filter.prior);
    filter.filter_frame(frame.view(), pixels);
    if (f >= first_counted)
      carried.add(truth, filter.prior.objects(), [](const CarriedDetection& thing) { return thing.detection.box; });
  }
  ASSERT_GE(carried.overlaps.size(), 30u);
}

TEST(PropagationScenes, HalfOfTheBoxesAreMissed) {
  Random random(1);
  Coverage carried, seen_alone;
  run(5, carried, [&](int f, double time_s, const std::vector<Detection>& truth, PropagatedPrior& prior) {
    std::vector<Detection> seen;
    for (const Detection& there : truth)
      if (random.uniform() < 0.5) seen.push_back(there);
    prior.detected(time_s, seen);
    if (f >= 5) seen_alone.add(truth, seen, [](const Detection& box) { return box.box; });
  });
  EXPECT_GE(seen_alone.uncovered(), 0.3) << "many are missed";
  EXPECT_LE(carried.uncovered(), 0.08);
  EXPECT_GE(carried.median(), 0.9f);
}

// Every tenth frame is looked at, which takes nine frames: what is known is 9 to 18 frames old.
TEST(PropagationScenes, AnswersAreSlowAndLate) {
  std::vector<Detection> found, last;
  double found_s = 0;
  Coverage carried, stale;
  run(10, carried, [&](int f, double time_s, const std::vector<Detection>& truth, PropagatedPrior& prior) {
    if (f % 10 == 0) {
      found = truth;
      found_s = time_s;
    }
    if (f % 10 == 9) {
      prior.detected(found_s, found);
      last = found;
    }
    if (f >= 10) stale.add(truth, last, [](const Detection& box) { return box.box; });
  });
  EXPECT_LE(carried.uncovered(), 0.05);
  EXPECT_GE(carried.median(), 0.6f) << "arms that swing make the true boxes wider and narrower by a half";
  EXPECT_GE(carried.median(), stale.median() + 0.1f);
}

}  // namespace
}  // namespace stillpoint
