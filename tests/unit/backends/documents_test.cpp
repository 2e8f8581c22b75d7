// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The code of docs/trackers.md, line by line: tests/structure/documents.sh looks for each of its lines here.

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "backends/klt_odometry.hpp"
#include "stillpoint/filtered_tracker.hpp"
#include "stillpoint/stillpoint.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace {

TEST(Documents, TheLinesOfTrackersAreTheLoopOfFilteredTracker) {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::static_room());
  stillpoint::SyntheticFrame rendered;
  const stillpoint::Camera camera = sequence.camera();
  stillpoint::FrameFilter<> filter(camera);
  examples::KltOdometry odometry(camera);
  stillpoint::FilteredTracker tracker{stillpoint::FrameFilter<>(camera), examples::KltOdometry(camera)};
  tracker.tells_filter = false;
  std::vector<float> weights;
  for (int i = 0; i < 3; ++i) {
    sequence.render(i, rendered);
    const stillpoint::FrameView frame(rendered.gray.view(),
                                      stillpoint::DepthView(rendered.depth.view(), rendered.depth_factor),
                                      rendered.timestamp_s);
    // clang-format off
    auto features = odometry.extract(frame);
    const stillpoint::FrameResult& result = filter.filter_frame(frame, features.keypoints);
    stillpoint::weights(result, weights);
    features.weigh(weights);
    features.compact(result.keep());
    if (result.motion().usable()) odometry.expect_motion(result.motion().current_from_reference);
    const std::optional<stillpoint::Pose> world_from_camera = odometry.track(frame, features);
    // clang-format on
    const std::optional<stillpoint::Pose> same = tracker.track(frame);
    ASSERT_TRUE(world_from_camera && same);
    EXPECT_TRUE(world_from_camera->matrix() == same->matrix());
  }
}

}  // namespace
