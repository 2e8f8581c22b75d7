// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// 04_movers: which objects move, where, and how fast? Two rendered people cross; a perfect detector names them.

#include <cstdio>
#include <opencv2/features2d.hpp>
#include <stillpoint/policies/with_movers.hpp>
#include <stillpoint/prior/propagated_prior.hpp>
#include <stillpoint/stillpoint.hpp>
#include <stillpoint/synthetic/renderer.hpp>
#include <stillpoint/synthetic/scenes.hpp>
#include <vector>

int main() {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::crossing_people());
  stillpoint::SyntheticFrame frame;
  const auto orb = cv::ORB::create(1000);
  stillpoint::FrameFilter<stillpoint::WithMovers<>> filter(sequence.camera());
  for (int i = 0; i < 60; ++i) {
    sequence.render(i, frame);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(stillpoint::as_mat(frame.gray.view()), keypoints);
    for (const auto& box : frame.boxes) {
      stillpoint::Detection person;
      person.box = {float(box.x), float(box.y), float(box.width), float(box.height)};
      person.mobility = stillpoint::Mobility::dynamic;
      person.class_index = 0;
      filter.prior.detections.push_back(person);
    }
    const stillpoint::FrameResult& result = filter.filter_frame(frame.view(), keypoints);
    for (const stillpoint::Mover& mover : result.movers())
      std::printf("frame %d: %s %u: %.1f m ahead, %.1f m/s to the %s (%s)\n", i,
                  mover.class_index == 0 ? "person" : "object", mover.id, mover.centroid.z(), mover.velocity.norm(),
                  mover.velocity.x() < 0 ? "left" : "right", to_string(mover.state));
    if (*result.hint() != '\0') std::printf("frame %d: %s\n", i, result.hint());
  }
}
