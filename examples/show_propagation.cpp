// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Draws docs/propagation.jpg: a detector answers once, and its boxes are carried from frame to frame.
//
//   show_propagation OUT.jpg

#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "run/detection_feed.hpp"
#include "run/filters.hpp"
#include "run/frame_source.hpp"
#include "run/image_offsets.hpp"
#include "run/overlay.hpp"
#include "run/write_down.hpp"
#include "stillpoint/core/compact.hpp"
#include "stillpoint/filter_frame.hpp"
#include "stillpoint/io/number_format.hpp"
#include "stillpoint/opencv.hpp"
#include "stillpoint/synthetic/renderer.hpp"
#include "stillpoint/synthetic/scenes.hpp"

namespace stillpoint_run {
namespace {

constexpr int kFirst = 24, kStep = 6, kPictures = 5;  // frames at 30 Hz; those before let the filter look back
constexpr int kFeatures = 500;                        // few enough to be told apart in the picture
constexpr int kWidth_px = 480, kHeight_px = 360;      // of each picture
constexpr int kGap_px = 6;

/// The sixth field: what the signs mean.
cv::Mat legend() {
  cv::Mat field(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar::all(70));
  int line = 0;
  const auto entry = [&](const std::string& text, auto&& draw) {
    const int y = 50 + 48 * line++;
    draw(stillpoint::Vector2f(50.0f, static_cast<float>(y)));
    detail::draw_text(field, text, {90, y + 5});
  };
  const auto box = [&field](bool is_carried) {
    return [&field, is_carried](const stillpoint::Vector2f& at) {
      detail::draw_box(field, cv::Rect2f(at.x() - 25, at.y() - 14, 50, 28), 2, is_carried);
    };
  };
  const auto feature = [&field](stillpoint::Verdict verdict, bool keep) {
    return [&field, verdict, keep](const stillpoint::Vector2f& at) {
      FeatureRow row{at, {}, "", 0.0f, 0.0, stillpoint::Mobility::unknown};
      row.label.verdict = verdict;
      row.label.keep = keep;
      detail::draw_feature(field, row, stillpoint::Vector2f::Zero());
    };
  };
  entry("box of the detector", box(false));
  entry("the same, carried by the filter", box(true));
  entry("static feature: kept", feature(stillpoint::Verdict::kept, true));
  entry("dynamic feature: dropped", feature(stillpoint::Verdict::dynamic, false));
  entry("unknown, kept", feature(stillpoint::Verdict::unknown, true));
  entry("unknown, dropped", feature(stillpoint::Verdict::unknown, false));
  return field;
}

cv::Mat draw() {
  stillpoint::SyntheticSequence sequence(stillpoint::synthetic::walking_people());
  stillpoint::FrameFilter<Watched<stillpoint::DefaultPolicies>> filter(sequence.camera());
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(kFeatures);
  Options options;
  options.prior = "boxes";
  BoxFeed detector(options);
  ImageOffsets offsets;
  stillpoint::SyntheticFrame rendered;
  FrameRecord record;
  cv::Mat mosaic(2 * kHeight_px + kGap_px, 3 * kWidth_px + 2 * kGap_px, CV_8UC3, cv::Scalar::all(255));
  const auto place = [&mosaic](int index, const cv::Mat& picture) {
    const cv::Rect field((index % 3) * (kWidth_px + kGap_px), (index / 3) * (kHeight_px + kGap_px), kWidth_px,
                         kHeight_px);
    cv::resize(picture, mosaic(field), field.size(), 0, 0, cv::INTER_AREA);
  };

  for (int i = 0; i <= kFirst + (kPictures - 1) * kStep; ++i) {
    sequence.render(i, rendered);
    const SourceFrame frame = source_frame(rendered, true);
    std::optional<stillpoint::DetectorAnswer> answer;
    if (i == kFirst) answer = detector.next(frame);
    prepare(filter, frame, answer);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(frame.gray, keypoints);
    const stillpoint::FrameResult& result = filter.filter_frame(frame.view(), keypoints);
    record.summary = FrameSummary{};
    record.summary.timestamp_s = frame.timestamp_s;
    record.summary.time_s = frame.timestamp_s - sequence.scene().start_s;
    write_down(
        frame.view(), filter, keypoints, result, [&detector](int index) { return detector.class_name(index); }, record);
    if (i >= kFirst && (i - kFirst) % kStep == 0)
      place((i - kFirst) / kStep, draw_overlay(frame, record, offsets.of(frame, record, sequence.camera())));
    offsets.remember(frame);
  }
  place(kPictures, legend());
  return mosaic;
}

}  // namespace
}  // namespace stillpoint_run

int main(int argument_count, char** arguments) {
  constexpr int kFailed = 2, kJpegQuality = 72;
  if (argument_count != 2) {
    std::fprintf(stderr, "show_propagation: expected one argument, OUT.jpg\n");
    return kFailed;
  }
  try {
    cv::setNumThreads(1);
    if (cv::imwrite(arguments[1], stillpoint_run::draw(), {cv::IMWRITE_JPEG_QUALITY, kJpegQuality})) return 0;
    std::fprintf(stderr, "show_propagation: %s cannot be written\n", arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "show_propagation: %s\n", error.what());
  }
  return kFailed;
}
