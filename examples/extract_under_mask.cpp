// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// extract_under_mask FOLDER...: what a feature budget buys when it is spent under the mask of the coming frame. Each
// folder is a sequence in the layout of the TUM benchmark with labels. ORB takes 1000 features per frame, once anywhere
// and once where `predicted_keep_mask` keeps; both times the filter then judges what was found.

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <vector>

#include "stillpoint/core/error.hpp"
#include "stillpoint/evaluation/feature_score.hpp"
#include "stillpoint/io/tum_sequence.hpp"
#include "stillpoint/stillpoint.hpp"

namespace {

void run(const stillpoint::TumSequence& sequence, bool is_under_mask) {
  constexpr int kFeatures = 1000, kMargin_px = 8;
  const auto orb = cv::ORB::create(kFeatures);
  stillpoint::FrameFilter<> filter(sequence.camera());
  stillpoint::ImageBuffer mask;
  stillpoint::FilterScore score;
  const char* hint = "";
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const stillpoint::RgbdImages images = sequence.load(i);
    const double timestamp_s = sequence.frames()[i].timestamp_s;
    cv::Mat gray;
    cv::cvtColor(images.colour, gray, cv::COLOR_BGR2GRAY);
    std::vector<cv::KeyPoint> keypoints;
    filter.predicted_keep_mask(timestamp_s, kMargin_px, mask);
    orb->detect(gray, keypoints, is_under_mask ? stillpoint::as_mat(mask.view()) : cv::Mat());
    const stillpoint::DepthView depth(images.depth, sequence.depth_factor());
    const stillpoint::FrameResult& result = filter.filter_frame({gray, depth, timestamp_s}, keypoints);
    hint = result.hint();
    std::vector<stillpoint::Vector2f> pixels;
    for (const cv::KeyPoint& keypoint : keypoints) pixels.emplace_back(keypoint.pt.x, keypoint.pt.y);
    score.add_frame(sequence.load_labels(i), pixels, result.keep());
  }
  if (score.frames() < 2)
    throw stillpoint::Error(sequence.folder().string() + ": found one frame, expected more: the first is not counted");
  const auto a_frame = [&score](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(score.frames() - 1);
  };
  const stillpoint::DropCount moving = score.moving(), background = score.background();
  std::printf("  %-11s  static: %5.1f found, %5.1f kept   moving: %5.1f found, %5.1f kept %s\n",
              is_under_mask ? "under mask" : "anywhere", a_frame(background.features),
              a_frame(background.features - background.dropped), a_frame(moving.features),
              a_frame(moving.features - moving.dropped), hint);
}

}  // namespace

int main(int argument_count, char** arguments) {
  constexpr int kFailed = 2;
  if (argument_count < 2) {
    std::fprintf(stderr, "extract_under_mask: found no folder, expected one or more of the TUM layout with labels/\n");
    return kFailed;
  }
  try {
    for (int i = 1; i < argument_count; ++i) {
      const stillpoint::TumSequence sequence(arguments[i]);
      std::printf("%s, features per frame\n", arguments[i]);
      for (const bool is_under_mask : {false, true}) run(sequence, is_under_mask);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "extract_under_mask: %s\n", error.what());
    return kFailed;
  }
}
