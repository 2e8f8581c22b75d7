// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// A detector that fails while the run goes on, and how regions are drawn: what no file on disk brings about.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

#include "run/detection_feed.hpp"
#include "run/figures.hpp"
#include "run/overlay.hpp"
#include "run/report_json.hpp"
#include "run/words.hpp"

namespace stillpoint_run {
namespace {

/// Sees a person in every third picture it is given, and throws at the others.
class Moody : public Network {
 public:
  void detect(const stillpoint::ImageView&, std::vector<stillpoint::Detection>& detections) override {
    if (calls_++ % 3 != 0) throw stillpoint::Error("call " + std::to_string(calls_) + " is too much");
    stillpoint::Detection person{stillpoint::Box{1, 2, 3, 4}, stillpoint::Mobility::dynamic};
    person.class_index = 0;
    detections.push_back(person);
  }
  stillpoint::DetectorLayout layout() const override { return stillpoint::DetectorLayout::yolox; }
  const stillpoint::ClassList& classes() const override { return classes_; }
  stillpoint::InputSize input_size() const override { return {416, 416}; }

 private:
  int calls_ = 0;
  stillpoint::ClassList classes_ = stillpoint::ClassList::person();
};

SourceFrame frame_at(double timestamp_s) {
  SourceFrame frame;
  frame.timestamp_s = timestamp_s;
  frame.colour = cv::Mat(128, 64, CV_8UC3, cv::Scalar::all(100));
  return frame;
}

TEST(NetworkFeed, GoesOnWhereTheNetworkFails) {
  Options options;
  options.prior = "somewhere/moody.onnx";
  options.is_synchronous = true;
  NetworkFeed feed(options, std::make_unique<Moody>());
  std::vector<double> answered_s;
  for (int i = 0; i < 5; ++i)
    if (const auto answer = feed.next(frame_at(i))) answered_s.push_back(answer->timestamp_s);
  EXPECT_EQ(answered_s, (std::vector<double>{0, 3}));
  EXPECT_EQ(feed.class_name(0), "person");
  EXPECT_EQ(feed.class_name(7), "");
  EXPECT_EQ(feed.class_name(-1), "");

  RunRecord run;
  run.detector = feed.finish();
  const Figures figures = evaluate(run);
  const nlohmann::json report = nlohmann::json::parse(report_json(options, run, figures, nullptr));
  EXPECT_EQ(report["prior"], "moody.onnx");
  EXPECT_EQ(report["detector"]["frames"]["detected"], 2);
  EXPECT_EQ(report["detector"]["frames"]["failed"], 3);
  EXPECT_EQ(report["detector"]["last_error"], "call 5 is too much");
  const std::string words = detail::detector_words(options, *run.detector, figures);
  EXPECT_NE(words.find("answered on 2 of 5 frames"), std::string::npos) << words;
  EXPECT_NE(words.find("it failed on 3 frames, the last time with: call 5 is too much"), std::string::npos) << words;
}

TEST(NetworkFeed, InAThreadFailsNobodyElse) {
  Options options;
  NetworkFeed feed(options, std::make_unique<Moody>());
  for (int i = 0; i < 50; ++i) feed.next(frame_at(i));
  const auto record = feed.finish();
  const stillpoint::DetectorCounters& frames = record->counters;
  EXPECT_EQ(frames.offered, 50u);
  EXPECT_EQ(frames.replaced + frames.detected + frames.failed, 50u);
  EXPECT_EQ(record->times_ms.size(), frames.detected);
}

TEST(NetworkFeed, SaysWhereItWasBuiltWithoutALibraryForNetworks) {
  Options options;  // this test program is such a build
  options.prior = "people.onnx";
  try {
    open_network(options);
    FAIL() << "expected an error";
  } catch (const stillpoint::Error& error) {
    EXPECT_NE(std::string(error.what()).find("built without OpenCV's dnn"), std::string::npos) << error.what();
  }
}

/// How many pixels of a drawn frame are not as they were in it.
int drawn_pixels(const UsedRegion& region, bool inside_box_only) {
  const SourceFrame frame = frame_at(0);
  FrameRecord record;
  record.regions.push_back({region, ""});
  const cv::Mat image = draw_overlay(frame, record, {});
  const stillpoint::Box& box = region.detection.box;
  int count = 0;
  for (int v = 40; v < 90; ++v)  // between the box's name and the frame's status
    for (int u = 0; u < image.cols; ++u) {
      const auto x = static_cast<float>(u);
      if (inside_box_only && !(x > box.x + 2 && x < box.x + box.width - 2)) continue;
      count += image.at<cv::Vec3b>(v, u) == frame.colour.at<cv::Vec3b>(v, u) ? 0 : 1;
    }
  return count;
}

TEST(Overlay, CarriedBoxesAreDashed) {
  const stillpoint::Detection person{stillpoint::Box{8, -10, 40, 160}, stillpoint::Mobility::dynamic};
  const int seen = drawn_pixels({person, false}, false), carried = drawn_pixels({person, true}, false);
  EXPECT_GT(carried, 0);
  EXPECT_LT(carried, seen);
}

TEST(Overlay, MasksAreTintedWhereTheThingIs) {
  stillpoint::Detection person{stillpoint::Box{8, -10, 40, 160}, stillpoint::Mobility::dynamic};
  EXPECT_EQ(drawn_pixels({person, false}, true), 0);
  // Its left half: of the columns that are looked at, 11 to 27.
  person.mask = std::make_shared<stillpoint::BoxMask>(stillpoint::BoxMask{2, 1, {1, 0}});
  EXPECT_EQ(drawn_pixels({person, false}, true), 50 * 17);
}

TEST(Overlay, BoxesFarOutsideThePictureAreCut) {
  const stillpoint::Detection person{stillpoint::Box{-1e12f, -1e12f, 3e12f, 3e12f}, stillpoint::Mobility::dynamic};
  EXPECT_EQ(drawn_pixels({person, true}, false), 0) << "its outline is not in the picture";
}

}  // namespace
}  // namespace stillpoint_run
